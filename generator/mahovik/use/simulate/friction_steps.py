"""Whether a step resolves the friction of a held carrier: shorter than inertia times smoothing over breakaway."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mahovik.core.stand.hold import twists
from mahovik.core.stand.law import CarrierLaw
from mahovik.core.stand.model import Stand
from mahovik.proof.reference import pieces
from mahovik.use.simulate.held import home


@dataclass(frozen=True)
class LongStep:
    """A freedom whose friction a step of `dt` (s) does not resolve; it should be shorter than `bound` (s)."""

    freedom: str
    dt: float
    bound: float

    def __str__(self) -> str:
        return (
            f"friction of {self.freedom}: a step of {self.dt:g} s is not shorter than {self.bound:.2g} s, inertia "
            "times smoothing over breakaway: use shorter steps, or a larger smoothing"
        )


def long_steps(stand: Stand, dt: float, given: Sequence[bool] = ()) -> list[LongStep]:
    """Freedoms whose friction steps of `dt` (s) do not resolve.

    given  flywheels whose speed is given, so that they do not give way; default: none
    """
    laws = [law for law in stand.laws if isinstance(law, CarrierLaw)]
    if stand.hold is None or not any(law.longest_steps([1.0] * len(stand.hold.freedoms)) for law in laws):
        return []
    loose = [k for k in range(len(stand.flywheels)) if not (given and given[k])]
    inertias = _smallest_inertias(stand, loose)
    bounds = [each for law in laws for each in law.longest_steps(inertias)]
    return [LongStep(name, dt, bound) for name, bound in bounds if dt >= bound]


def _smallest_inertias(stand: Stand, loose: Sequence[int]) -> list[float]:
    """Inertia (kg, kg m2) along each freedom in the home pose, where all that is free besides gives way.

    That is 1 / (M^-1)_ii of M = [[S^T K S, S^T I], [I^T S, Theta_ff]].

    loose  places of the flywheels whose speed is not given
    """
    assert stand.hold is not None
    at, S = pieces(stand, home(stand)), twists(stand.hold)
    across, own = S.T @ at.I[:, loose], at.Theta_ff[np.ix_(loose, loose)]
    mobility = np.linalg.pinv(np.block([[S.T @ at.K @ S, across], [across.T, own]]), hermitian=True)
    return [1.0 / float(x) for x in np.diag(mobility)[: S.shape[1]]]
