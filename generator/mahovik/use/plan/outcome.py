"""A plan: options, the budget of its search, progress and outcome; programmes with their hashes, figures and findings.

A budget is in steps: the same file and seed give the same programme. Time and Ctrl-C cut it short.
"""

from __future__ import annotations

import signal
import threading
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from typing import Any, Literal, Protocol

import numpy as np

from mahovik.core.motion.functions import Angles, Samples
from mahovik.core.motion.programme import Programme
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.stand.model import Stand
from mahovik.core.stand.motor import available_torque, required_torque
from mahovik.errors import whole_number
from mahovik.use.numeric.mechanics import Mechanics
from mahovik.use.numeric.se3 import Array
from mahovik.use.plan.problem import FlywheelMotion


@dataclass
class Budget:
    """Steps of Levenberg-Marquardt that may be taken, and `seconds` since creation: a cut-off, reported in the result.

    interrupted   whether the user pressed Ctrl-C during work that can stop with its best result so far
    """

    steps: int
    seconds: float | None = None
    steps_taken: int = 0
    cut: bool = False
    interrupted: bool = False
    _start: float = field(default_factory=time.monotonic)

    def step(self) -> bool:
        """Count a step; False if none is left."""
        if self.seconds is not None and self.elapsed > self.seconds:
            self.cut = True
        if self.exhausted:
            return False
        self.steps_taken += 1
        return True

    def interrupt(self) -> None:
        """Record Ctrl-C."""
        self.interrupted = True

    def is_spent(self) -> bool:
        """Whether time has run out or the user interrupted, for work that does not count steps."""
        if self.seconds is not None and self.elapsed > self.seconds:
            self.cut = True
        return self.cut or self.interrupted

    def seconds_left(self, share: float = 1.0) -> float | None:
        """This share of the remaining seconds; None: unlimited."""
        return None if self.seconds is None else max(share * (self.seconds - self.elapsed), 0.0)

    @property
    def exhausted(self) -> bool:
        """Whether the search must end."""
        return self.cut or self.interrupted or self.steps_taken >= self.steps

    @property
    def elapsed(self) -> float:
        """Time since the search began, s."""
        return time.monotonic() - self._start


@contextmanager
def defer_interrupt(mark: Callable[[], None], *, again: bool) -> Iterator[None]:
    """Ctrl-C calls `mark` and work continues; with `again` a second one interrupts. Only in the main thread."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return

    def interrupt(*_: object) -> None:
        mark()
        if again:
            signal.signal(signal.SIGINT, signal.default_int_handler)

    before = signal.signal(signal.SIGINT, interrupt)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


@dataclass(frozen=True)
class PlanOptions:
    """Options of a plan. Raises UsageError for those without meaning.

    seed     of all random numbers; the same file and seed give the same programme
    seconds  time limit; None: only the budget of starts and steps ends the search
    enough   programmes of each kind of winding to choose from
    verify   whether to verify the programmes independently
    steps    limit of steps of search and optimisation
    start    motion of the flywheels, over the shortest period, to be made a programme without a search
    """

    seed: int = 0
    seconds: float | None = None
    enough: int = 1
    verify: bool = True
    steps: int = 20_000
    start: FlywheelMotion | Samples | None = None

    def __post_init__(self) -> None:
        whole_number("seed", self.seed, 0)


Status = Literal["OK", "OK_LIMIT", "NO_PROGRAM", "SINGULAR_ATTITUDE"]
"""Outcomes of planning. A bad input raises MotionError or StandError before anything is planned."""


class Progress(Protocol):
    """Progress of planning."""

    @property
    def doing(self) -> str:
        """Name of the activity: searching, improving, run-up, run-down, verifying."""

    @property
    def words(self) -> str:
        """One line."""


OnProgress = Callable[[Progress], None]


@dataclass(frozen=True)
class Plan:
    """Outcome of planning.

    status      OK; OK_LIMIT: a bound is exceeded, or no run-up was found; NO_PROGRAM with a `reason` of preflight
                (proven) or SEARCH (not)
    words       reasons, one per line: the refusal, or the exceeded bounds and their excess
    warnings    further remarks, one per line
    programmes  the best one, if any
    effort      starts, steps, windings tried, best residual, seed, whether time cut the search
    """

    status: Status
    reason: str | None
    words: tuple[str, ...]
    warnings: tuple[str, ...]
    programmes: tuple[Programme, ...]
    effort: Mapping[str, Any] = field(default_factory=dict)
    interrupted: bool = False


TABLES = {"runup": "run-up", "rundown": "run-down"}
"""Optional tables of a programme: key in the file, and name in messages."""


def certify(stand: Stand, motion: RequiredMotion, programme: Programme) -> Programme:
    """The programme with the findings of the independent verification in its report."""
    from mahovik.proof.verify.programme.verification import as_item, verify_programme

    checks = verify_programme(stand, motion, programme)
    items = [as_item(item) for item in checks]
    values = {finding["name"]: finding["value"] for finding in items}
    words = {
        "verified": not any(item.failed for item in checks),
        "simulation_error": values.get("simulation"),
        "verification": items,
    }
    return replace(programme, report={**programme.report, **words})


def failed_items(programme: Programme, of: str = "") -> str:
    """Failed items of the verification, in words, except bounds, which are reported separately. Empty if none failed.

    `of`: only items whose names begin with this.
    """
    items = [item for item in programme.report.get("verification", ()) if item["name"].startswith(of)]
    wrong = [item for item in items if not item["passed"] and "bound" not in item["name"].split()]
    values = [f"{item['value']:.3g}, at most" if item["value"] is not None else "not finite, at most" for item in wrong]
    lines = [
        f"{item['name']} {value} {item['limit']:.3g}, {item['words']}"
        for item, value in zip(wrong, values, strict=True)
    ]
    return "; ".join(lines)


def drop_refused_tables(programme: Programme) -> Programme:
    """Leave out a run-up or run-down that the verification refuses; its report has the reason under `reason`.

    The programme does not depend on them. The findings about such a table leave its verification, too.
    """
    report = dict(programme.report)
    for key, name in TABLES.items():
        wrong = failed_items(programme, f"{name} ")
        if not wrong:
            continue
        left = [item for item in report["verification"] if not item["name"].startswith(f"{name} ")]
        report["verification"], report["verified"] = left, all(item["passed"] for item in left)
        report[key] = {"reason": f"{name}: found, but refused by the verification: {wrong}"}
        programme = replace(programme, runup=None) if key == "runup" else replace(programme, rundown=None)
    return replace(programme, report=report)


def peaks(angles: Angles, tau: Array) -> dict[str, Any]:
    """Largest speed, acceleration and torque (N each) of a motion for a report; rad, s, N m."""
    return {
        "peak_speed": np.abs(angles.phi_dot).max(axis=0),
        "peak_acceleration": np.abs(angles.phi_ddot).max(axis=0),
        "peak_torque": np.abs(tau).max(axis=0),
    }


def motor_shortage(stand: Stand, phi_dot: Array, tau: Array) -> dict[str, list[float]]:
    """How much torque motors lack at most along a motion (M, N), with their friction; nothing where none is limited."""
    motors = [flywheel.motor for flywheel in stand.flywheels]
    if not any(motor is not None and motor.limit for motor in motors):
        return {}
    lacking = []
    for s, motor in enumerate(motors):
        needed = tau[:, s] if motor is None else required_torque(motor, tau[:, s], phi_dot[:, s])
        most = np.inf if motor is None else available_torque(motor, needed, phi_dot[:, s])
        lacking.append(max(0.0, float(np.max(np.abs(needed) - most))))
    return {"motor_shortage": lacking}


def regularity(mechanics: Mechanics, phi: Array, *, periodic: bool) -> dict[str, Any]:
    """How regular (12) is at angles (M, N), for a report.

    Least singular value of K^-1/2 I Theta_ff^-1/2, and the number of sign changes of det I, `periodic`: also from the
    last moment to the first; None unless there are six flywheels. Of a held carrier, rows along its m freedoms take the
    place of the six.
    """
    (K, I), S = mechanics.mass_and_coupling(phi), mechanics.freedoms
    factor, columns = np.linalg.cholesky(S.T @ K @ S), S.T @ I / np.sqrt(mechanics.tables.Theta_ff)
    scaled = np.linalg.solve(factor, columns)
    sigma, changes = np.linalg.svd(scaled, compute_uv=False), None
    if scaled.shape[1] == mechanics.N:
        signs = np.linalg.det(scaled) < 0.0  # of G^-1 I Theta_ff^-1/2 with K = G G^T: the sign is that of det I
        changes = int(np.sum(signs[1:] != signs[:-1])) + int(periodic and signs[0] != signs[-1])
    return {"least_singular_value": float(sigma.min()) if sigma.size else 0.0, "det_I_sign_changes": changes}


SAME = 1e-6
"""A speed or torque is no more than another if it is so by this part: periods are written with some digits."""


def motor_warnings(stand: Stand, report: Mapping[str, Any]) -> tuple[str, ...]:
    """One line for each peak torque (N m) or speed (rad/s) of a report above the motor's, or torque lacking at a speed.

    Peaks are compared with the motor's numbers, as they are in the file. A flywheel without a motor, or whose motor has
    no limit, has no line.
    """
    result = list(_exceeding(stand, report["peak_torque"], report["peak_speed"], report.get("motor_shortage"), ""))
    for key, name in TABLES.items():
        if peak := report.get(key, {}).get("peak"):
            result += _exceeding(stand, peak["torque"], peak["speed"], peak.get("motor_shortage"), f" in the {name}")
    return tuple(result)


def _exceeding(
    stand: Stand, torques: Sequence[float], speeds: Sequence[float], lacking: Sequence[float] | None, where: str
) -> Iterator[str]:
    rows = zip(stand.flywheels, torques, speeds, lacking or [0.0] * len(torques), strict=True)
    for flywheel, torque, speed, short in rows:
        motor = flywheel.motor
        if motor is None:
            continue
        asked = (("torque", "N m", torque, motor.peak), ("speed", "rad/s", speed, motor.no_load))
        over = [(kind, unit, value, most) for kind, unit, value, most in asked if most and value > most * (1 + SAME)]
        if not over and short > SAME * torque:
            yield (
                f"{flywheel.name}: its motor, weaker at speed, lacks {short:.4g} N m{where}, which the search does not "
                "heed: add torque or speed to the bounds of the motion, or ask for less"
            )
        for kind, unit, value, most in over:
            yield (
                f"{flywheel.name}: peak {kind}{where} {value:.4g} {unit} is above its motor's {most:.4g} {unit}, "
                f"which the search does not heed: add {kind} to the bounds of the motion, or ask for less"
            )
