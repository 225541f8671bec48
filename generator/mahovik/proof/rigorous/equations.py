"""Questions to the pieces: forward (8), torque, mounts, coupled, momentum."""

from __future__ import annotations

from collections.abc import Sequence

from flint import arb, arb_mat

from mahovik.errors import StateError
from mahovik.proof.rigorous.ball import block, dot, elements, number, part, zeros
from mahovik.proof.rigorous.bodies import Spinning
from mahovik.proof.rigorous.pieces import Pieces
from mahovik.proof.rigorous.rotation import elementary
from mahovik.proof.rigorous.screw import Phi, diagonal, f, spin


def solve(S: arb_mat, b: arb_mat) -> arb_mat:
    """x of S x = b, every solution for numbers in the balls. StateError where S may be singular."""
    try:
        return S.solve(b)
    except ZeroDivisionError:
        raise StateError("the mass matrix is singular, as far as this precision can tell") from None


def forward(at: Pieces, phi_ddot: Sequence[float]) -> arb_mat:
    """V* (6; m/s2, rad/s2): K V_r* = F - M V_r - sum_s (I_s phi_s'' + J_s phi_s'), (8)."""
    right = at.F - at.bias
    for I, acceleration in zip(at.I, map(number, phi_ddot), strict=True):
        right = right - I * acceleration
    return solve(at.K, right) - at.drift


def mount_on_flywheel(at: Pieces, s: Spinning, V_dot: arb_mat, phi_ddot: arb) -> arb_mat:
    """Theta_s V_s* + Phi(V_s) Z_s - P_s (6; N, N m), of the mount on the flywheel, in Es about Os.

    V_s* = Ls^T V* - phi_s' [<e>] Ls^T V + f phi_s'', V_s = Ls^T V + f phi_s', Z_s = Theta_s V_s.
    """
    V_s, L_T = s.twist(at.V), s.L.transpose()
    V_s_dot = L_T * V_dot - spin() * L_T * at.V * s.phi_dot + f() * phi_ddot
    return s.Theta * V_s_dot + Phi(V_s) * (s.Theta * V_s) - at.P[s.body.name]


def mount_wrenches(at: Pieces, V_dot: arb_mat, phi_ddot: Sequence[float]) -> list[arb_mat]:
    """Wrench of the mount on every flywheel (6 each)."""
    return [
        mount_on_flywheel(at, s, V_dot, acceleration)
        for s, acceleration in zip(at.flywheels, map(number, phi_ddot), strict=True)
    ]


def torque(at: Pieces, V_dot: arb_mat, phi_ddot: Sequence[float]) -> list[arb]:
    """tau_s = f^T (Theta_s V_s* + Phi(V_s) Z_s - P_s) (N, N m)."""
    return [dot(f(), wrench) for wrench in mount_wrenches(at, V_dot, phi_ddot)]


def mounts(at: Pieces, phi: Sequence[float], V_dot: arb_mat, phi_ddot: Sequence[float]) -> list[list[arb]]:
    """diag(C1, C1)(phi_s) of the mount wrenches (N x 6): about Os, in the flywheel's axes at phi_s = 0."""
    wrenches = mount_wrenches(at, V_dot, phi_ddot)
    return [elements(diagonal(elementary(1, angle)) * w) for angle, w in zip(phi, wrenches, strict=True)]


def coupled(at: Pieces, tau: Sequence[float]) -> tuple[arb_mat, list[arb]]:
    """V* (6) and phi'' (N) for the whole drive torques: 6 + N unknowns.

    K V* + I phi'' = F - M V - J phi';  I^T V* + Theta_ff phi'' = tau - f^T (Theta_s V_s* + Phi(V_s) Z_s - P_s) at
    V* = 0, phi'' = 0. With a stream in V_r, for V_r*.
    """
    N = len(at.flywheels)
    if not N:
        return forward(at, ()), []
    right = at.F - at.bias
    I = block([list(at.I)])
    x = solve(block([[at.K, I], [I.transpose(), spin_inertia(at)]]), block([[right], [spin_up_torques(at, tau)]]))
    return part(x, slice(0, 6)) - at.drift, elements(part(x, slice(6, 6 + N)))


def spin_up_torques(at: Pieces, tau: Sequence[float]) -> arb_mat:
    """tau - f^T (Theta_s V_s* + Phi(V_s) Z_s - P_s) at V_r* = 0, phi'' = 0 (N; N m)."""
    rows: list[list[arb]] = []
    for s, given in zip(at.flywheels, map(number, tau), strict=True):
        V_s, e = s.twist(at.V_r), spin()
        velocity = s.Theta * e * s.L.transpose() * at.V_r * -s.phi_dot + Phi(V_s) * s.Theta * V_s
        rows.append([given - dot(f(), velocity) + dot(f(), at.P[s.body.name])])
    return arb_mat(rows)


def spin_inertia(at: Pieces) -> arb_mat:
    """Theta_ff = diag(f^T Theta_s f) (N x N, kg m2)."""
    N = len(at.flywheels)
    Theta_ff = zeros(N, N)
    for i, s in enumerate(at.flywheels):
        Theta_ff[i, i] = dot(f(), s.Theta * f())
    return Theta_ff


def momentum(at: Pieces) -> arb_mat:
    """Z = K V + sum_s I_s phi_s' (6), (2); Lambda takes V_r."""
    Z = at.bodies * at.V + at.Lambda * at.V_r
    return sum((I * s.phi_dot for I, s in zip(at.I, at.flywheels, strict=True)), Z)


def kinetic_energy(at: Pieces) -> arb:
    """Half the sum of V_k^T Theta_k V_k over all bodies, and of V_r^T Lambda V_r (J)."""
    twists = [(k.twist(at.V), k.Theta) for k in (*at.fixed, *at.flywheels)]
    return (sum((dot(V, Theta * V) for V, Theta in twists), dot(at.V_r, at.Lambda * at.V_r))) / 2


def center_of_mass(at: Pieces) -> list[arb]:
    """Centre of mass (3, m) of all bodies, in E1: m E and <m rc> are blocks of K. StateError without mass."""
    m = at.bodies[0, 0]
    if not m > 0:
        raise StateError("no body of the stand has a mass, so there is no center_of_mass")
    return [at.bodies[5, 1] / m, at.bodies[3, 2] / m, at.bodies[4, 0] / m]
