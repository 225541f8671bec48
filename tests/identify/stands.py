"""Stands with sensors, and runs at given speeds, for tests of identification."""

from __future__ import annotations

from collections.abc import Sequence

from mahovik.core.motion.laws import Constant
from mahovik.core.motion.regime import FlywheelRegime, Regime
from mahovik.out.api.stands import Stand, example


def bench8(flywheels: int = 8) -> Stand:
    """bench8 with an IMU, of its first flywheels."""
    keys = example("bench8").to_dict()
    keys["flywheel"] = keys["flywheel"][:flywheels]
    keys["point"] = [{"name": "imu", "position": [0.15, 0.12, 0.08], "angles": [0.3, -0.2, 0.1]}]
    return Stand.from_dict(keys)


def constant(stand: Stand, speeds: Sequence[float], phases: Sequence[float] | None = None) -> Regime:
    """Constant speeds (rad/s) from given phases (rad; 0)."""
    phases = phases or [0.0] * len(speeds)
    wheels = zip(stand.flywheels, speeds, phases, strict=True)
    return Regime("constant", tuple(FlywheelRegime(s.name, Constant(w), p) for s, w, p in wheels), {})
