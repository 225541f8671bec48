"""Enclosures of what `want` names, at a precision, or as narrow as is asked."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from flint import arb, arb_mat, ctx

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.errors import StateError
from mahovik.proof.rigorous import equations, hold
from mahovik.proof.rigorous.ball import elements
from mahovik.proof.rigorous.pieces import Pieces, pieces

Balls = dict[str, Any]
"""Balls by the names of the contract: one, or nested lists of them."""

BITS = 256
"""The first precision."""

MOST_BITS = 8192
"""The last: balls that are still too wide hold no answer, such as the angle of half a turn."""


def want_matrices(at: Pieces, state: State) -> Balls:
    """K, K_dot, M (6x6), I, J (6xN), F (6)."""
    found: Balls = {name: getattr(at, name).tolist() for name in ("K", "K_dot", "M")}
    found |= {name: _columns_as_rows(getattr(at, name)) for name in ("I", "J")}
    return found | {"F": elements(at.F)}


def _columns_as_rows(columns: tuple[arb_mat, ...]) -> list[list[arb]]:
    """Columns as the six rows of a matrix."""
    return [[c[i, 0] for c in columns] for i in range(6)]


def want_momentum(at: Pieces, state: State) -> Balls:
    """Z, Z0 (6), energy, center_of_mass (3)."""
    Z = equations.momentum(at)
    return {
        "Z": elements(Z),
        "Z0": elements(at.L1 * Z),
        "energy": equations.kinetic_energy(at),
        "center_of_mass": equations.center_of_mass(at),
    }


def want_forward(at: Pieces, state: State) -> Balls:
    """V_dot (6), (8)."""
    return {"V_dot": elements(equations.forward(at, state.phi_ddot))}


def want_torque(at: Pieces, state: State) -> Balls:
    """tau (N)."""
    return {"tau": equations.torque(at, at.V_dot, state.phi_ddot)}


def want_mounts(at: Pieces, state: State) -> Balls:
    """mount_wrench (Nx6)."""
    return {"mount_wrench": equations.mounts(at, state.phi, at.V_dot, state.phi_ddot)}


def want_coupled(at: Pieces, state: State) -> Balls:
    """V_dot (6), phi_ddot (N)."""
    V_dot, phi_ddot = equations.coupled(at, state.tau)
    return {"V_dot": elements(V_dot), "phi_ddot": phi_ddot}


def want_held_forward(at: Pieces, state: State) -> Balls:
    """u_dot (m), V_dot, reaction (6)."""
    return dict(vars(hold.forward(at, at.S, state.phi_ddot)))


def want_held_coupled(at: Pieces, state: State) -> Balls:
    """u_dot (m), V_dot, reaction (6), phi_ddot (N)."""
    motion, phi_ddot = hold.coupled(at, at.S, state.tau)
    return dict(vars(motion)) | {"phi_ddot": phi_ddot}


def want_reaction(at: Pieces, state: State) -> Balls:
    """reaction (6) of a held carrier for given V*, phi''. StateError: the carrier is free."""
    if not at.held:
        raise StateError("reaction: the carrier is free, expected a held one")
    return {"reaction": elements(hold.reaction(at, state.phi_ddot))}


ANSWERS: Mapping[str, Callable[[Pieces, State], Balls]] = {
    "forward": want_forward,
    "coupled": want_coupled,
    "torque": want_torque,
    "mounts": want_mounts,
    "matrices": want_matrices,
    "momentum": want_momentum,
    "reaction": want_reaction,
}
"""Wants that have an enclosure."""

OF_HELD: Mapping[str, Callable[[Pieces, State], Balls]] = {"forward": want_held_forward, "coupled": want_held_coupled}
"""Wants that are answered along the freedoms of a held carrier."""


def pieces_at(stand: Stand, state: State, bits: int = BITS) -> Pieces:
    """The pieces of a stand at a state with a number of bits. StateError where there are none."""
    with ctx.workprec(bits):
        return pieces(stand, state)


def evaluate(at: Pieces, state: State, want: str, bits: int = BITS) -> Balls:
    """Balls that hold the exact answer to the numbers of stand and state, by names of the contract.

    `at`: their pieces, with as many bits. Raises StateError where there is no answer, or where this precision cannot
    tell (a singular matrix, half a turn).
    """
    with ctx.workprec(bits):
        answers = {**ANSWERS, **OF_HELD} if at.held else ANSWERS
        return answers[want](at, state)


def enclose(found_at: Callable[[int], Balls], narrow: Callable[[Balls], bool]) -> Balls:
    """What `found_at` gives for a number of bits, doubled from BITS until it is narrow.

    Raises StateError where even MOST_BITS give none.
    """
    bits, refusal = BITS, "the balls stay too wide"
    while bits <= MOST_BITS:
        try:
            found = found_at(bits)
        except StateError as error:
            refusal = str(error)
        else:
            if narrow(found):
                return found
        bits *= 2
    raise StateError(f"no enclosure with {MOST_BITS} bits: {refusal}")
