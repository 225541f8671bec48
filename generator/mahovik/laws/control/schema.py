"""`control_derivatives` of a body in the stand file."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import Annotated, Any

from pydantic import model_validator

from mahovik.core.stand.fields import Table, refuse, scalar, text, validator
from mahovik.core.stand.law import BodyLawSchema
from mahovik.core.stand.model import TWIST_LETTERS, WRENCH_LETTERS, Body, Stand
from mahovik.core.stand.toml import line_of, value_of
from mahovik.core.stand.units import Dimension, QuantityError, number, show
from mahovik.laws.control.data import (
    INPUTS,
    MOST_FACTORS,
    Control,
    ControlDerivative,
    ControlDerivatives,
    Factor,
    Velocity,
)

RACE = Dimension("a squared length per squared angle", "m^2/rad^2")
_INPUT = re.compile(r"(\w+)\.(\w+)")


def _component(raw: Any) -> int:
    if text(raw) not in WRENCH_LETTERS:
        raise QuantityError(f"expected one of {' '.join(WRENCH_LETTERS)}, found {show(raw)}")
    return WRENCH_LETTERS.index(raw)


def _factor(raw: Any) -> Factor:
    given = text(raw)
    bars = len(given) > 2 and given[0] == given[-1] == "|"
    inner = given[1:-1] if bars else given
    if inner in TWIST_LETTERS:
        return Velocity(TWIST_LETTERS.index(inner), bars)
    found = _INPUT.fullmatch(inner)
    what = None if found is None else next((each for each in INPUTS if each == found[2]), None)
    if found is None or what is None:
        letters = " ".join(TWIST_LETTERS)
        raise QuantityError(
            f"expected one of {letters}, or FIN.deflection, PROPELLER.speed, PROPELLER.race, with or without bars, "
            f"found {show(raw)}"
        )
    return Control(found[1], what, bars)


def _factors(raw: Any) -> tuple[Factor, ...]:
    if not isinstance(raw, list) or not 1 <= len(raw) <= MOST_FACTORS:
        found = f"{len(raw)}" if isinstance(raw, list) else show(raw)
        raise QuantityError(f'expected one to four factors such as ["u", "r", "rudder.deflection"], found {found}')
    return tuple(map(_factor, raw))


def _unit(wrench: int, of: tuple[Factor, ...]) -> str:
    """Unit of a derivative: that of the component over those of the factors."""
    metres, radians, rates = (sum(each) for each in zip(*(f.powers for f in of), strict=True))
    powers = [("s", rates), ("m", -metres), ("rad", -radians)]
    return " ".join(["N m" if wrench >= 3 else "N", *(f"{unit}^{power}" for unit, power in powers if power)])


class ControlTermTable(Table):
    """One of `control_derivatives.terms`."""

    wrench: Annotated[int, validator(_component)]
    of: Annotated[tuple[Factor, ...], validator(_factors)]
    value: Any

    @model_validator(mode="after")
    def _value_in_si(self) -> ControlTermTable:
        """The unit follows from the wrench component and the factors."""
        try:
            value = number(self.value, Dimension("a control derivative", _unit(self.wrench, self.of)))
        except QuantityError as error:
            raise refuse(str(error), "value") from None
        object.__setattr__(self, "value", value)
        return self


class ControlDerivativesTable(Table):
    """`control_derivatives` of a body."""

    terms: list[ControlTermTable]
    race: Annotated[float | None, scalar(RACE, least=0.0)] = None

    @model_validator(mode="after")
    def _race_is_used(self) -> ControlDerivativesTable:
        """The constant of the race stands where a term has a race, and there only."""
        races = _races(self.terms)
        if races and self.race is None:
            raise refuse("required where a term has PROPELLER.race, but missing", "race")
        if self.race is not None and not races:
            raise refuse("given, but no term has PROPELLER.race: expected one, or no such key", "race")
        return self


def read(given: ControlDerivativesTable) -> ControlDerivatives | None:
    """The data; None where there is no term."""
    terms = tuple(ControlDerivative(term.wrench, term.of, term.value) for term in given.terms if term.value)
    return ControlDerivatives(terms, (given.race or 0.0) if _races(terms) else 0.0) if terms else None


def _races(terms: Iterable[ControlDerivative | ControlTermTable]) -> bool:
    """Whether any has a race."""
    return any(isinstance(f, Control) and f.what == "race" for term in terms for f in term.of)


def lines(law: ControlDerivatives) -> list[str]:
    """Terms, and the constant of the race where one has it."""
    terms = (
        f'{{ wrench = "{WRENCH_LETTERS[term.wrench]}", of = {value_of([factor.text for factor in term.of])}, '
        f"value = {term.value!r} }}"
        for term in law.terms
    )
    return [f"terms = [{', '.join(terms)}]", *([line_of("race", law.race)] if _races(law.terms) else [])]


def structure(stand: Stand) -> dict[str, Any]:
    """Body index and what each derivative is made of, inputs by their place among those of the table.

    Nothing without, as other stands have it.
    """
    places: dict[str, int] = {}
    counts: dict[str, int] = {}
    for name in (name for body in stand.bodies for name in body.inputs):
        member = name.rpartition(".")[2]
        places[name] = counts[member] = counts.get(member, -1) + 1
    found = tuple(
        (i, tuple((term.wrench, tuple(_fact(f, places) for f in term.of)) for term in law.terms))
        for i, body in enumerate(stand.bodies)
        if (law := body.law(ControlDerivatives)) is not None
    )
    return {"control_derivatives": found} if found else {}


def _fact(f: Factor, places: dict[str, int]) -> tuple[str, int, bool]:
    """Letter or input, its place, and whether the magnitude counts."""
    if isinstance(f, Velocity):
        return "velocity", f.component, f.absolute
    return f.what, places[f.source], f.absolute


def problem(body: Body, law: ControlDerivatives) -> tuple[str, str] | None:
    """Key and words where a derivative names what the body does not bear."""
    for k, term in enumerate(law.terms):
        for factor in term.of:
            if isinstance(factor, Control) and factor.source not in body.inputs:
                known = ", ".join(body.inputs) or "no fin and no propeller"
                words = f'no "{factor.source}" on this body, which has {known}'
                return f"control_derivatives.terms[{k}]", words
    return None


SCHEMA = BodyLawSchema(
    ControlDerivatives, "control_derivatives", ControlDerivativesTable, read, lines, structure,
    optional=True, problem=problem,
)  # fmt: skip
