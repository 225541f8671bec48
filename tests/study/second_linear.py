"""The linear model by CasADi's automatic differentiation of the second derivation: shares no formula with study."""

from __future__ import annotations

from dataclasses import replace

import casadi as ca
import numpy as np

from mahovik.second import Second
from mahovik.second.points import names
from mahovik.second.rotation import by_angles


def cross(a):
    """<a> of an expression or numbers."""
    return ca.skew(a)


def turned(eta):
    """exp<eta> to the second order: exact for first derivatives at zero."""
    return ca.MX.eye(3) + cross(eta) + cross(eta) @ cross(eta) / 2


def rotation_vector(R):
    """Of an expression, well off zero and half a turn."""
    odd = ca.vertcat(R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1])
    sine = ca.norm_2(odd)
    return odd / sine * ca.atan2(sine, ca.trace(R) - 1)


def small_rotation_vector(R):
    """Near zero, where the other has no derivative: exact for first derivatives there."""
    return ca.vertcat(R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]) / 2


class SecondLinear:
    """A, B, C, D (numbers) of a stand about a state with phi_ddot; V* and tau by the second derivation as well."""

    def __init__(self, stand, state, small=False):
        second = Second(stand)
        V_dot = second.evaluate(state, ["forward"])["V_dot"]
        tau = second.evaluate(replace(state, V_dot=tuple(V_dot)), ["torque"])["tau"]
        self.V_dot, self.tau = V_dot, tau
        N = len(stand.flywheels)
        x, u = ca.MX.sym("x", 12 + 2 * N), ca.MX.sym("u", N + 6)
        e, eta, dV, dphi, dspeed = ca.vertsplit(x, [0, 3, 6, 12, 12 + N, 12 + 2 * N])
        at = second.arguments(state)
        V0 = ca.DM(at["V"])
        V = V0 + dV
        given = {name: at[name] for name in ("V_dot", "phi_ddot")}
        given |= {"position": at["position"] + at["C"] @ e, "C": ca.DM(at["C"]) @ turned(eta), "V": V}
        given |= {"phi": at["phi"] + dphi, "phi_dot": at["phi_dot"] + dspeed, "tau": tau + u[:N]}
        given["wrench"] = ca.horzcat(at["wrench"][:, 0] + u[N:], at["wrench"][:, 1:])
        given["displacement"] = ca.MX.zeros(6)
        law = stand.suspension
        if law is not None:
            off = given["C"].T @ (given["position"] - ca.DM(law.position))
            R = by_angles(stand.angles, ca.DM(law.angles)).T @ given["C"]
            given["displacement"] = ca.vertcat(off, small_rotation_vector(R) if small else rotation_vector(R))
        found = second.function("coupled")(**given)
        rate, spin = found["coupled_V_dot"], found["coupled_phi_ddot"]
        v, omega, v0, omega0 = V[:3], V[3:], V0[:3], V0[3:]
        x_dot = ca.vertcat(
            -ca.cross(omega0, e) + turned(eta) @ v - v0,
            (omega + ca.cross(eta, omega) / 2) - (omega0 - ca.cross(eta, omega0) / 2),
            rate,
            dspeed,
            spin,
        )
        y = ca.vertcat(*self._outputs(stand, second, {**given, "V_dot": rate}, state, V_dot))
        parts = [ca.jacobian(f, z) for f in (x_dot, y) for z in (x, u)]
        zero = np.zeros(12 + 2 * N), np.zeros(N + 6)
        self.A, self.B, self.C, self.D = (m.full() for m in ca.Function("linear", [x, u], parts)(*zero))

    @staticmethod
    def _outputs(stand, second, given, state, V_dot):
        nominal = second.evaluate(replace(state, V_dot=tuple(V_dot)), ["points"])["points"]
        if not nominal:
            return [ca.MX.zeros(0)]
        found = second.function("points")(**given)
        rows = []
        for k, name in enumerate(names(stand)):
            axes0 = nominal[name]["C"]
            axes = found["points_C"][:, 3 * k : 3 * k + 3]
            rows.append(axes0.T @ found["points_position"][:, k])
            rows.append(axes0.T @ axes @ found["points_twist"][:3, k])
            rows.append(axes0.T @ axes @ found["points_specific_force"][:, k])  # less gravity, which is constant
        return rows
