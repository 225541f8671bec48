"""Columns of a run: names with units, and their numbers at one time."""

from __future__ import annotations

import math
from collections.abc import Iterator

from mahovik.core.motion.motor import available, needed
from mahovik.core.stand.model import WRENCH_LETTERS, Motor, Stand
from mahovik.use.simulate.moment import Moment

_AXES = "xyz"


def column_names(stand: Stand, mounts: bool) -> list[str]:
    """Column names in order, each with its unit."""
    found = ["t [s]", *(f"{a} [m]" for a in _AXES), "qw", "qx", "qy", "qz"]
    found += [f"v_{a} [m/s]" for a in _AXES] + [f"omega_{a} [rad/s]" for a in _AXES]
    found += [f"v_dot_{a} [m/s2]" for a in _AXES] + [f"omega_dot_{a} [rad/s2]" for a in _AXES]
    for s in stand.flywheels:
        found += [f"phi {s.name} [rad]", f"phi_dot {s.name} [rad/s]", f"phi_ddot {s.name} [rad/s2]"]
        found.append(f"tau {s.name} [N m]")
        if s.motor is not None:
            found.append(f"motor {s.name} [N m]")
            if s.motor.torque is not None:
                found.append(f"margin {s.name} [N m]")
    for name in (*(p.name for p in stand.instruments), *(p.name for p in stand.points)):
        found += [f"force_{a} {name} [m/s2]" for a in _AXES]
        found += [f"gyro_{a} {name} [rad/s]" for a in _AXES]
    if mounts:
        for s in stand.flywheels:
            units = ("N",) * 3 + ("N m",) * 3
            found += [f"mount_{a} {s.name} [{u}]" for a, u in zip(WRENCH_LETTERS, units, strict=True)]
    return found


def column_values(stand: Stand, moment: Moment) -> list[float]:
    """Numbers of these columns at one time."""
    state = moment.state
    found = [moment.t, *state.position, *(state.quaternion or (1.0, 0.0, 0.0, 0.0)), *state.V, *state.V_dot]
    for i, s in enumerate(stand.flywheels):
        tau, speed = float(moment.tau[i]), state.phi_dot[i]
        found += [float(moment.phi[i]), speed, state.phi_ddot[i], tau]
        if s.motor is not None:
            found += _motor(s.motor, tau, speed)
    for reading in moment.points.values():
        found += [float(x) for x in (*reading["specific_force"], *reading["twist"][3:])]
    if moment.mounts is not None:
        found += [float(x) for row in moment.mounts for x in row]
    return found


def _motor(motor: Motor, tau: float, speed: float) -> Iterator[float]:
    """Torque of the motor itself, and how much more it could give."""
    own = needed(motor, tau, speed)
    yield own
    if motor.torque is not None:
        most = available(motor, own, speed)
        yield most - abs(own) if math.isfinite(most) else 0.0
