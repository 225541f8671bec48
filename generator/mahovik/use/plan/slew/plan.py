"""A programme for a slew, or the reason why there is none: reach, time law, exact motion, limits, table."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from mahovik.core.motion.functions import Angles, PlannedCourse, Samples
from mahovik.core.motion.motion_file import motion_of_slew
from mahovik.core.motion.programme import Programme
from mahovik.core.motion.required import SINGULAR, Slew, rows_of
from mahovik.core.stand.masses import mean_stand
from mahovik.core.stand.model import Stand
from mahovik.errors import StateError
from mahovik.use.numeric.mechanics import Mechanics
from mahovik.use.numeric.residual import Norm, prescribe, residual, torques
from mahovik.use.numeric.se3 import Array
from mahovik.use.plan.certificate import certify, failed_items, make_programme, peaks
from mahovik.use.plan.outcome import Plan, Status
from mahovik.use.plan.slew.dynamics import SLOWER, Demand, Exact, SlewMotion
from mahovik.use.plan.slew.share import (
    Limits,
    LimitUse,
    Mean,
    NoSlewError,
    Path,
    PathTable,
    choices,
    limit_uses,
    unreached_motion,
)
from mahovik.use.plan.slew.timing import Law, Sharp, quietest, sharpest, smooth
from mahovik.use.plan.unbalance import unbalance_effect

TOLERANCE = 3e-7
"""Relative residual of (12) between the rows of the table that ends the refinement."""

ACCEPTED_RESIDUAL = 8e-7
"""Residual that is enough where closer rows do not help, as rounding of phi counts over the square of the distance."""

SHORTEST = 4096
"""Rows over the whole time, were all as close as the closest may be; closer if an uneven flywheel turns by TURN / 2."""

MOST_ROWS = 8192

TURN = 2.0 * np.pi / 20.0
"""rad: the furthest that a flywheel turns between rows, at the first try."""

FINE, COARSE = 8, 4
"""Rows in an interval of the time law where it bends; intervals between rows elsewhere."""

EVEN = 1e-9
"""Part of a flywheel's inertia below which what turns with it is rounding."""

NEAR = 0.995
"""Share of the limits that the fastest slew is to use at least."""

AIM = -1.5e-3
"""Logarithm of the share that is aimed at."""

STANDING = 1e-6
"""Part of a flywheel's peak speed below which it stands still."""

_ROUNDS = 10

_ABSURD = 1e3
"""Share of a limit beyond which no duration is tried."""


def plan_slew(stand: Stand, slew: Slew, verify: bool = True, say: Callable[[str], None] = lambda _: None) -> Plan:
    """The programme of a slew. `say` hears what is being done."""
    try:
        say("searching")
        planned = mean_stand(stand) if slew.unbalance == "averaged" else stand
        made, sharp = _search(planned, slew)
    except NoSlewError as error:
        status: Status = "NO_PROGRAM" if error.reason else "SINGULAR_ATTITUDE"
        return Plan(status, error.reason, (error.words,), slew.doubts, ())
    except StateError as error:
        return Plan("NO_PROGRAM", "SEARCH", (str(error),), slew.doubts, ())
    programme = _programme(stand, slew, made, sharp)
    if slew.unbalance == "averaged":
        say("simulating with unbalance")
        programme = _with_unbalance(stand, slew, programme)
    if verify:
        say("verifying")
        programme = certify(stand, motion_of_slew(slew, programme), programme)
        if wrong := failed_items(programme):
            words = f"a programme was found and refused by the verification: {wrong}"
            return Plan("NO_PROGRAM", "SEARCH", (words,), slew.doubts, ())
    return Plan("OK", None, (), slew.doubts, (programme,))


def _search(stand: Stand, slew: Slew) -> tuple[Table, Sharp | None]:
    """The table, and of the fastest slew the least duration by the mean model. Raises NoSlewError, StateError."""
    mechanics, S = Mechanics.of(stand), rows_of(stand, slew.task)
    exact, limits, mean = Exact(mechanics, slew, S), Limits.of(stand, slew.bounds), Mean.of(mechanics, S)
    _check_start(slew, limits)
    wanted = -S[:, 3:] @ (slew.axis if slew.kind == "attitude" else slew.start.T @ slew.normal)
    wanted = wanted * np.array([row.component.startswith("w") for row in slew.task.rows])
    if slew.kind == "still":
        wanted = np.zeros(len(S))
    elif (twist := mean.missing(wanted)) is not None:
        raise unreached_motion(slew, S, twist, wanted)
    if slew.goal == "quietest":
        assert slew.duration is not None
        path = Path.of(mechanics, slew, mean, limits, mean.least(wanted))
        return _quietest(exact, path, slew.duration), None
    return _fastest(exact, mean, limits, wanted)


def _check_start(slew: Slew, limits: Limits) -> None:
    for name, speed, most in zip(limits.names, slew.phi_dot, limits.speed, strict=True):
        if abs(speed) > most:
            raise NoSlewError(
                "BOUND_REACH", f"momentum saturation: {name} starts at {abs(speed):.6g} rad/s, at most {most:.6g} rad/s"
            )


def _quietest(exact: Exact, path: Path, duration: float) -> Table:
    made = _table(exact, path, quietest(exact.slew.angle, duration))
    worst = made.worst
    if worst.share > 1.0:
        longer = f"about {duration * _slower(worst):.4g} s" if np.isfinite(worst.share) else "more"
        raise NoSlewError(
            "BOUND_REACH", f"{_saturation(worst)}{worst.words}; a duration of {longer} is within the limits"
        )
    return made


def _saturation(worst: LimitUse) -> str:
    return "momentum saturation: " if worst.kind == "speed" else ""


def _slower(worst: LimitUse) -> float:
    """Factor of the time that keeps a limit: torque and acceleration fall with its square."""
    return float(worst.share if worst.kind == "speed" else np.sqrt(worst.share)) * 1.001


def _fastest(exact: Exact, mean: Mean, limits: Limits, wanted: Array) -> tuple[Table, Sharp]:
    """The law for the limits of the mean model, then slower or faster until the exact motion just keeps them."""
    if not (np.isfinite(limits.strongest).any() or np.isfinite(limits.acceleration).any()):
        raise NoSlewError("BOUND_REACH", "nothing limits the flywheels' torque: give bounds, or a duration")
    sharp, path = _sharpest(exact, mean, limits, wanted)
    law, rows = smooth(sharp, exact.slew.angle), None
    kept, tried = None, list[tuple[float, float]]()
    for _ in range(_ROUNDS):
        made = _table(exact, path, law, rows)
        worst, rows = made.worst, made.rows
        if not np.isfinite(worst.share) or worst.share > _ABSURD:
            raise NoSlewError("BOUND_REACH", f"the exact motion needs {worst.words}")
        if worst.share <= 1.0:
            kept = made
        if kept is not None and (worst.share > 1.0 or worst.share >= NEAR):
            break
        tried.append((np.log(law.duration), np.log(worst.share)))
        law = law.slower(float(np.exp(_step(tried))))
    if kept is None:
        raise NoSlewError(
            "BOUND_REACH", f"{_saturation(worst)}no duration was found that keeps the limits: {worst.words}"
        )
    return kept, sharp


def _step(tried: Sequence[tuple[float, float]]) -> float:
    """Change of the logarithm of the duration, by those and the logarithms of the share, which is to be just below 1.

    A share falls with the square of the time at first; the torque of unbalance hardly falls at all.
    """
    share, slope = tried[-1][1], -1.6
    if len(tried) > 1 and tried[-1][0] != tried[-2][0]:
        slope = (share - tried[-2][1]) / (tried[-1][0] - tried[-2][0])
    return float(np.clip((AIM - share) / float(np.clip(slope, -2.5, -0.05)), -0.3, 0.7))


def _sharpest(exact: Exact, mean: Mean, limits: Limits, wanted: Array) -> tuple[Sharp, Path]:
    """The quickest of the choices of a share."""
    best: tuple[Sharp, Path] | None = None
    stuck: tuple[PathTable, float] | None = None
    for share in choices(mean, wanted, limits):
        path = Path.of(exact.mechanics, exact.slew, mean, limits, share)
        along = path.tabulate(exact.slew.angle)
        sharp = sharpest(exact.slew.angle, along.accelerations, along.cap)
        if isinstance(sharp, float):
            stuck = stuck or (along, sharp)
        elif best is None or sharp.duration < best[0].duration:
            best = (sharp, path)
    if best is not None:
        return best
    assert stuck is not None
    along, sigma = stuck
    name, speed, most = along.fastest_wheel(sigma)
    where = f"at {np.degrees(sigma):.4g} deg of the turn"
    if along.cap(sigma) <= 0.0 or speed >= 0.99 * most:
        words = f"momentum saturation: {where} {name} would need {speed:.6g} rad/s, at most {most:.6g} rad/s"
    else:
        direction = ", ".join(f"{x:.4g}" for x in exact.slew.axis + 0.0)
        words = f"{where} the motors give no acceleration about ({direction}) of E1 within their limits"
    raise NoSlewError("BOUND_REACH", words)


def _table(exact: Exact, path: Path, law: Law, rows: Array | None = None) -> Table:
    """The exact motion at rows so close that (12) holds between them; `rows`: the first, as shares of the time."""
    t = _rows(exact, path, law) if rows is None else rows * law.duration
    while True:
        if len(t) > MOST_ROWS:
            raise NoSlewError(
                "SEARCH",
                f"more than {MOST_ROWS} rows would be needed: the flywheels turn too often in {law.duration:.4g} s; "
                + SLOWER,
            )
        sigma, speed, acceleration = law.at(t)
        motion = exact.follow(Demand(t, sigma, speed, acceleration, path.phi_ddot(sigma, speed, acceleration)))
        if motion.missing is not None:
            raise motion.missing
        _refuse_singular(exact, motion)
        residuals, takes = _intervals(exact, path.limits, motion)
        far = (np.diff(t) > law.duration / SHORTEST) | (_turn_between_rows(exact, motion) > 0.5 * TURN)
        splitting = (residuals > 0.5 * TOLERANCE) & far
        if residuals.max() < TOLERANCE or (not splitting.any() and residuals.max() < ACCEPTED_RESIDUAL):
            return Table(law, motion, takes, float(residuals.max()), t / law.duration)
        if not splitting.any():
            words = f"the table does not come below a residual of {residuals.max():.2g}"
            resisted = exact.slew.unbalance == "resisted"
            raise NoSlewError("SEARCH", f"{words}; {SLOWER}" if resisted else words)
        t = _split(t, np.where(splitting, 2, 1))


@dataclass(frozen=True, eq=False)
class Table:
    """The exact motion by a law at the rows of a table, its shares of the limits, its residual; rows as shares."""

    law: Law
    motion: SlewMotion
    limit_uses: list[LimitUse]
    residual: float
    rows: Array

    @property
    def worst(self) -> LimitUse:
        """The largest share; 0 where there are no limits."""
        return max(self.limit_uses, key=lambda use: use.share, default=LimitUse("torque", 0.0, "", 0.0, 0.0, np.inf))


def _rows(exact: Exact, path: Path, law: Law) -> Array:
    """Times of the first rows: closer where the law bends, and where unevenly built flywheels turn fast."""
    bent = np.flatnonzero(np.diff(np.concatenate([[False], law.bends, [False]]).astype(int)))
    t = [0.0]
    for a, b in zip(bent[::2], bent[1::2], strict=True):  # intervals a to b bend
        t += [*_even_times(t[-1], float(law.breaks[a]), COARSE * law.breaks[1])]
        t += [*_even_times(t[-1], float(law.breaks[b]), law.breaks[1] / FINE)]
    t += [*_even_times(t[-1], law.duration, COARSE * law.breaks[1])]
    t[-1] = law.duration
    return _turning(exact, path, law, np.array(t))


def _even_times(begin: float, end: float, step: float) -> Array:
    """Times after `begin` up to `end`, no further apart than `step`; none where they are the same."""
    count = int(np.ceil((end - begin) / step - 1e-6))
    return np.linspace(begin, end, count + 1)[1:]


def _split(t: Array, counts: Array) -> Array:
    """The times with each interval in a number of equal parts."""
    inner = [np.linspace(a, b, n, endpoint=False) for a, b, n in zip(t[:-1], t[1:], counts, strict=True)]
    return np.concatenate([*inner, t[-1:]])


def _turning(exact: Exact, path: Path, law: Law, t: Array) -> Array:
    """More rows where an uneven flywheel would turn further than TURN from one to the next."""
    uneven = _is_uneven(exact)
    if not uneven.any():
        return t
    _, speed, _ = law.at(t)
    fastest = (np.abs(exact.slew.phi_dot) + np.abs(speed)[:, None] * np.abs(path.share))[:, uneven].max(axis=1)
    angle = np.maximum(fastest[1:], fastest[:-1]) * np.diff(t)
    counts = np.maximum(1, np.ceil(angle / TURN)).astype(int)
    return np.linspace(0.0, law.duration, 2 * MOST_ROWS) if counts.sum() > MOST_ROWS else _split(t, counts)


def _is_uneven(exact: Exact) -> Array:
    """Is a flywheel unevenly built (N)? Its wrench then changes as it turns."""
    tables = exact.mechanics.tables
    changing, mean = np.abs(tables.Theta[1:]).max(axis=(0, 2, 3)), np.abs(tables.Theta[0]).max(axis=(1, 2))
    return np.asarray(changing > EVEN * mean)


def _turn_between_rows(exact: Exact, motion: SlewMotion) -> Array:
    """The furthest that an uneven flywheel turns in each interval between rows; rad."""
    angles = np.abs(np.diff(motion.angles.phi, axis=0))
    return np.asarray(angles[:, _is_uneven(exact)].max(axis=1, initial=0.0))


def _refuse_singular(exact: Exact, motion: SlewMotion) -> None:
    stand, theta = exact.mechanics.stand, motion.course.q[:, 4]
    name, values = ("sin", np.sin(theta)) if stand.angles == "euler" else ("cos", np.cos(theta))
    k = int(np.argmin(np.abs(values)))
    if abs(values[k]) < SINGULAR or np.any(np.diff(np.sign(values))):
        raise NoSlewError(
            None,
            f"singular attitude of the {stand.angles} sequence at t = {motion.t[k]:.4g} s: {name} theta reaches 0; "
            "choose another sequence (`angles` of the stand)",
        )


_INSIDE = np.array([0.25, 0.5, 0.75])


def _intervals(exact: Exact, limits: Limits, motion: SlewMotion) -> tuple[Array, list[LimitUse]]:
    """Relative residual of (12) in each interval, and what is taken of the limits at the rows and between."""
    t = (motion.t[:-1, None] + np.diff(motion.t)[:, None] * _INSIDE).ravel()
    carrier, angles = PlannedCourse(motion.t, *motion.course), Samples(motion.t, *motion.angles).at(t)
    at = prescribe(exact.mechanics, carrier.at(t))
    norm = Norm.of(prescribe(exact.mechanics, carrier.at(np.linspace(0.0, motion.t[-1], 129))), motion.t[-1])
    sizes = np.linalg.norm(norm.dimensionless(residual(at, *angles)), axis=1).reshape(-1, len(_INSIDE)).max(axis=1)
    tau = np.vstack([motion.tau, torques(at, *angles)])
    phi_dot, phi_ddot = (np.vstack([a, b]) for a, b in zip(motion.angles[1:], angles[1:], strict=True))
    return sizes, limit_uses(limits, np.concatenate([motion.t, t]), phi_dot, phi_ddot, tau)


def _programme(stand: Stand, slew: Slew, planned: Table, sharp: Sharp | None) -> Programme:
    """The programme with its report."""
    motion, limits = planned.motion, Limits.of(stand, slew.bounds)
    angles: Angles = motion.angles
    report: dict[str, Any] = {
        "kind": "slew",
        "goal": slew.goal,
        "task": slew.task.name,
        "angle": slew.angle,
        "duration": float(motion.t[-1]),
        "least_duration": None if sharp is None else sharp.duration,
        "residual": planned.residual,
        "exceeded": [],
        "used": {use.kind: use.share for use in planned.limit_uses},
        "hardest": [use.words for use in planned.limit_uses],
        **peaks(angles, motion.tau),
        "peak_motor_torque": np.abs(motion.tau - limits.friction(angles.phi_dot)).max(axis=0),
        "end_speed": angles.phi_dot[-1],
        "through_zero": _through_zero(limits.names, angles.phi_dot),
        "strayed": float(np.linalg.norm(motion.course.q[:, :3] - np.array(slew.position), axis=1).max()),
    }
    made = make_programme(
        stand, slew.name, float(motion.t[-1]), np.zeros(6), None, Samples(motion.t, *angles), report
    )  # fmt: skip
    return replace(made, carrier=PlannedCourse(motion.t, *motion.course), unbalance=slew.unbalance)


def _through_zero(names: Sequence[str], phi_dot: Array) -> list[str]:
    """Flywheels whose speed (M, N) changes its sign by more than rounding."""
    least = STANDING * np.abs(phi_dot).max(axis=0)
    passing = (phi_dot.min(axis=0) < -least) & (phi_dot.max(axis=0) > least)
    return [name for name, passes in zip(names, passing, strict=True) if passes]


def _with_unbalance(stand: Stand, slew: Slew, programme: Programme) -> Programme:
    """The programme of the mean stand, whose report says what unbalance does besides."""
    effect = unbalance_effect(stand, motion_of_slew(slew, programme), programme)
    sight = slew.axis if slew.kind == "sight" else None
    figures = None if effect is None else effect.figures(sight)
    return replace(programme, report={**programme.report, "unbalance": figures})
