"""A run of one stand under a regime: columns with units, a row for each moment of output."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from mahovik.core.stand.hold import freedom_names, has_coordinates
from mahovik.core.stand.model import Stand
from mahovik.core.stand.motor import available_torque, required_torque
from mahovik.core.toolchain.compiled import Block, compile_library
from mahovik.errors import StateError
from mahovik.proof.reference.algebra import carrier_rotation, quaternion_of
from mahovik.use.measured.headers import AXES, CARRIER, RATES, sensors, state_columns, with_units
from mahovik.use.simulate.case import Array, Case, wrap_phases
from mahovik.use.simulate.course import NEEDS, Moments, motion, stand_for, together, why_refused

STATE_COLUMNS = tuple(with_units([*CARRIER["position"], *CARRIER["quaternion"], *CARRIER["V"]]))
"""Columns of the carrier's place, attitude and twist."""


@dataclass(frozen=True, eq=False)
class Run:
    """Columns by name, unit and all. `stopped`: why it ended early, or None; `interrupted`: by the user."""

    columns: Mapping[str, Array]
    stopped: str | None = None
    interrupted: bool = False

    def __getitem__(self, name: str) -> Array:
        """A column by its full name, including the unit."""
        return self.columns[name]

    @property
    def weak_motors(self) -> dict[str, tuple[float, float]]:
        """Flywheels with too weak a motor: time of the worst moment (s), missing torque (N m)."""
        result = {}
        for name, margin in self.columns.items():
            if name.startswith("margin ") and (missing := -float(margin.min())) > 1e-12:
                result[name.split()[1]] = (float(self["t [s]"][np.argmin(margin)]), missing)
        return result


def simulate(
    case: Case, backend: str = "c", mounts: bool = False, progress: Callable[[float], None] | None = None
) -> Run:
    """Run a case. `progress` receives times of output. Raises UsageError, ToolchainError, StateError.

    A motion that leaves its ranges and Ctrl-C end the run early: `stopped` says why. If there is nothing to keep,
    StateError and KeyboardInterrupt are raised.
    """
    needs = NEEDS - {"I"} - (set() if mounts else {"loads"})
    pieces: list[Moments] = []
    stopped, interrupted = None, False
    try:
        block, moments = _moments(case, backend, needs)
        for piece in moments:
            if not piece.t.size:  # refused at once
                break
            pieces.append(piece)
            if progress is not None:
                progress(float(piece.t[-1]))
        if block is not None and (why := why_refused(case.stand, block, 0)):
            raise StateError(why)
    except StateError as error:
        if not pieces:
            raise
        stopped = str(error)
    except KeyboardInterrupt:
        if not pieces:
            raise
        stopped, interrupted = f"stopped at t = {pieces[-1].t[-1]:.6g} s of {case.until:g} s", True
    return Run(columns_of(case.stand, pieces), stopped, interrupted)


def _moments(case: Case, backend: str, needs: Collection[str]) -> tuple[Block | None, Iterator[Moments]]:
    start = case.start
    C = carrier_rotation(case.stand, start)
    y = np.array([*start.position, *(start.quaternion or quaternion_of(C)), *start.V])
    if backend == "scipy":
        from mahovik.use.simulate import judge

        return None, judge.motion(case, y, needs)
    stand = stand_for(case.stand, case.regime)
    made = compile_library(stand, case.real, kind="states")
    x = np.array([*y, *wrap_phases(case.phi0), *case.phi_dot0])
    _, block, parts = next(together(case, made, x[:, None], None))
    return block, motion(case, block, needs, parts)


def columns_of(stand: Stand, pieces: Sequence[Moments]) -> dict[str, Array]:
    """Columns by name, each name with its unit, of one sample."""

    def whole(name: str) -> Array:
        return np.concatenate([getattr(piece, name)[:, :, 0] for piece in pieces]).astype(np.float64)

    t, state, V_dot = np.concatenate([piece.t for piece in pieces]), whole("state"), whole("V_dot")
    N = len(stand.flywheels)
    state[:, 3:7] /= np.sqrt((state[:, 3:7] ** 2).sum(axis=1))[:, None]
    columns = {"t [s]": t}

    def add(names: Sequence[str], values: Array) -> None:
        columns.update(zip(names, values.T, strict=True))

    headers = {key: with_units(group) for key, group in state_columns(stand).items()}
    add(STATE_COLUMNS, state[:, :13])
    add(headers["V_dot"], V_dot)
    phi, phi_ddot, tau = whole("phi"), whole("phi_ddot"), whole("tau")
    for i, s in enumerate(stand.flywheels):
        speed = state[:, 13 + N + i]
        names = [headers[key][i] for key in ("phi", "phi_dot", "phi_ddot", "tau")]
        add(names, np.column_stack([phi[:, i], speed, phi_ddot[:, i], tau[:, i]]))
        if s.motor is not None:
            torque = columns[f"motor {s.name} [N m]"] = required_torque(s.motor, tau[:, i], speed)
            if s.motor.limit:
                margin = available_torque(s.motor, torque, speed) - np.abs(torque)
                columns[f"margin {s.name} [N m]"] = np.where(np.isfinite(margin), margin, 0.0)
    if stand.hold is not None:
        add(headers["reaction"], whole("reaction"))
        names = coordinate_columns(stand)
        add(names, _count_turns(names, whole("coordinates")[:, : len(names)], t))
    readings = whole("readings")
    for k, sensor in enumerate(sensors(stand)):  # position, C, twist, force, angular acceleration
        add([f"force_{a} {sensor} [m/s2]" for a in AXES], readings[:, 24 * k + 18 : 24 * k + 21])
        add([f"gyro_{a} {sensor} [rad/s]" for a in AXES], readings[:, 24 * k + 15 : 24 * k + 18])
    loads = whole("loads")
    if loads.size:
        add(headers["mount_wrench"], loads)
    return columns


def coordinate_columns(stand: Stand) -> list[str]:
    """Columns of a run for the coordinates of the freedoms and their rates; none where the hold has no coordinates."""
    hold = stand.hold
    if hold is None or not has_coordinates(hold):
        return []
    columns = state_columns(stand)
    rates = [
        (f"q_dot {name}", RATES[freedom.kind][0])
        for name, freedom in zip(freedom_names(hold), hold.freedoms, strict=True)
    ]
    return with_units([*columns.get("q", ()), *columns.get("orientation", ()), *rates])


def _count_turns(names: Sequence[str], columns: Array, t: Array) -> Array:
    """The columns with whole turns added to angles: each moment is the one nearest to what its speeds give."""
    for k, name in enumerate(names):
        if name.startswith("q ") and name.endswith("[rad]"):
            angle, speed = columns[:, k], columns[:, names.index(f"q_dot {name.split()[1]} [rad/s]")]
            off = (speed[1:] + speed[:-1]) / 2 * np.diff(t) - np.diff(angle)
            angle[1:] += 2.0 * np.pi * np.cumsum(np.round(off / (2.0 * np.pi)))
    return columns
