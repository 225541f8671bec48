"""Evaluation of a state (stand.md): which equations answer which `want`."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.errors import StateError
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.coupled import coupled
from mahovik.proof.reference.forward import forward
from mahovik.proof.reference.generalized import generalized
from mahovik.proof.reference.inverse import CUTS, Cuts, inverse
from mahovik.proof.reference.momentum import center_of_mass, kinetic_energy, momentum, momentum_in_E0
from mahovik.proof.reference.mounts import mounts
from mahovik.proof.reference.pieces import Pieces, pieces
from mahovik.proof.reference.points import points
from mahovik.proof.reference.torque import torque

Values = dict[str, Any]


def vector(numbers: Sequence[float]) -> Array:
    """An input of the state as an array of floats."""
    return np.array(numbers, dtype=np.float64)


def want_matrices(at: Pieces, stand: Stand, state: State) -> Values:
    """K, K_dot, M (6x6), I, J (6xN), F (6): (2), (6), (9), (7)."""
    return {"K": at.K, "K_dot": at.K_dot, "M": at.M, "I": at.I, "J": at.J, "F": at.F}


def want_momentum(at: Pieces, stand: Stand, state: State) -> Values:
    """Z, Z0 (6), energy, center_of_mass (3): (1), (2)."""
    return {
        "Z": momentum(at),
        "Z0": momentum_in_E0(at),
        "energy": kinetic_energy(at),
        "center_of_mass": center_of_mass(at),
    }


def want_forward(at: Pieces, stand: Stand, state: State) -> Values:
    """V_dot (6): (8)."""
    return {"V_dot": forward(at, vector(state.phi_ddot))}


def want_torque(at: Pieces, stand: Stand, state: State) -> Values:
    """tau (N)."""
    return {"tau": torque(at, vector(state.V_dot), vector(state.phi_ddot))}


def want_mounts(at: Pieces, stand: Stand, state: State) -> Values:
    """mount_wrench (Nx6)."""
    return {"mount_wrench": mounts(at, vector(state.V_dot), vector(state.phi_ddot))}


def want_coupled(at: Pieces, stand: Stand, state: State) -> Values:
    """V_dot (6), phi_ddot (N)."""
    V_dot, phi_ddot = coupled(at, vector(state.tau))
    return {"V_dot": V_dot, "phi_ddot": phi_ddot}


def want_inverse(at: Pieces, stand: Stand, state: State, cuts: Cuts = CUTS) -> Values:
    """phi_ddot (N), status, residual (6), sigma (min(6, N)), rank: (12)."""
    return dict(vars(inverse(at, vector(state.V_dot), cuts)))


def want_generalized(at: Pieces, stand: Stand, state: State) -> Values:
    """A, D, I0, J0 (6x6), q_dot, q_ddot (6): (10), (11)."""
    return dict(vars(generalized(at, stand.angles, state)))


def want_points(at: Pieces, stand: Stand, state: State) -> Values:
    """points: values of every instrument and point by name."""
    return {"points": points(at, stand, vector(state.V_dot))}


WANTS: Mapping[str, Callable[[Pieces, Stand, State], Values]] = {
    "matrices": want_matrices,
    "momentum": want_momentum,
    "forward": want_forward,
    "torque": want_torque,
    "mounts": want_mounts,
    "coupled": want_coupled,
    "inverse": want_inverse,
    "generalized": want_generalized,
    "points": want_points,
}

TWO_VALUES = (("forward", "coupled", "V_dot"), ("coupled", "inverse", "phi_ddot"))


def check_want(want: Sequence[str]) -> None:
    """StateError where `want` is empty, names what is unknown, or asks for two values of one name."""
    if not want:
        raise StateError("want: empty; name at least one of " + ", ".join(WANTS))
    for name in want:
        if name not in WANTS:
            raise StateError(f"want: {name!r} is unknown; known are " + ", ".join(WANTS))
    for first, second, value in TWO_VALUES:
        if first in want and second in want:
            raise StateError(f"want: {first!r} and {second!r} both give {value!r}; ask for them in two states")


def finite(value: Any) -> bool:
    """Whether every number of a result, however nested, is finite."""
    if isinstance(value, dict):
        return all(finite(each) for each in value.values())
    return isinstance(value, str) or bool(np.all(np.isfinite(value)))


def evaluate(stand: Stand, state: State, want: Sequence[str], at: Pieces | None = None, cuts: Cuts = CUTS) -> Values:
    """What `want` names, under the names of the contract: arrays, floats; status a string, rank an int.

    `at`: the pieces of this stand and state, where the caller has them already. `cuts`: thresholds of `inverse`.

    StateError: `want` is empty, unknown or gives one name two values; a leg has no length; `generalized` with
    a quaternion or at a singular attitude; `momentum` of a stand without mass; a result that is not finite.
    """
    check_want(want)
    values: Values = {}
    with np.errstate(all="ignore"):  # what overflows is not finite, and is reported below
        at = at or pieces(stand, state)
        for name in want:
            values |= WANTS[name](at, stand, state) if name != "inverse" else want_inverse(at, stand, state, cuts)
    for name, value in values.items():
        if not finite(value):
            raise StateError(f"{name}: not finite at this state")
    return values
