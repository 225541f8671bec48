"""regressor: what (8) and the drive torques take of each mass, first moment and moment of inertia."""

from __future__ import annotations

from typing import Any

from mahovik.core.formula.derived import formula
from mahovik.core.formula.derived import regressor as derived
from mahovik.core.lower.forward import STATE_STATUSES, check_inputs, relative_rate, scene
from mahovik.core.lower.library import Library
from mahovik.core.program.expression import Status
from mahovik.core.program.kernel import OK, Reals, argument, reals, result
from mahovik.core.program.vector import Matrix, cross


def add_all(lib: Library) -> None:
    """Adds the function with its internal ones."""
    add_columns(lib)
    add_proper_acceleration(lib)
    if lib.layout.flywheels:
        add_flywheel_columns(lib)
    add_regressor(lib)


def add_columns(lib: Library) -> None:
    """Adds the columns of one body in its own frame, and those of the added mass."""

    @lib.kernel()
    def body_columns(
        d: Reals = argument("proper acceleration of its origin", 3),
        a: Reals = argument("angular acceleration", 3),
        w: Reals = argument("angular velocity", 3),
        Y: Reals = result("wrench by mass, first moment, J 11 22 33 12 13 23", 6, 10),
    ) -> None:
        """Wrench of one body by its ten parameters, in its own frame."""
        for i in list(range(6)):
            Y[i] = formula(derived.body_columns()[i, :], d=d, a=a, w=w)

    if lib.layout.added_mass:

        @lib.kernel()
        def added_mass_columns(
            V: Reals = argument("relative to the stream", 6),
            V_dot: Reals = argument("likewise", 6),
            Y: Reals = result("wrench by the upper half of the added mass, row by row", 6, 21),
        ) -> None:
            """Wrench by the 21 numbers of the added mass."""
            for i in list(range(6)):
                Y[i] = formula(derived.added_mass_columns()[i, :], v=V[0:3], w=V[3:6], d=V_dot[0:3], a=V_dot[3:6])


def add_proper_acceleration(lib: Library) -> None:
    """Adds the acceleration of a point of the carrier, less gravity."""
    weight = lib.layout.weight

    @lib.kernel()
    def proper_acceleration(
        O: Reals = argument("the point, in E1", 3),
        V: Reals = argument("", 6),
        V_dot: Reals = argument("", 6),
        g: Reals = argument("gravity in E1", 3),
        d: Reals = result("in E1", 3),
    ) -> None:
        """Acceleration of a point of E1, less gravity."""
        omega, omega_dot = V[3:6], V_dot[3:6]
        velocity: Reals = -cross(O, omega) + V[0:3]
        d[:] = -cross(O, omega_dot) - (g if weight else [0, 0, 0]) + cross(omega, velocity) + V_dot[0:3]


def add_flywheel_columns(lib: Library) -> None:
    """Adds the columns of one flywheel: on the carrier, and on its own drive."""

    @lib.kernel()
    def flywheel_columns(
        mount: Any = argument(struct=lib.layout.mount),
        s: float = argument("sin phi"),
        c: float = argument("cos phi"),
        phi_dot: float = argument(unit="rad/s"),
        phi_ddot: float = argument(unit="rad/s2"),
        V: Reals = argument("", 6),
        V_dot: Reals = argument("", 6),
        g: Reals = argument("gravity in E1", 3),
        Y: Reals = result("in E1 about O1", 6, 10),
        drive: Reals = result("of its drive torque", 10),
    ) -> None:
        """Wrench on the carrier and drive torque by the ten parameters of one flywheel."""
        N = reals(9)  # its axes in E1
        first, second, third = mount.axes[0::3], mount.axes[1::3], mount.axes[2::3]
        N[:] = Matrix([first, second * c + third * s, third * c - second * s]).T.flat
        d = reals(3)  # proper acceleration of its origin, in E1
        lib["proper_acceleration"](mount.origin, V, V_dot, g, d)
        d_s = reals(3)  # in Es: proper acceleration of Os
        a_s = reals(3)  # angular acceleration
        w_s = reals(3)  # angular velocity
        w_turned = reals(3)
        a_turned = reals(3)
        d_s[:] = N.T @ d
        w_turned[:] = N.T @ V[3:6]
        a_turned[:] = N.T @ V_dot[3:6]
        w_s[:] = [phi_dot + w_turned[0], w_turned[1], w_turned[2]]
        a_s[:] = [a_turned[0] + phi_ddot, a_turned[1] + phi_dot * w_turned[2], a_turned[2] - phi_dot * w_turned[1]]
        inside = reals(6, 10)  # in Es
        lib["body_columns"](d_s, a_s, w_s, inside)
        for k in range(10):
            Y[0:3, k] = N @ inside[0:3, k]
            Y[3:6, k] = N @ inside[3:6, k]
            Y[3:6, k] += cross(mount.origin, Y[0:3, k])
            drive[k] = inside[3][k]


def add_regressor(lib: Library) -> None:
    """Adds all columns at a state and a motion."""
    layout = lib.layout
    places: Any = argument("made once by prepare_mounts; only its places are used", struct=layout.mount_table)

    @lib.kernel(
        statuses=STATE_STATUSES,
        purpose="What (8) and the drive torques take of each mass, first moment and moment of inertia: they are linear "
        "in all.",
        notes=(
            "The sum of columns times parameters is F of the laws that have no columns, and tau plus what these laws "
            "do about the spin axis. The carrier's columns are those of all that is fixed in E1, instruments among it.",
        ),
        public=True,
    )
    def regressor(
        table: Any = lib.table,
        mounting: Any = places if layout.flywheels else None,
        x: Any = lib.x,
        V_dot: Reals = argument("derivative of the components of V", 6, unit="m/s2, rad/s2"),
        phi_ddot: Any = lib.phi_ddot,
        out: Any = result("columns", struct=layout.regressor_result),
    ) -> Status:
        """All columns at a state and a motion."""
        check_inputs(lib, table, x, phi_ddot)
        lib["within"](V_dot, 6, lib.limit("MAX_ACCELERATION"))
        seen = scene(lib, table, x)
        d = reals(3)  # proper acceleration of O1
        d[:] = (-seen.g if layout.weight else [0, 0, 0]) + cross(x.V[3:6], x.V[0:3]) + V_dot[0:3]
        a = reals(3)
        w = reals(3)
        a[:] = V_dot[3:6]
        w[:] = x.V[3:6]
        lib["body_columns"](d, a, w, out.Y_carrier)
        if layout.added_mass:
            relative = relative_rate(x, V_dot, seen.stream)
            lib["added_mass_columns"](seen.V, relative, out.Y_added_mass)
        for i in list(range(6)):
            out.Y_linear[i] = seen.V_r[i]
            out.Y_quadratic[i] = seen.V_r[i] * abs(seen.V_r[i])
        if layout.flywheels:
            sine, cosine = seen.turns
            for s in range(layout.count):
                lib["flywheel_columns"](
                    mounting.flywheel[s], sine[s], cosine[s], x.phi_dot[s], phi_ddot[s],
                    x.V, V_dot, seen.g, out.Y_flywheel[s], out.Y_drive[s],
                )  # fmt: skip
        return OK
