"""mahovik.identifiable: which combinations of a stand's parameters motion can show."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from mahovik.core.stand.model import Stand as CoreStand
from mahovik.core.stand.units import show
from mahovik.errors import InputError
from mahovik.nearest import suggestion
from mahovik.out.api.core import Built
from mahovik.out.api.fields import Array
from mahovik.out.api.inputs import Given
from mahovik.out.api.regressor import Regressor, regressor_of
from mahovik.out.api.stands import Stand
from mahovik.out.api.states import States
from mahovik.use.regressor.combinations import base
from mahovik.use.regressor.parameters import Parameter

STATES, SEED = 60, 22
"""Random states of motion in general, and the seed of their numbers."""


@dataclass(frozen=True)
class Combination:
    """A sum that the data determine: a parameter and, times their coefficients, those that act only through it.

    others  coefficient by name
    unit    of the sum
    value   of the sum, by the stand file
    """

    name: str
    others: dict[str, float]
    unit: str
    value: float

    @property
    def alone(self) -> bool:
        """Whether the parameter is determined by itself."""
        return not self.others

    def __str__(self) -> str:
        terms = [f" {'-' if c < 0 else '+'} {_factor(abs(c))}{name}" for name, c in self.others.items()]
        return self.name + "".join(terms)


def _factor(size: float) -> str:
    return "" if abs(size - 1) < 1e-6 else f"{size:.4g} "


@dataclass(frozen=True)
class Identifiable:
    """Combinations that rows of Y determine, each a parameter alone or a sum; `unseen` parameters change no row.

    rank   number of combinations
    total  number of parameters looked at
    """

    stand: CoreStand
    combinations: tuple[Combination, ...]
    unseen: tuple[str, ...]
    total: int

    @property
    def rank(self) -> int:
        """Number of combinations."""
        return len(self.combinations)

    @property
    def alone(self) -> tuple[str, ...]:
        """Parameters that are determined by themselves."""
        return tuple(c.name for c in self.combinations if c.alone)

    def __iter__(self) -> Iterator[Combination]:
        return iter(self.combinations)

    def __getitem__(self, name: str) -> Combination:
        for each in self.combinations:
            if name == each.name:
                return each
        known = [c.name for c in self.combinations]
        raise InputError(f"{show(name)}: in no combination{suggestion(str(name), known)}")

    def __repr__(self) -> str:
        what = f"{self.rank} combinations of {self.total} parameters, {len(self.alone)} of them single"
        return f"<Identifiable of {self.stand.name}: {what}; {len(self.unseen)} unseen>"


def identifiable(
    stand: CoreStand | str | Path,
    x: States | ArrayLike | None = None,
    V_dot: Given = 0.0,
    phi_ddot: Given = 0.0,
    *,
    rows: Sequence[str] | None = None,
    known: Sequence[str] = (),
    still: bool = False,
) -> Identifiable:
    """Name the combinations of masses, first moments, moments of inertia, added mass and damping that motion shows.

    x, V_dot, phi_ddot  the motion that is measured, as `Model.regressor` takes it; by default random motion
    rows                what is known of the wrench (X Y Z K M N) and of drive torques (tau NAME); by default all
    known               names of parameters that are not asked for
    still               with random motion: the carrier stands still, only flywheels move

    A force table gives the rows of the wrench, drives those of the torques. Raises InputError, StandError,
    ToolchainError (no compiler).
    """
    built = Built(Stand.of(stand), "double", None, 1, only=("regressor",))
    if x is None:
        found = _random_motion(built, still)
    elif still:
        raise InputError("still: goes with random motion, but x is given: leave one out")
    else:
        found = regressor_of(built, x, V_dot, phi_ddot)
    Y = found.Y if found.batch is not None else found.Y[None]
    kept = _places(rows, found.rows, "rows")
    left_out = set(_places(known, [p.name for p in found.parameters], "known"))
    asked = [k for k in range(len(found.parameters)) if k not in left_out]
    return _name_parameters(built.stand, [found.parameters[k] for k in asked], Y[:, kept][:, :, asked])


def _places(names: Sequence[str] | None, known: Sequence[str], what: str) -> list[int]:
    if names is None:
        return list(range(len(known)))
    if isinstance(names, str):
        raise InputError(f"{what}: expected names in a list, found one text: write [{names!r}]")
    for name in names:
        if name not in known:
            raise InputError(f"{what}: no {show(name)}{suggestion(str(name), known)}")
    return [known.index(name) for name in names]


def _name_parameters(stand: CoreStand, asked: Sequence[Parameter], Y: Array) -> Identifiable:
    found = base(Y.reshape(-1, Y.shape[2]))
    combinations = []
    for row, i in enumerate(found.independent):
        coefficients = zip(found.dependent, found.coefficients[row], strict=True)
        others = {asked[j].name: float(c) for j, c in coefficients if c}
        values = {p.name: p.value for p in asked}
        value = asked[i].value + sum(c * values[name] for name, c in others.items())
        combinations.append(Combination(asked[i].name, others, asked[i].unit, value))
    return Identifiable(stand, tuple(combinations), tuple(asked[k].name for k in found.unseen), len(asked))


def _random_motion(built: Built, still: bool) -> Regressor:
    """The regressor at random attitudes, speeds and accelerations, of the sizes that tests draw."""
    rng, N = np.random.default_rng(SEED), len(built.flywheels)
    attitude = rng.normal(size=(STATES, 4))
    attitude /= np.linalg.norm(attitude, axis=1)[:, None]
    V, V_dot = (np.zeros((STATES, 6)) if still else rng.normal(size=(STATES, 6)) for _ in range(2))
    x = built.states(
        STATES, attitude=attitude, V=V, phi=rng.uniform(0, 2 * np.pi, (STATES, N)), phi_dot=rng.normal(size=(STATES, N))
    )
    return regressor_of(built, x, V_dot, rng.normal(size=(STATES, N)))
