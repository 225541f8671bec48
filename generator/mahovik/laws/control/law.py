"""`control_derivatives` of a body in the stand file: products of up to four factors.

Factors are velocities, deflections of fins, speeds and races of propellers.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Annotated, Any, ClassVar, Literal, Self

from mahovik.core.stand.declare import TIMES, Declared, Draw, Tables
from mahovik.core.stand.fields import letter, scalar, validator
from mahovik.core.stand.law import BodyLaw, TermTable, Velocity, texts, velocity, without_bars
from mahovik.core.stand.model import TWIST_LETTERS, WRENCH_LETTERS, Body, Flywheel, Stand
from mahovik.core.stand.tables import Default, Table, TableError
from mahovik.core.stand.units import Dimension, QuantityError, show

RACE = Dimension("a squared length per squared angle", "m^2/rad^2")
Input = Literal["deflection", "speed", "race"]
INPUTS: tuple[Input, ...] = ("deflection", "speed", "race")
"""Quantities of a fin and of a propeller that may be factors."""

MOST_FACTORS = 4
_INPUT = re.compile(r"(\w+)\.(\w+)")


@dataclass(frozen=True)
class Control:
    """An input that is set at run time as a factor, or its magnitude.

    of    name of a fin or propeller of the same body
    what  deflection of the fin, rad; speed n of the propeller, rad/s; or the race that the propeller makes, m/s
    """

    of: str
    what: Input
    absolute: bool

    @property
    def source(self) -> str:
        """The input that it comes from, as `Body.inputs` names it."""
        return f"{self.of}.{'speed' if self.what == 'race' else self.what}"

    @property
    def text(self) -> str:
        """Spelling of the stand file: "rudder.deflection", with bars for a magnitude."""
        result = f"{self.of}.{self.what}"
        return f"|{result}|" if self.absolute else result

    @property
    def powers(self) -> tuple[int, int, int]:
        """Powers of metre, radian and 1/second."""
        return {"deflection": (0, 1, 0), "speed": (0, 1, 1), "race": (1, 0, 1)}[self.what]


Factor = Velocity | Control


def _factor(raw: object) -> Factor:
    if (factor := velocity(raw)) is not None:
        return factor
    inner, bars = without_bars(raw)
    match = _INPUT.fullmatch(inner)
    what = None if match is None else next((input_ for input_ in INPUTS if input_ == match[2]), None)
    if match is None or what is None:
        raise QuantityError(
            f"expected one of {' '.join(TWIST_LETTERS)}, or FIN.deflection, PROPELLER.speed, PROPELLER.race, with or "
            f"without bars, found {show(raw)}"
        )
    return Control(match[1], what, bars)


def _factors(raw: object) -> tuple[Factor, ...]:
    if not isinstance(raw, list) or not 1 <= len(raw) <= MOST_FACTORS:
        shown = f"{len(raw)}" if isinstance(raw, list) else show(raw)
        raise QuantityError(f'expected one to four factors such as ["u", "r", "rudder.deflection"], found {shown}')
    return tuple(map(_factor, raw))


@dataclass(frozen=True)
class ControlDerivative(Declared):
    """A component of the wrench += value times the product of one to four factors.

    wrench  component of the wrench: force along, moment about the three axes
    of      one to four factors, below
    """

    wrench: Annotated[int, letter(WRENCH_LETTERS)]
    of: Annotated[tuple[Factor, ...], validator(_factors, write=texts)]
    value: Annotated[float, TIMES]

    keys: ClassVar[type[Table]] = TermTable


class ControlTable(Table):
    """What the derivatives and the constant of the race tell together."""

    def check(self: Any) -> None:
        """Raises TableError unless the constant of the race stands where a term has a race, and there only."""
        races = _races(self.terms)
        if races and self.race is None:
            raise TableError("required where a term has PROPELLER.race, but missing", "race")
        if self.race is not None and not races:
            raise TableError("given, but no term has PROPELLER.race: expected one, or no such key", "race")


@dataclass(frozen=True)
class ControlDerivatives(BodyLaw):
    """All control derivatives of one body, in its own frame, of its twist relative to the fluid V_r = (u, ...).

    terms  the derivatives
    race   `a` of the race `sign(n) (sqrt(u^2 + a n^2) - |u|)`, which a propeller adds to the speed of the water;
           required where a term has a race
    """

    terms: Annotated[tuple[ControlDerivative, ...], Tables(ControlDerivative)]
    race: Annotated[float, scalar(RACE, least=0.0), Default(None)]

    key: ClassVar[str] = "control_derivatives"
    name: ClassVar[str] = "control derivatives"
    keys: ClassVar[type[Table]] = ControlTable
    steers: ClassVar[bool] = True

    @property
    def nonlinear(self) -> bool:
        """True: a product need not be linear in the twist."""
        return True

    @property
    def has_kinks(self) -> bool:
        """Whether any factor has a magnitude of the twist in it."""
        factors = [factor for term in self.terms for factor in term.of]
        return any(f.absolute if isinstance(f, Velocity) else f.what == "race" for f in factors)

    @property
    def acts(self) -> bool:
        """Whether there is any."""
        return bool(self.terms)

    @classmethod
    def of_table(cls, table: Table, **more: object) -> Self:
        """The derivatives that are not zero, and the constant of the race, where one of them has a race."""
        law = super().of_table(table, **more)
        terms = tuple(term for term in law.terms if term.value)
        return replace(law, terms=terms, race=(law.race or 0.0) if _races(terms) else 0.0)

    def as_keys(self) -> dict[str, object]:
        """Terms, and the constant of the race where one has it."""
        return {key: value for key, value in super().as_keys().items() if key != "race" or _races(self.terms)}

    @classmethod
    def structure(cls, stand: Stand) -> dict[str, object]:
        """Body index and what each derivative is made of, inputs by their place among those of the table.

        Nothing without, as other stands have it.
        """
        places: dict[str, int] = {}
        counts: dict[str, int] = {}
        for name in (name for body in stand.bodies for name in body.inputs):
            member = name.rpartition(".")[2]
            places[name] = counts[member] = counts.get(member, -1) + 1
        result = tuple(
            (i, tuple((term.wrench, tuple(_fact(f, places) for f in term.of)) for term in law.terms))
            for i, _, law in cls.of(stand)
        )
        return {"control_derivatives": result} if result else {}

    def problem(self, body: Body) -> tuple[str, str] | None:
        """Where a derivative names what the body does not bear."""
        sources = (factor.source for term in self.terms for factor in term.of if isinstance(factor, Control))
        missing = dict.fromkeys(f'"{source}"' for source in sources if source not in body.inputs)
        known = ", ".join(body.inputs) or "no fin and no propeller"
        words = f"no {', '.join(missing)} on this body, which has {known}"
        return ("control_derivatives, terms, of", words) if missing else None

    @classmethod
    def random_on(cls, draw: Draw, body: Body) -> Self | None:
        """A few products of the velocities and of the inputs that a body has; a flywheel has none."""
        if isinstance(body, Flywheel):
            return None
        rng, known = draw.rng, _factors_of_inputs(body)
        terms = []
        for _ in range(int(rng.integers(3, 7))):
            of: list[Factor] = [Velocity(int(rng.integers(6)), bool(rng.random() < 0.3))]
            of += [known[int(rng.integers(len(known)))] for _ in range(int(rng.integers(3))) if known]
            if rng.random() < 0.5:
                of.append(Velocity(int(rng.integers(6)), False))
            size = float(rng.uniform(-1.0, 1.0)) * body.mass
            for factor in of:
                size /= 100.0 if isinstance(factor, Control) and factor.what == "speed" else 1.0
            terms.append(ControlDerivative(int(rng.integers(6)), tuple(of), size))
        return cls(tuple(terms), draw.uniform(1e-5, 1e-3) if _races(terms) else 0.0)


def _races(terms: Iterable[ControlDerivative]) -> bool:
    """Whether any has a race."""
    return any(isinstance(f, Control) and f.what == "race" for term in terms for f in term.of)


def _fact(f: Factor, places: dict[str, int]) -> tuple[str, int, bool]:
    """Letter or input, its place, and whether the magnitude counts."""
    if isinstance(f, Velocity):
        return "velocity", f.component, f.absolute
    return f.what, places[f.source], f.absolute


def _factors_of_inputs(body: Body) -> list[Factor]:
    """Every input, bare and by its magnitude, and the race of every propeller."""
    velocities: list[Factor] = []
    for name in body.inputs:
        of, _, member = name.rpartition(".")
        what: tuple[Input, ...] = ("speed", "race") if member == "speed" else ("deflection",)
        velocities += [Control(of, kind, absolute) for kind in what for absolute in (False, True)]
    return velocities


LAW = ControlDerivatives
