"""points: readings of an accelerometer and a gyro at each instrument and point."""

from __future__ import annotations

from typing import Any

from mahovik.core.lower.forward import STATE_STATUSES, check_inputs
from mahovik.core.lower.library import Library
from mahovik.core.program.expression import Status
from mahovik.core.program.kernel import OK, Reals, argument, reals, result
from mahovik.core.program.vector import cross


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
