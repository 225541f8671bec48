"""matrices: K, K_dot, M, I, J of (8) and F of (7); momentum: Z, energy, mass centre; points: what sensors read."""

from __future__ import annotations

from typing import Any

from mahovik.core.lower.flywheels import column_of
from mahovik.core.lower.forward import STATE_STATUSES, check_inputs, external_wrench, scene, sum_up
from mahovik.core.lower.library import Library
from mahovik.core.lower.solve import lower_left
from mahovik.core.program.expression import Status
from mahovik.core.program.kernel import OK, Reals, argument, changed, inline, reals, result
from mahovik.core.program.vector import Matrix, Vector, cross, dot, skew, symmetric


def mass_matrix(lib: Library, table: Any, sums: Any) -> Matrix:
    """K of (2)."""
    m, B = table.mass, lower_left(lib, table, sums.mu)
    A = symmetric(table.A) if lib.layout.added_mass else [[m, 0, 0], [0, m, 0], [0, 0, m]]
    return blocks(A, B.T, B, symmetric(sums.J))


def mass_matrix_rate(sums: Any) -> Matrix:
    """K_dot of (6): added mass and carrier do not change in E1."""
    return blocks([[0] * 3] * 3, -skew(sums.mu_dot), skew(sums.mu_dot), symmetric(sums.J_dot))


def blocks(A: Any, B: Any, C: Any, D: Any) -> Matrix:
    """[A B; C D]."""
    return Matrix([*([*a, *b] for a, b in zip(A, B, strict=True)), *([*c, *d] for c, d in zip(C, D, strict=True))])


def Phi_times(V: Any, six: Any) -> Vector:
    """Phi(V) times six numbers: a column of K, or of I in (9)."""
    v, omega, p, h = V[0:3], V[3:6], six[0:3], six[3:6]
    return Vector([*-cross(p, omega), *(-cross(p, v) - cross(h, omega))])


def add_matrices(lib: Library) -> None:
    """Adds the matrices of (8) at a state."""
    layout = lib.layout

    @lib.kernel(equation="(9)")
    def velocity_matrix(
        V: Reals = argument("", 6), out: Any = changed("in: K, K_dot; out: M", struct=layout.matrices)
    ) -> None:
        """M = Phi K + K_dot."""
        for j in range(6):  # Phi acts on each column
            for i in list(range(6)):
                out.M[i][j] = Phi_times(V, out.K[:, j])[i] + out.K_dot[i][j]

    V, members = "V_r" if layout.stream else "V", "K, K_dot, M, I_, J, F" if layout.flywheels else "K, K_dot, M, F"
    purpose = f"The matrices of K {V}_dot + M {V} + I phi_ddot + J phi_dot = F at a state."

    @lib.kernel(equation="(2), (6)-(9)", purpose=purpose, statuses=STATE_STATUSES, public=True)
    def matrices(
        table: Any = lib.table,
        x: Any = lib.x,
        wrench: Any = lib.wrench,
        out: Any = result(members, struct=layout.matrices),
    ) -> Status:
        """The matrices of (8)."""
        check_inputs(lib, table, x, None, wrench)
        seen = scene(lib, table, x)
        sum_up(lib, table, x, seen, None, mass_alone=True)
        F = reals(6)
        external_wrench(lib, table, x, seen, wrench, F)
        out.F[:] = F
        # K (2) and its rate (6)
        out.K[:] = mass_matrix(lib, table, seen.sums)
        out.K_dot[:] = mass_matrix_rate(seen.sums)
        velocity_matrix(seen.V_r, out)
        if layout.flywheels:
            column = reals(6)  # I_s
            rate = reals(6)  # dI_s / dphi
            for s in range(layout.count):
                row = table.flywheel[s]
                s_phi = seen.turns[0][s]
                c_phi = seen.turns[1][s]
                column[:] = column_of(row, s_phi, c_phi)
                rate[0:3] = -row.mu_c * c_phi - row.mu_s * s_phi
                rate[3:6] = row.t_s * c_phi - row.t_c * s_phi
                for i in list(range(6)):  # J_s = Phi I_s + (mu'', t') phi_dot
                    out.I[i][s] = column[i]
                    out.J[i][s] = Phi_times(seen.V_r, column)[i] + rate[i] * x.phi_dot[s]
        return OK


def add_momentum(lib: Library) -> None:
    """Adds Z, Z0, kinetic energy, mass centre."""
    layout = lib.layout

    @lib.kernel(equation="(1), (2)", statuses=STATE_STATUSES, public=True)
    def momentum(
        table: Any = lib.table,
        x: Any = lib.x,
        out: Any = result("Z, Z0, energy, mass centre and its velocity", struct=layout.momentum),
    ) -> Status:
        """Momentum screw, kinetic energy, mass centre of the whole system and its velocity."""
        check_inputs(lib, table, x)
        seen = scene(lib, table, x, attitude=True)
        sum_up(lib, table, x, seen, None)
        C, V, sums = seen.C, x.V, seen.sums
        fluid = layout.drifts
        Z = reals(6)  # momentum screw (2)
        if fluid:
            Z[0:3] = momentum_of_bodies(table, sums, V)
            Z[3:6] = symmetric(sums.J) @ V[3:6] + sums.h_rel + cross(sums.mu, V[0:3])
        else:
            lib["momentum_screw"](table, sums, V, Z)
        spin: float = 0.0  # sum phi_dot (I^T V + Theta_ff phi_dot)
        if layout.flywheels:
            for s in range(layout.count):
                row = table.flywheel[s]
                s_phi = seen.turns[0][s]
                c_phi = seen.turns[1][s]
                along = dot(column_of(row, s_phi, c_phi), V)  # I_s . V
                spin += x.phi_dot[s] * (along + row.spin * x.phi_dot[s])
        energy: float = dot((*(0.5 * Z[3:6]), *(0.5 * Z[0:3]), 0.5), (*V[3:6], *V[0:3], spin))
        if fluid:
            add_fluid(table, V, seen.V_r, Z, energy)
        out.Z[:] = Z
        # Z0 = L1 Z of (1)
        out.Z0[0:3] = C @ Z[0:3]
        out.Z0[3:6] = C @ Z[3:6] - cross(out.Z0[0:3], x.position)
        out.energy = energy
        out.center_of_mass[:] = sums.mu * table.mass_inverse
        v = reals(3)  # of the mass centre in E1, from the momentum of the bodies, without the fluid's
        if layout.added_mass:
            v[:] = momentum_of_bodies(table, sums, V)
            v[:] = v * table.mass_inverse
        else:
            v[:] = Z[0:3] * table.mass_inverse
        out.center_of_mass_velocity[:] = C @ v
        return OK


def momentum_of_bodies(table: Any, sums: Any, V: Any) -> Any:
    """Their momentum at a twist, without the fluid's."""
    return table.mass * V[0:3] - cross(sums.mu, V[3:6]) + sums.mu_dot


@inline
def add_fluid(table: Any, V: Any, V_r: Any, Z: Any, energy: Any) -> None:
    """Adds what the added mass has by V_r to Z and energy of the bodies, whose J has that of the added mass in it."""
    # bodies at V, added mass at V relative to the stream
    v, omega = V_r[0:3], V[3:6]
    p: Reals = symmetric(table.Lambda_11) @ v + table.G.square.T @ omega  # momentum of the fluid
    h: Reals = table.G.square @ v  # its moment, but for that of omega
    energy += dot((*(0.5 * p), *(0.5 * h)), (*v, *omega))
    Z[0:3] += p
    Z[3:6] += h


def add_points(lib: Library) -> None:
    """Adds the reading of one sensor from checked inputs, and those of all instruments and points."""
    layout = lib.layout

    @lib.kernel()
    def sense(
        sensor: Any = argument(struct=layout.sensor),
        r: Reals = argument("of O1", 3, unit="m"),
        V: Reals = argument("", 6),
        V_dot: Reals = argument("", 6),
        C: Reals = argument("attitude of the carrier", 9),
        g: Reals = argument("gravity in E1", 3, unit="m/s2"),
        out: Any = result(struct=layout.points_result),
    ) -> None:
        """Reading of an accelerometer and a gyro at one instrument or point."""
        O, R, omega, omega_dot = sensor.origin, sensor.axes, V[3:6], V_dot[3:6]
        velocity = reals(3)  # in E1
        force = reals(3)  # acceleration minus gravity, in E1
        velocity[:] = -cross(O, omega) + V[0:3]
        weight = g if layout.weight else [0, 0, 0]
        force[:] = -cross(O, omega_dot) - weight + cross(omega, velocity) + V_dot[0:3]
        out.position[:] = C @ O + r
        out.C[:] = C.square @ R.square
        out.twist[0:3] = R.T @ velocity
        out.twist[3:6] = R.T @ omega
        out.specific_force[:] = R.T @ force
        out.angular_acceleration[:] = R.T @ omega_dot

    @lib.kernel(statuses=STATE_STATUSES, public=True)
    def points(
        table: Any = lib.table,
        x: Any = lib.x,
        V_dot: Reals = argument("derivative of the components of V", 6, unit="m/s2, rad/s2"),
        out: Any = result(
            "one reading for each instrument, then for each point", layout.sensor_count, struct=layout.points_result
        ),
    ) -> Status:
        """Readings of an accelerometer and a gyro at each instrument and point."""
        check_inputs(lib, table, x)
        lib["within"](V_dot, 6, lib.limit("MAX_ACCELERATION"))
        C = reals(9)  # attitude
        lib["rotation"](x.attitude, C)
        g = None
        if layout.weight:
            g = reals(3)  # gravity in E1
            lib["rotate_back"](C, table.gravity, g)
        for k in range(layout.sensor_count):
            sense(table.sensor[k], x.position, x.V, V_dot, C, g, out[k])
        return OK
