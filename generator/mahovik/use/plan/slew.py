"""A programme for a slew, or the reason why there is none: reach, time law, exact motion, limits, table.

The exact motion is that of the mean stand, whose flywheels do not shake it, by the coupled equations: demanded rows as
the path says, all else by the dynamics. With R0 the residual of (12) at V* = 0 and phi'' = 0, V* = K^-1 (R0 - I phi'')
and a = S V* + s, so that

    S K^-1 I phi'' = S K^-1 R0 + s - a

at every time; of the flywheels' accelerations that solve it the one nearest to a wanted share, in the norm of Theta_ff.
Accelerations at all nodes at once give speeds and positions by integrals of splines, and these the accelerations, until
nothing changes: Picard's iteration, which converges since the accelerations hardly depend on the positions.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy.interpolate import make_interp_spline
from scipy.spatial.transform import Rotation

from mahovik.core.motion.functions import Angles, Course, PlannedCourse, Samples
from mahovik.core.motion.motion_file import motion_of_slew
from mahovik.core.motion.programme import Programme
from mahovik.core.motion.required import SINGULAR, Slew, rows_of
from mahovik.core.stand.coordinates import places_of
from mahovik.core.stand.masses import mean_stand
from mahovik.core.stand.model import Stand
from mahovik.errors import StateError
from mahovik.use.numeric.frame import in_E1
from mahovik.use.numeric.mechanics import Mechanics
from mahovik.use.numeric.residual import Norm, prescribe, prescribed_at, residual, torques
from mahovik.use.numeric.se3 import EULER, Array
from mahovik.use.plan.outcome import Plan, Status, certify, failed_items, peaks
from mahovik.use.plan.slew_path import (
    Law,
    Limits,
    LimitUse,
    Mean,
    NoSlewError,
    Path,
    PathTable,
    Sharp,
    choices,
    limit_uses,
    quietest,
    sharpest,
    smooth,
    unreached_motion,
)

_ITERATIONS = 60
_LAST_CHANGE = 1e-12
"""Change of the flywheels' angles (over 1 + the largest) that ends the iteration."""

_REACH = 1e-8


@dataclass(frozen=True, eq=False)
class Demand:
    """A path at M times: sigma, sigma', sigma'' (M) that the rows follow, and the wanted phi'' (M, N)."""

    t: Array
    sigma: Array
    speed: Array
    acceleration: Array
    phi_ddot: Array


@dataclass(frozen=True, eq=False)
class SlewMotion:
    """The motion at times t (M, s): course of the carrier, angles of the flywheels, drive torques (M, N; N m).

    missing   what the flywheels do not give, where the demand was missed most; None: reached
    """

    t: Array
    course: Course
    angles: Angles
    tau: Array
    missing: NoSlewError | None


@dataclass(frozen=True, eq=False)
class Exact:
    """The exact equations of a slew, whose K and I are those of the mean model at every phase."""

    mechanics: Mechanics
    slew: Slew
    mean: Mean

    def follow(self, demand: Demand) -> SlewMotion:
        """The motion whose demanded rows follow the path. Raises StateError, NoSlewError: it does not settle."""
        t, slew = demand.t, self.slew
        M = len(t)
        phi_dot = np.tile(slew.phi_dot, (M, 1))
        phi = slew.phi + t[:, None] * phi_dot
        position, velocity = np.tile(np.array(slew.position), (M, 1)), np.zeros((M, 3))
        C = slew.path(demand.sigma) @ slew.start
        if slew.kind == "attitude":
            omega = demand.speed[:, None] * slew.axis
        else:
            omega = in_E1(C, demand.speed[:, None] * slew.normal)
        theta = self._angles(C)
        missing: NoSlewError | None
        unreached: NoSlewError | None
        missing, unreached, previous = None, None, np.inf
        for _ in range(_ITERATIONS):
            rates = self._rates(theta, omega)
            q = np.hstack([position, theta])
            q_dot = np.hstack([velocity, rates])
            V_dot, phi_ddot, missing = self._accelerations(demand, Course(q, q_dot, np.zeros_like(q)), phi, phi_dot)
            unreached = unreached or missing
            before = phi
            gained = _integral(t, phi_ddot)
            new_dot = np.array(slew.phi_dot) + gained
            # angles of many turns would lose digits that the distances between the rows need
            phi = slew.phi + t[:, None] * slew.phi_dot + _integral(t, gained)
            change = max(_change(phi, before), _change(new_dot, phi_dot))
            phi_dot = new_dot
            at = self.mechanics.frame.twists(Course(q, q_dot, np.zeros_like(q)))
            in_E0 = (at.C @ (V_dot[:, :3] + np.cross(omega, at.V[:, :3]))[:, :, None])[:, :, 0]
            velocity = _integral(t, in_E0)
            moved = slew.position + _integral(t, velocity)
            change = max(change, float(np.abs(moved - position).max()))
            position = moved
            if slew.kind != "attitude":
                new_omega = _integral(t, V_dot[:, 3:])
                new_theta = theta[0] + _integral(t, self._rates(theta, new_omega))
                change = max(change, _change(new_theta, theta), _change(new_omega, omega))
                omega, theta = new_omega, new_theta
            if not np.isfinite(change) or change > 1e6:
                break
            if change < _LAST_CHANGE or (change < 1e-10 and change > 0.5 * previous):
                return self._end(t, position, velocity, theta, omega, V_dot, phi, phi_dot, phi_ddot, missing)
            previous = change
        if unreached is not None:
            raise unreached
        raise StateError(
            "the motion of the slew does not settle: the surroundings act too strongly on what the rows demand"
        )

    def _angles(self, C: Array) -> Array:
        """psi, theta, phi (M, 3; rad) of attitudes (M, 3, 3); where they are singular any that fit."""
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", UserWarning)  # singular attitudes are refused by name
            angles = Rotation.from_matrix(C).as_euler(EULER[self.mechanics.stand.angles])
        return np.asarray(np.unwrap(angles, axis=0))

    def _accelerations(
        self, demand: Demand, course: Course, phi: Array, phi_dot: Array
    ) -> tuple[Array, Array, NoSlewError | None]:
        """V* (M, 6), phi'' (M, N), and what is missing most."""
        mechanics, mean = self.mechanics, self.mean
        at = mechanics.frame.twists(course)
        u = at.V[:, :3] - at.V_r[:, :3]
        still = at._replace(V_r_dot=np.hstack([np.cross(at.V[:, 3:], u), np.zeros_like(u)]))
        R = residual(prescribed_at(mechanics, still), phi, phi_dot, np.zeros_like(phi))
        free = np.linalg.solve(mean.K0, R.T).T
        a, s = self._demand(demand, at.C, at.V)
        c = free @ mean.S.T + s - a
        phi_ddot = demand.phi_ddot + mean.least(c - demand.phi_ddot @ mean.A.T)
        V_dot = free - phi_ddot @ mean.to_motion.T
        return V_dot, phi_ddot, self._missing(a, c, a - V_dot @ mean.S.T - s)

    def _missing(self, a: Array, c: Array, left: Array) -> NoSlewError | None:
        """The part of the demand a that is left where this is most; None: nothing is.

        c: what the flywheels are to add, so that a demand to stay at rest has a size, too; (M, m) each.
        """
        sizes, *demands = (np.linalg.norm(x @ self.mean.norm.T, axis=1) for x in (left, a, c))
        k = int(np.argmax(sizes))
        if sizes[k] <= _REACH * max(float(x.max()) for x in demands) or sizes[k] == 0.0:
            return None
        return unreached_motion(self.slew, self.mean.S, self.mean.twist(left[k]), left[k])

    def _demand(self, demand: Demand, C: Array, V: Array) -> tuple[Array, Array]:
        """a, s (M, m each) of a = S V* + s."""
        slew = self.slew
        omega = V[:, 3:]
        if slew.kind == "attitude":
            angular = demand.acceleration[:, None] * slew.axis
        else:
            normal = in_E1(C, np.tile(slew.normal, (len(C), 1)))
            angular = demand.acceleration[:, None] * normal - demand.speed[:, None] * np.cross(omega, normal)
        a, s = np.zeros((2, len(C), len(slew.task.rows)))
        places = places_of(self.mechanics.stand.instruments, self.mechanics.stand.points)
        for i, row in enumerate(slew.task.rows):
            if row.component.startswith("w"):
                a[:, i] = angular @ self.mean.S[i, 3:]
            elif row.of:
                v = V[:, :3] + np.cross(omega, places[row.of][0])
                s[:, i] = np.cross(omega, v) @ self.mean.S[i, :3]
        return a, s

    def _rates(self, theta: Array, omega: Array) -> Array:
        """theta' (M, 3) of omega (M, 3) in E1."""
        return np.asarray(np.linalg.solve(self._columns(theta), omega[:, :, None])[:, :, 0])

    def _columns(self, theta: Array) -> Array:
        """B (M, 3, 3) of omega = B theta'."""
        return self.mechanics.frame.slopes(np.hstack([np.zeros_like(theta), theta]))[2][:, 3:, 3:]

    def _end(
        self, t: Array, position: Array, velocity: Array, theta: Array, omega: Array, V_dot: Array,
        phi: Array, phi_dot: Array, phi_ddot: Array, missing: NoSlewError | None,
    ) -> SlewMotion:  # fmt: skip
        rates = self._rates(theta, omega)
        q, q_dot = np.hstack([position, theta]), np.hstack([velocity, rates])
        at = self.mechanics.frame.twists(Course(q, q_dot, np.zeros_like(q)))
        turning = np.linalg.solve(self._columns(theta), (V_dot[:, 3:] - at.V_r_dot[:, 3:])[:, :, None])[:, :, 0]
        straight = (at.C @ (V_dot[:, :3] + np.cross(omega, at.V[:, :3]))[:, :, None])[:, :, 0]
        course = Course(q, q_dot, np.hstack([straight, turning]))
        angles = Angles(phi, phi_dot, phi_ddot)
        tau = torques(prescribe(self.mechanics, course), *angles)
        return SlewMotion(t, course, angles, tau, missing)


def _integral(t: Array, values: Array) -> Array:
    """Integrals (M, n) from t[0] of values (M, n) at t (M)."""
    spline = make_interp_spline(t, values, k=5).antiderivative()
    return np.asarray(spline(t) - spline(t[0]))


def _change(new: Array, old: Array) -> float:
    return float(np.abs(new - old).max(initial=0.0) / (1.0 + np.abs(new).max(initial=0.0)))


# -- the plan

TOLERANCE = 3e-7
"""Relative residual of (12) between the rows of the table that ends the refinement."""

ACCEPTED_RESIDUAL = 8e-7
"""Residual that is enough where closer rows do not help, as rounding of phi counts over the square of the distance."""

SHORTEST = 4096
"""Rows over the whole time, were all as close as the closest may be."""

FINE, COARSE = 8, 4
"""Rows in an interval of the time law where it bends; intervals between rows elsewhere."""

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
        made, sharp = _search(mean_stand(stand), slew)
    except NoSlewError as error:
        status: Status = "NO_PROGRAM" if error.reason else "SINGULAR_ATTITUDE"
        return Plan(status, error.reason, (error.words,), slew.doubts, ())
    except StateError as error:
        return Plan("NO_PROGRAM", "SEARCH", (str(error),), slew.doubts, ())
    programme = _programme(stand, slew, made, sharp)
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
    limits, mean = Limits.of(stand, slew.bounds), Mean.of(mechanics, S)
    exact = Exact(mechanics, slew, mean)
    _check_start(slew, limits)
    wanted = -S[:, 3:] @ (slew.axis if slew.kind == "attitude" else slew.start.T @ slew.normal)
    wanted = wanted * np.array([row.component.startswith("w") for row in slew.task.rows])
    if slew.kind == "still":
        wanted = np.zeros(len(S))
    elif (twist := mean.missing(wanted)) is not None:
        raise unreached_motion(slew, S, twist, wanted)
    if slew.goal == "quietest":
        assert slew.duration is not None
        path = Path(slew, mean, limits, mean.least(wanted))
        return _quietest(exact, path, slew.duration), None
    return _fastest(exact, limits, wanted)


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


def _fastest(exact: Exact, limits: Limits, wanted: Array) -> tuple[Table, Sharp]:
    """The law for the limits of the mean model, then slower or faster until the exact motion just keeps them."""
    if not (np.isfinite(limits.strongest).any() or np.isfinite(limits.acceleration).any()):
        raise NoSlewError("BOUND_REACH", "nothing limits the flywheels' torque: give bounds, or a duration")
    sharp, path = _sharpest(exact, limits, wanted)
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


def _sharpest(exact: Exact, limits: Limits, wanted: Array) -> tuple[Sharp, Path]:
    """The quickest of the choices of a share."""
    best: tuple[Sharp, Path] | None = None
    stuck: tuple[PathTable, float] | None = None
    for share in choices(exact.mean, wanted, limits):
        path = Path(exact.slew, exact.mean, limits, share)
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
    t = _rows(law) if rows is None else rows * law.duration
    while True:
        sigma, speed, acceleration = law.at(t)
        motion = exact.follow(Demand(t, sigma, speed, acceleration, path.phi_ddot(sigma, speed, acceleration)))
        if motion.missing is not None:
            raise motion.missing
        _refuse_singular(exact, motion)
        residuals, takes = _intervals(exact, path.limits, motion)
        splitting = (residuals > 0.5 * TOLERANCE) & (np.diff(t) > law.duration / SHORTEST)
        if residuals.max() < TOLERANCE or (not splitting.any() and residuals.max() < ACCEPTED_RESIDUAL):
            return Table(law, motion, takes, float(residuals.max()), t / law.duration)
        if not splitting.any():
            raise NoSlewError("SEARCH", f"the table does not come below a residual of {residuals.max():.2g}")
        t = np.sort(np.concatenate([t, (0.5 * (t[:-1] + t[1:]))[splitting]]))


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


def _rows(law: Law) -> Array:
    """Times of the first rows: closer where the law bends."""
    bent = np.flatnonzero(np.diff(np.concatenate([[False], law.bends, [False]]).astype(int)))
    t = [0.0]
    for a, b in zip(bent[::2], bent[1::2], strict=True):  # intervals a to b bend
        t += [*_even_times(t[-1], float(law.breaks[a]), COARSE * law.breaks[1])]
        t += [*_even_times(t[-1], float(law.breaks[b]), law.breaks[1] / FINE)]
    t += [*_even_times(t[-1], law.duration, COARSE * law.breaks[1])]
    t[-1] = law.duration
    return np.array(t)


def _even_times(begin: float, end: float, step: float) -> Array:
    """Times after `begin` up to `end`, no further apart than `step`; none where they are the same."""
    count = int(np.ceil((end - begin) / step - 1e-6))
    return np.linspace(begin, end, count + 1)[1:]


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
    made = Programme.of(
        stand, slew.name, float(motion.t[-1]), np.zeros(6), None, Samples(motion.t, *angles), report
    )  # fmt: skip
    return replace(made, carrier=PlannedCourse(motion.t, *motion.course), unbalance="averaged")


def _through_zero(names: Sequence[str], phi_dot: Array) -> list[str]:
    """Flywheels whose speed (M, N) changes its sign by more than rounding."""
    least = STANDING * np.abs(phi_dot).max(axis=0)
    passing = (phi_dot.min(axis=0) < -least) & (phi_dot.max(axis=0) > least)
    return [name for name, passes in zip(names, passing, strict=True) if passes]
