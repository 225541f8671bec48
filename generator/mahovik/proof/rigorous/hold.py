"""Motion of a held carrier in balls: V* = S u*, and (8) with the wrench R of the hold, S^T R = 0: it has no power."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from flint import arb, arb_mat

from mahovik.proof.rigorous.ball import block, elements, identity, number, part, zeros
from mahovik.proof.rigorous.equations import solve, spin_inertia, spin_up_torques
from mahovik.proof.rigorous.pieces import Pieces


@dataclass(frozen=True, eq=False)
class HeldMotion:
    """u_dot (m), V_dot (6; m/s2, rad/s2), reaction (6; N, N m) of the hold on the carrier, in E1 about O1."""

    u_dot: list[arb]
    V_dot: list[arb]
    reaction: list[arb]


def forward(at: Pieces, S: arb_mat | None, phi_ddot: Sequence[float]) -> HeldMotion:
    """K S u* - R = F - M V_r - sum_s (I_s phi_s'' + J_s phi_s') - K d, S^T R = 0; d of the stream."""
    right = at.F - at.bias - at.K * at.drift
    for I, acceleration in zip(at.I, map(number, phi_ddot), strict=True):
        right = right - I * acceleration
    if S is None:
        return _motion(S, [], right * -1)
    m = S.ncols()
    system = block([[at.K * S, -identity(6)], [zeros(m, m), S.transpose()]])
    x = solve(system, block([[right], [zeros(m)]]))
    return _motion(S, elements(part(x, slice(0, m))), part(x, slice(m, m + 6)))


def reaction(at: Pieces, phi_ddot: Sequence[float]) -> arb_mat:
    """R = K V_r* + M V_r + sum_s (I_s phi_s'' + J_s phi_s') - F (6; N, N m) of the given V*, in E1 about O1."""
    found = at.K * (at.V_dot + at.drift) + at.bias - at.F
    for I, acceleration in zip(at.I, map(number, phi_ddot), strict=True):
        found = found + I * acceleration
    return found


def coupled(at: Pieces, S: arb_mat | None, tau: Sequence[float]) -> tuple[HeldMotion, list[arb]]:
    """The motion and phi'' (N) for the whole drive torques: m + N + 6 unknowns u*, phi'', R.

    K S u* + I phi'' - R = F - M V_r - J phi' - K d;  S^T R = 0;
    I^T S u* + Theta_ff phi'' = tau - f^T (Theta_s V_s* + Phi(V_s) Z_s - P_s) at V_r* = 0, phi'' = 0, less I^T d.
    """
    N, m = len(at.flywheels), 0 if S is None else S.ncols()
    if not N:
        return forward(at, S, ()), []
    I = block([list(at.I)])
    I_T = I.transpose()
    carrier = [I, -identity(6)]
    drives = [spin_inertia(at), zeros(N, 6)]
    known = [[at.F - at.bias - at.K * at.drift], [spin_up_torques(at, tau) - I_T * at.drift]]
    rows = [carrier, drives]
    if S is not None:
        rows = [[at.K * S, *carrier], [I_T * S, *drives], [zeros(m, m), zeros(m, N), S.transpose()]]
        known.append([zeros(m)])
    x = solve(block(rows), block(known))
    R = part(x, slice(m + N, m + N + 6))
    u_dot = elements(part(x, slice(0, m))) if m else []
    return _motion(S, u_dot, R), elements(part(x, slice(m, m + N)))


def _motion(S: arb_mat | None, u_dot: list[arb], R: arb_mat) -> HeldMotion:
    """The motion of the rates of the freedoms, V* = S u*."""
    V_dot = zeros(6) if S is None else S * arb_mat([[x] for x in u_dot])
    return HeldMotion(u_dot, elements(V_dot), elements(R))
