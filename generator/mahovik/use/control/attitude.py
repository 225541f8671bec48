"""Settings of an attitude loop, and the scenario of its example, from the stand and a few options.

The loop demands of the task of a stand the angular acceleration that quaternion feedback wants (Wie, Weiss,
Arapostathis, 1989): errors of the attitude obey s^2 + 2 zeta omega s + omega^2. A reference turns about the eigenaxis,
no faster than a part (`PART`) of what the flywheels reach in every direction with one of them missing.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from mahovik.core.stand.capacity import Array, Envelope, momentum_capacity, torque_capacity
from mahovik.core.stand.masses import inertia_about_origin, mass_properties, placed_bodies
from mahovik.core.stand.model import Flywheel, Stand, Task
from mahovik.core.stand.motor import UNLIMITED, Motor
from mahovik.errors import UsageError
from mahovik.nearest import suggestion

Failure = Literal["coasts", "held", "none"]

ROWS = ("wx", "wy", "wz")
"""Components that the task of a loop demands, in any order."""

PART = 0.25
"""Part of the reach of the flywheels that a reference uses: the rest is for errors and stored momentum."""

PREFERRED_SHARE = 0.1
"""Preferred speed as a part of the no-load speed."""

SPEED = 100.0
"""Preferred speed of flywheels without a no-load speed, rad/s."""

SLOWEST = 0.01, 0.05
"""Angular acceleration (rad/s2) and velocity (rad/s) of a reference where motors have no limits."""

FASTEST = 0.1
"""Largest angular velocity of a reference, rad/s."""

TURN = 0.8
"""Largest turn of a flywheel in a step of the plant at the largest speed that is expected, rad."""

MOST_STEP = 0.3
"""Largest bandwidth times sample period: above it the sampled loop differs from the continuous one."""

INTEGRAL = 0.25
"""Rate of the integral as a part of the bandwidth: poles at -0.66 omega and (-0.47 +- 0.40 i) omega for damping 0.8."""

SETTLE = 25.0
"""Settling time of the example times the bandwidth in rad/s: e^-11 is left of an error."""

SLEW = math.radians(30.0)
"""Slew of the example, about the axis of E1 along which the flywheels hold most momentum: there they hold it."""


@dataclass(frozen=True)
class LoopOptions:
    """Rates, task and scenario from which the settings are computed.

    task        name; None: the stand's only one
    rate        sample rate, Hz
    bandwidth   of the loop, Hz; damping: its ratio
    momentum    angular momentum of the example's carrier and flywheels, N m s
    failure     of the first flywheel, half-way
    """

    task: str | None = None
    rate: float = 50.0
    bandwidth: float = 0.1
    damping: float = 0.8
    momentum: float = 1.0
    failure: Failure = "coasts"


@dataclass(frozen=True)
class AttitudeDesign:
    """Settings of the loop as the members of its struct, and numbers of the example.

    task      the demanded rows are wx, wy, wz, in its order
    dumps     the carrier takes a run-time wrench, so that momentum can be dumped
    speeds    of the flywheels at the beginning, rad/s
    parts     steps of the plant in a sample
    lines     what was computed, a line each
    """

    task: Task
    dumps: bool
    settings: Mapping[str, float | tuple[float, ...]]
    speeds: tuple[float, ...]
    goal: tuple[float, ...]
    momentum: float
    failure: Failure
    parts: int
    samples: Mapping[str, int]
    lines: tuple[str, ...]


def design_attitude(stand: Stand, options: LoopOptions) -> AttitudeDesign:
    """Settings of the loop. UsageError: no such task, no flywheels that reach it, options out of bounds."""
    task = attitude_task(stand, options.task)
    period, omega = _check_rates(options)
    axes = np.array([p.axes[:, 0] for p in placed_bodies(stand) if isinstance(p.body, Flywheel)]).reshape(-1, 3)
    spins = np.array([float(inertia_about_origin(wheel)[0, 0]) for wheel in stand.flywheels])
    if np.linalg.matrix_rank(axes, tol=1e-6) < 3:
        raise UsageError(
            f'attitude: "{stand.name}": the spin axes of its flywheels do not span space, so that they cannot turn the '
            "carrier in every direction; expected three at least, with axes that lie in no plane"
        )
    if options.failure != "none" and np.linalg.matrix_rank(axes[1:], tol=1e-6) < 3:
        raise UsageError(
            f'attitude failure {options.failure}: without its first flywheel "{stand.flywheels[0].name}" the stand '
            f'"{stand.name}" cannot be turned in every direction; expected a fourth flywheel, or failure=none'
        )
    motors = [wheel.motor or UNLIMITED for wheel in stand.flywheels]
    preferred = _preferred_speeds(axes, spins, motors)
    capacity = momentum_capacity(stand).alone
    along = np.eye(3)[int(np.argmax(np.round(capacity, 9)))]  # where the flywheels hold most
    for_unit = np.linalg.pinv(axes.T * spins) @ along
    # The last digits of a pseudo-inverse differ from processor to processor; the emitted C has the same everywhere.
    speeds = np.round(preferred + options.momentum * for_unit, 9)
    _check_speeds(stand, preferred, for_unit, options.momentum)
    fastest, quickest = _limits(stand, float(np.abs(speeds).max()))
    dumps = stand.carrier.wrench_input
    torque = min((m.at_rest for m in motors if m.at_rest is not None), default=0.1) / 2
    settings: dict[str, float | tuple[float, ...]] = {
        "period": period,
        "bandwidth": omega,
        "damping": options.damping,
        "integral": INTEGRAL * omega,
        "integral_most": 0.1,
        "closing_rate": fastest,
        "slew_rate": fastest,
        "slew_acceleration": quickest,
        "preferred": tuple(float(v) for v in preferred),
        "preferred_rate": 0.02 if preferred.any() else 0.0,
        "avoid": 0.1 * float(np.abs(preferred).max()),
        "viscous": tuple(0.0 if m is None else m.viscous for m in motors),
        "coulomb": tuple(0.0 if m is None else m.coulomb for m in motors),
        "coulomb_speed": tuple(1.0 if m is None else m.coulomb_speed for m in motors),
    }
    samples = {"told": max(1, round(0.1 / period)), "settle": round(SETTLE / (omega * period)) + 4}
    samples["last"] = samples["settle"] // 4
    if dumps:
        dump_rate, end = omega / 5, 1e-3 * max(options.momentum, 0.1)
        settings |= {
            "wanted_momentum": (0.0, 0.0, 0.0),
            "dump_rate": dump_rate,
            "dump_torque": torque,
            "dump_begin": 5 * end,
            "dump_end": end,
        }
        time = options.momentum / torque + math.log(max(torque / dump_rate / end, 1.0)) / dump_rate
        samples["dump"] = round(1.1 * time / period) + samples["settle"]
    half = SLEW / 2
    most = max(float(np.abs(speeds).max()), PREFERRED_SHARE * _no_load(motors)) * 2
    return AttitudeDesign(
        task, dumps, settings, tuple(float(v) for v in speeds),
        (math.cos(half), *(math.sin(half) * float(a) for a in along)), options.momentum, options.failure,
        max(1, math.ceil(period * most / TURN)), samples, _lines(stand, task, options, settings),
    )  # fmt: skip


def attitude_task(stand: Stand, name: str | None) -> Task:
    """The task of a loop: of that name, or the only one.

    UsageError: a held carrier; no task, several, or other rows than wx, wy, wz.
    """
    if stand.hold is not None:
        raise UsageError(
            f'attitude: "{stand.name}": hold: the loop demands a task, which a held carrier does not have; turn it '
            "by `inverse_fast` and `torque` of its C, as docs/held/turn.c does, or take "
            "[hold] out"
        )
    names = [task.name for task in stand.tasks]
    if name is None and len(names) != 1:
        reason = "no task: add [task.pointing] to its file"
        if names:
            reason = f"tasks {', '.join(names)}: give attitude=NAME"
        raise UsageError(f'attitude: "{stand.name}": {reason}, with rows = ["wx", "wy", "wz"]')
    wanted = name if name is not None else names[0]
    task = next((item for item in stand.tasks if item.name == wanted), None)
    if task is None:
        raise UsageError(f'attitude task {wanted}: stand "{stand.name}" has no such task{suggestion(wanted, names)}')
    rows = [f"{row.of}.{row.component}" if row.of else row.component for row in task.rows]
    if sorted(rows) != list(ROWS):
        raise UsageError(
            f'task "{task.name}": its rows are {", ".join(rows)}; an attitude loop demands the angular acceleration of '
            "the carrier alone: expected wx, wy, wz"
        )
    return task


def _check_rates(options: LoopOptions) -> tuple[float, float]:
    """Sample period (s) and bandwidth (rad/s)."""
    for option, value, most in (
        ("attitude rate", options.rate, 1e5),
        ("attitude bandwidth", options.bandwidth, 1e3),
        ("attitude damping", options.damping, 10.0),
    ):
        if not 0.0 < value <= most:
            raise UsageError(f"{option} {value:g}: expected a number above 0, at most {most:g}")
    if not 0.0 <= options.momentum <= 1e6:
        raise UsageError(f"attitude momentum {options.momentum:g}: expected N m s, 0 or more")
    period, omega = 1.0 / options.rate, 2 * math.pi * options.bandwidth
    if omega * period > MOST_STEP:
        least = omega / MOST_STEP
        raise UsageError(
            f"attitude rate {options.rate:g}: too slow for a bandwidth of {options.bandwidth:g} Hz; expected "
            f"{least:.3g} Hz or more"
        )
    if 1.0 / options.rate > 10.0 or options.damping < 0.2:
        raise UsageError("attitude rate, damping: expected at least 0.1 Hz and 0.2")
    return period, omega


def _limits(stand: Stand, speed: float) -> tuple[float, float]:
    """Angular velocity and acceleration of a reference: a part of what is reached with one flywheel missing.

    `speed`: largest speed of a flywheel at its beginning, rad/s, which takes a part of momentum and torque.
    """
    left = max(0.1, 1.0 - speed / _no_load([wheel.motor or UNLIMITED for wheel in stand.flywheels]))
    inertia = mass_properties(stand).principal_inertia[-1]
    reach = [_reach_without_one(c.vectors) for c in (momentum_capacity(stand), torque_capacity(stand))]
    rate = min(PART * left * reach[0] / inertia, FASTEST) if reach[0] > 0 else SLOWEST[1]
    return rate, PART * left * reach[1] / inertia if reach[1] > 0 else SLOWEST[0]


def _reach_without_one(vectors: tuple[tuple[float, float, float], ...]) -> float:
    """Radius of the largest sphere in the envelope without its weightiest vector; with all where three are needed."""
    columns = np.array(vectors)
    least = min(Envelope(np.delete(columns, s, axis=0)).radius for s in range(len(columns)))
    return least if least > 0.0 else Envelope(columns).radius


def _preferred_speeds(axes: Array, spins: Array, motors: list[Motor]) -> Array:
    """Speeds (N), rad/s, whose momenta cancel, as equal as that allows; zero where three axes leave no such speeds."""
    columns = axes.T * spins
    project = np.eye(len(spins)) - np.linalg.pinv(columns) @ columns
    if np.abs(project).max() < 1e-9:
        return np.zeros(len(spins))
    tries = [np.where(column < 0.0, -1.0, 1.0) for column in project]
    best = min(tries, key=lambda signs: float(np.linalg.norm(columns @ signs)))
    free: Array = project @ best
    largest = float(np.abs(free).max())
    return free * (PREFERRED_SHARE * _no_load(motors) / largest if largest > 1e-9 else 0.0)


def _no_load(motors: list[Motor]) -> float:
    """Least no-load speed, rad/s."""
    return min((m.no_load for m in motors if m.no_load is not None), default=SPEED / PREFERRED_SHARE)


def _check_speeds(stand: Stand, preferred: Array, for_unit: Array, momentum: float) -> None:
    """UsageError where preferred + momentum * for_unit (N), rad/s, is above 70 % of a no-load speed."""
    most, first = math.inf, ""
    for wheel, speed, more in zip(stand.flywheels, preferred, for_unit, strict=True):
        limit = (wheel.motor or UNLIMITED).no_load
        if limit is not None and abs(more) > 0.0:
            room = (0.7 * limit - math.copysign(1.0, more) * speed) / abs(more)
            most, first = min((most, first), (float(room), wheel.name))
    if momentum > most:
        raise UsageError(
            f'attitude momentum {momentum:g}: flywheel "{first}" would turn above 70 % of its no-load speed; expected '
            f"at most {0.999 * most:.3g} N m s"
        )


def _lines(stand: Stand, task: Task, options: LoopOptions, settings: Mapping[str, Any]) -> tuple[str, ...]:
    """What was computed, a line each."""
    rate, acceleration = (math.degrees(settings[key]) for key in ("slew_rate", "slew_acceleration"))
    lines = [
        f"attitude loop: task {task.name}, {options.rate:g} Hz; bandwidth "
        f"{options.bandwidth:.4g} Hz, damping {options.damping:g}",
        f"attitude loop: slews of at most {rate:.3g} deg/s and {acceleration:.3g} deg/s2",
    ]
    if "dump_torque" in settings:
        lines.append(f"attitude loop: momentum is dumped by at most {settings['dump_torque']:.3g} N m")
    else:
        lines.append(f'attitude loop: the carrier of "{stand.name}" has no wrench_input: momentum is not dumped')
    free = [w.name for w in stand.flywheels if (w.motor or UNLIMITED).peak is None]
    if free:
        lines.append(
            f"attitude loop: no torque of {', '.join(free)} is bounded: the stand file gives none of the motor"
        )
    return tuple(lines)
