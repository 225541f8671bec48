"""Columns of a run of `mahovik simulate` as channels: its readings serve as data for practice and tests."""

from __future__ import annotations

import re
from collections.abc import Iterable

MARKS = ("qw", "v_x [m/s]", "omega_x [rad/s]")
"""Columns that every run has, and no measured data."""

NOTE = "a run of mahovik simulate: readings and flywheels are taken as measured"

SENSORS = {"force": "acceleration", "gyro": "rate"}
FLYWHEELS = {"phi": "phase", "phi_dot": "speed", "tau": "torque"}

_SENSOR = re.compile(r"(force|gyro)_([xyz]) (.+) (\[.+\])")
_FLYWHEEL = re.compile(r"(phi|phi_dot|tau) (.+) (\[.+\])")
_MOUNT = re.compile(r"mount_([XYZKMN]) (.+) (\[.+\])")
_STATE = re.compile(
    r"[xyz] \[.+\]|q[wxyz]|orientation_[wxyz]|(v|omega|v_dot|omega_dot)_[xyz] \[.+\]"
    r"|(phi_ddot|motor|margin|q|q_dot) .+ \[.+\]"
)


def is_run(columns: Iterable[str]) -> bool:
    """Whether a table with these columns is a run."""
    found = set(columns)
    return all(mark in found for mark in MARKS)


def is_state(column: str) -> bool:
    """Whether a column of a run is of its states, motors or coordinates, which are no measured data."""
    return _STATE.fullmatch(column) is not None


def run_header(column: str) -> str | None:
    """Header of a channel, `acc1.acceleration.x [m/s2]`, of a column of a run; None: it is no channel."""
    if column.startswith("t [") or "." in column.partition(" [")[0]:
        return column  # a header of measured data as it is, such as hold.reaction.x [N]
    if sensor := _SENSOR.fullmatch(column):
        return f"{sensor[3]}.{SENSORS[sensor[1]]}.{sensor[2]} {sensor[4]}"
    if flywheel := _FLYWHEEL.fullmatch(column):
        return f"{flywheel[2]}.{FLYWHEELS[flywheel[1]]} {flywheel[3]}"
    if mount := _MOUNT.fullmatch(column):
        return f"{mount[2]}.mount.{mount[1].lower()} {mount[3]}"
    return None
