"""What limits a slew along its path, and the fastest time law within it, by the mean model over all phases.

The mean model has balanced flywheels: K0 of (2) and I0 of (9) as means over the phases. A demanded acceleration
r sigma'' of the rows then takes A g = -r, A = S K0^-1 I0, of flywheels phi'' = g sigma'', with torques
tau = Q g sigma'', Q = Theta_ff - I0^T K0^-1 I0. More flywheels than rows leave a choice of g.

Along the path phi' = phi'_0 + w(sigma) + g sigma'. w is how the flywheels take over the momentum that they have at the
start, which stays where it is in E0 while E1 turns: A w = J^-1 (R(sigma)^T - 1) H_0 for three angular rows, least in
Theta_ff; for other rows it is left to the exact equations. So tau = Q (g sigma'' + w'(sigma) sigma').

Limits are those of the motors, whose torque depends on speed, and given bounds. In the plane of (sigma, sigma') the
largest acceleration forwards from rest and the largest braking backwards from rest meet, under a cap by the speeds of
the flywheels. The speed over time then is smoothed as a spline whose coefficients are its values (Schoenberg): a mean
of neighbours, so that it exceeds nothing, and as long as four knots more. Quietest: the quintic with the least mean
square of the third derivative from rest to rest.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.interpolate import BSpline
from scipy.linalg import null_space
from scipy.optimize import linprog, minimize
from scipy.spatial.transform import Rotation

from mahovik.core.motion.required import FlywheelBounds, Slew
from mahovik.core.stand.model import Stand
from mahovik.core.stand.motor import UNLIMITED, Motor, available_torque, friction
from mahovik.use.numeric.mechanics import Mechanics
from mahovik.use.numeric.se3 import Array


@dataclass(frozen=True, eq=False)
class Limits:
    """N numbers each, infinite where there is no limit.

    motors        whose limits and friction count; of a flywheel without one, one that has neither
    bound         of the motor's torque at any speed, N m
    speed         rad/s; acceleration: rad/s2
    """

    names: tuple[str, ...]
    motors: tuple[Motor, ...]
    bound: Array
    speed: Array
    acceleration: Array

    @staticmethod
    def of(stand: Stand, bounds: FlywheelBounds) -> Limits:
        """Limits of a stand's motors and of given bounds; a flywheel without either has `inverse_most`."""
        wheels = stand.flywheels
        motors = tuple(s.motor or UNLIMITED for s in wheels)

        def bound_values(key: str) -> Array:
            return np.array(getattr(bounds, key) or (np.inf,) * len(wheels), dtype=np.float64)

        no_load = np.array([np.inf if m.no_load is None else m.no_load for m in motors])
        free = np.array([m.peak is None for m in motors], dtype=bool) & ~np.isfinite(bound_values("torque"))
        return Limits(
            tuple(s.name for s in wheels), motors, bound_values("torque"),
            np.minimum(bound_values("speed"), no_load),
            np.minimum(bound_values("acceleration"), np.where(free, stand.inverse_most, np.inf)),
        )  # fmt: skip

    def friction(self, speed: Array) -> Array:
        """Torque of friction on the flywheels (..., N; N m) at speeds (..., N; rad/s)."""
        return np.stack([friction(motor, speed[..., s]) for s, motor in enumerate(self.motors)], axis=-1)

    def available(self, sign: Array | float, speed: Array) -> Array:
        """Largest torque (..., N; N m) of the motors in the direction of `sign` at speeds (..., N; rad/s)."""
        signs = np.broadcast_to(sign, speed.shape)
        columns = [available_torque(m, signs[..., s], speed[..., s]) for s, m in enumerate(self.motors)]
        return np.asarray(np.minimum(np.stack(columns, axis=-1), self.bound))

    @property
    def strongest(self) -> Array:
        """Largest torque at any speed (N, N m)."""
        return np.minimum([np.inf if m.peak is None else m.peak for m in self.motors], self.bound)


@dataclass(frozen=True)
class LimitUse:
    """The largest share of the limits of one kind: torque, speed or acceleration; of which flywheel, when, in words."""

    kind: str
    share: float
    name: str
    t: float
    value: float
    limit: float

    @property
    def words(self) -> str:
        """Flywheel, value, limit and time."""
        unit = {"torque": "N m", "speed": "rad/s", "acceleration": "rad/s2"}[self.kind]
        return f"{self.kind} of {self.name}: {self.value:.6g} of {self.limit:.6g} {unit} at t = {self.t:.5g} s"


def limit_uses(limits: Limits, t: Array, phi_dot: Array, phi_ddot: Array, tau: Array) -> list[LimitUse]:
    """The largest share of each kind of limit in a motion of the flywheels (M, N each); of kinds with a limit."""
    torque = tau - limits.friction(phi_dot)
    result = []
    for kind, values, most in (
        ("torque", torque, limits.available(np.sign(torque), phi_dot)),
        ("speed", phi_dot, np.broadcast_to(limits.speed, phi_dot.shape)),
        ("acceleration", phi_ddot, np.broadcast_to(limits.acceleration, phi_ddot.shape)),
    ):
        if not np.isfinite(most).any():
            continue
        with np.errstate(divide="ignore", invalid="ignore"):
            shares = np.where(values == 0.0, 0.0, np.abs(values) / most)
        k, s = np.unravel_index(int(np.argmax(shares)), shares.shape)
        result.append(
            LimitUse(
                kind, float(shares[k, s]), limits.names[s], float(t[k]), float(abs(values[k, s])), float(most[k, s])
            )
        )
    return result


_REACH = 1e-9
"""Share of a demand that may be left as rounding."""

_RANK = 1e-9


@dataclass(frozen=True, eq=False)
class Mean:
    """The mean model for rows S (m, 6): K0 (6, 6), I0 (6, N), weights Theta_ff (N)."""

    S: Array
    K0: Array
    I0: Array
    Theta_ff: Array

    @staticmethod
    def of(mechanics: Mechanics, S: Array) -> Mean:
        """The mean model of a stand."""
        return Mean(S, mechanics.mean_inertia, mechanics.tables.coupling[0].T, mechanics.tables.Theta_ff)

    @cached_property
    def to_motion(self) -> Array:
        """K0^-1 I0 (6, N): -V* by phi''."""
        return np.asarray(np.linalg.solve(self.K0, self.I0))

    @cached_property
    def A(self) -> Array:
        """S K0^-1 I0 (m, N)."""
        return np.asarray(self.S @ self.to_motion)

    @cached_property
    def Q(self) -> Array:
        """Torques by phi'' (N, N)."""
        return np.asarray(np.diag(self.Theta_ff) - self.I0.T @ self.to_motion)

    def least(self, wanted: Array) -> Array:
        """phi'' (..., N) with A phi'' = wanted (..., m), the least in the norm of Theta_ff."""
        return np.asarray(wanted @ self._least.T)

    @cached_property
    def _least(self) -> Array:
        root = np.sqrt(self.Theta_ff)
        return np.asarray(np.linalg.pinv(self.A / root, rcond=_RANK) / root[:, None])

    @cached_property
    def norm(self) -> Array:
        """root (m, m): |root a| is the size of accelerations a of the rows, by the inertia that they feel."""
        return np.asarray(np.linalg.inv(np.linalg.cholesky(self.S @ np.linalg.solve(self.K0, self.S.T))))

    def twist(self, left: Array) -> Array:
        """The twist (6, in E1) along which accelerations (m) of the rows are missing."""
        return np.asarray(np.linalg.solve(self.K0, self.S.T @ (self.norm.T @ (self.norm @ left))))

    def missing(self, wanted: Array) -> Array | None:
        """A twist (6, in E1) on which the flywheels do no work, though A phi'' = wanted needs it; None: reached."""
        left = wanted - self.A @ self.least(wanted)
        if float(np.linalg.norm(left)) <= _REACH * float(np.linalg.norm(wanted)):
            return None
        nearest, *_ = np.linalg.lstsq(self.norm @ self.A, self.norm @ wanted, rcond=_RANK)
        return self.twist(self.A @ nearest - wanted)


def choices(mean: Mean, wanted: Array, limits: Limits) -> Iterator[Array]:
    """Shares g (N) with A g = wanted: that with the least torque as part of the limits, of speed, and some between."""
    gentle = _least_part(mean, wanted, mean.Q, limits.strongest, limits.acceleration)
    yield gentle
    if not np.isfinite(limits.speed).any():
        return
    slow = _least_part(mean, wanted, np.eye(len(limits.speed)), limits.speed, np.full(len(limits.speed), np.inf))
    if np.abs(slow - gentle).max() > 1e-6 * np.abs(gentle).max():
        for x in (0.25, 0.5, 0.75, 1.0):
            yield (1.0 - x) * gentle + x * slow


def _least_part(mean: Mean, wanted: Array, rows: Array, most: Array, acceleration: Array) -> Array:
    """g with the least largest part of |rows g| in `most` and of |g| in `acceleration`; of these the least in Theta_ff.

    A linear programme, then a quadratic one inside its value.
    """
    N = len(most)
    bounded = np.vstack([rows[np.isfinite(most)], np.eye(N)[np.isfinite(acceleration)]])
    level = np.concatenate([most[np.isfinite(most)], acceleration[np.isfinite(acceleration)]])
    start = mean.least(wanted)
    if not len(level):
        return start
    unit = float(np.abs(start).max())
    scaled = bounded * unit / level[:, None]
    size = float(np.abs(scaled @ (start / unit)).max())
    A, b = _independent(mean.A * unit, wanted)
    column = -np.full((len(level), 1), size)
    solution = linprog(
        [*np.zeros(N), 1.0],
        A_ub=np.block([[scaled, column], [-scaled, column]]),
        b_ub=np.zeros(2 * len(level)),
        A_eq=np.hstack([A, np.zeros((len(A), 1))]),
        b_eq=b,
        bounds=[(None, None)] * N + [(0.0, None)],
    )
    if solution.x is None:
        return start
    g, part = solution.x[:N], float(solution.x[N])
    if np.abs(scaled @ (start / unit)).max() <= part * size * (1.0 + 1e-9):
        return start
    null = null_space(A, _RANK)
    if null.shape[1]:
        weight = mean.Theta_ff / mean.Theta_ff.max()
        most_part = part * size * (1.0 + 1e-7)
        shorter = minimize(
            lambda y: float(weight @ (g + null @ y) ** 2),
            np.zeros(null.shape[1]),
            jac=lambda y: 2.0 * null.T @ (weight * (g + null @ y)),
            method="SLSQP",
            constraints={
                "type": "ineq",
                "fun": lambda y: most_part - np.concatenate([scaled, -scaled]) @ (g + null @ y),
                "jac": lambda y: -np.concatenate([scaled, -scaled]) @ null,
            },
        )
        nearer = g + null @ shorter.x
        if np.abs(scaled @ nearer).max() <= part * size * (1.0 + 1e-6):
            g = nearer
    return np.asarray(g * unit)


def _independent(A: Array, b: Array) -> tuple[Array, Array]:
    """The equations without those that say nothing new."""
    U, sigma, Vt = np.linalg.svd(A, full_matrices=False)
    kept = sigma > _RANK * sigma[0]
    return np.asarray(sigma[kept, None] * Vt[kept]), np.asarray(U[:, kept].T @ b)


class NoSlewError(Exception):
    """Why there is no programme: reason and words of `Plan`; without a reason the attitude is singular."""

    def __init__(self, reason: str | None, words: str) -> None:
        super().__init__(words)
        self.reason, self.words = reason, words


def unreached_motion(slew: Slew, S: Array, twist: Array, left: Array) -> NoSlewError:
    """The flywheels do no work on a twist (6, in E1), though the rows S (m, 6) need it; left (m): what the rows miss.

    A moment or a force where rows turn; else the acceleration of the point whose rows these are.
    """
    places = {row.of or "O1" for row in slew.task.rows}
    if slew.kind == "still" and len(places) == 1:
        words = f"they give no acceleration of {places.pop()} along ({_direction(left @ S[:, :3])}) of E1"
    else:
        turns = float(np.linalg.norm(twist[3:])) > 1e-6 * float(np.linalg.norm(twist[:3]))
        along = "moment about" if turns else "force along"
        words = f"they give no {along} ({_direction(twist[3:] if turns else twist[:3])}) of E1"
    return NoSlewError("SPAN", f"the flywheels do not reach the task {slew.task.name}: {words}")


def _direction(x: Array) -> str:
    unit = x / np.linalg.norm(x)
    return ", ".join(f"{x:.4g}" for x in np.where(np.abs(unit) > 1e-9, unit, 0.0) + 0.0)


ROOM = 0.9995
"""Part of the limits that the law is made for: the exact motion has ripple besides."""


@dataclass(frozen=True, eq=False)
class Path:
    """A slew with the share g (N) of the flywheels."""

    slew: Slew
    mean: Mean
    limits: Limits
    share: Array

    @cached_property
    def momentum(self) -> Array:
        """Momentum of the flywheels at the start (3, N m s, in E1)."""
        return np.asarray(self.mean.I0[3:] @ np.array(self.slew.phi_dot))

    @property
    def _taken_over(self) -> bool:
        return self.slew.kind == "attitude" and bool(np.any(self.momentum))

    def speeds(self, sigma: Array) -> tuple[Array, Array]:
        """w (M, N; rad/s) and its derivative by sigma."""
        none = np.zeros((len(sigma), len(self.share)))
        if not self._taken_over:
            return none, none
        axis = self.slew.axis
        back = Rotation.from_rotvec(-sigma[:, None] * axis).apply(self.momentum)
        turned = -np.cross(axis, back)
        to_motion = self.mean.S @ np.linalg.inv(self.mean.K0)[:, 3:]
        return self.mean.least((back - self.momentum) @ to_motion.T), self.mean.least(turned @ to_motion.T)

    def phi_ddot(self, sigma: Array, speed: Array, acceleration: Array) -> Array:
        """phi'' (M, N) that the mean model needs."""
        return np.asarray(acceleration[:, None] * self.share + speed[:, None] * self.speeds(sigma)[1])

    def tabulate(self, angle: float, points: int = 512) -> PathTable:
        """w and its derivative at close places, to be read quickly."""
        sigma = np.linspace(0.0, angle, points + 1)
        return PathTable(self, angle / points, *self.speeds(sigma))


@dataclass(frozen=True, eq=False)
class PathTable:
    """What limits sigma' and sigma'' along the path."""

    path: Path
    step: float
    w: Array
    w_slope: Array

    def _at(self, sigma: float) -> tuple[Array, Array]:
        k = min(int(sigma / self.step), len(self.w) - 2)
        x = sigma / self.step - k
        return (1 - x) * self.w[k] + x * self.w[k + 1], (1 - x) * self.w_slope[k] + x * self.w_slope[k + 1]

    def cap(self, sigma: float) -> float:
        """Largest sigma' at which no flywheel is faster than it may be; 0 or less: none."""
        speed = np.array(self.path.slew.phi_dot) + self._at(sigma)[0]
        most, g = self.path.limits.speed, self.path.share
        room = np.where(g > 0.0, most - speed, most + speed)
        with np.errstate(divide="ignore", invalid="ignore"):
            result = np.where(
                np.abs(g) > 1e-12 * np.abs(g).max(), room / np.abs(g), np.where(room >= 0.0, np.inf, -1.0)
            )
        return float(min(ROOM * result.min(), 1e9))

    def fastest_wheel(self, sigma: float) -> tuple[str, float, float]:
        """Name of the flywheel whose speed limits most at sigma' = 0, its speed and its limit, rad/s."""
        speed = np.abs(np.array(self.path.slew.phi_dot) + self._at(sigma)[0])
        s = int(np.argmax(speed / self.path.limits.speed))
        return self.path.limits.names[s], float(speed[s]), float(self.path.limits.speed[s])

    def accelerations(self, sigma: float, speed: float) -> tuple[float, float]:
        """Least and largest sigma'' at (sigma, sigma') by torque and acceleration of every flywheel."""
        path, limits = self.path, self.path.limits
        w, slope = self._at(sigma)
        phi_dot = np.array(path.slew.phi_dot) + w + speed * path.share
        push = path.mean.Q @ slope * speed - limits.friction(phi_dot)
        low, high = -np.inf, np.inf
        for factor, offset, up, down in (
            (path.mean.Q @ path.share, push, limits.available(1.0, phi_dot), limits.available(-1.0, phi_dot)),
            (path.share, slope * speed, limits.acceleration, limits.acceleration),
        ):
            there = np.abs(factor) > 1e-12 * np.abs(factor).max()
            with np.errstate(divide="ignore", invalid="ignore"):
                one, other = (ROOM * up - offset) / factor, (-ROOM * down - offset) / factor
            low = max(low, float(np.minimum(one, other)[there].max(initial=-np.inf)))
            high = min(high, float(np.maximum(one, other)[there].min(initial=np.inf)))
        return low, high


# -- time laws

KNOTS = 400
"""Intervals of the spline: its smoothing takes 4/400 more time than the sharpest law."""

PLANE = 1600
"""Steps in the plane of (sigma, sigma')."""

_DEGREE = 5

Accelerations = Callable[[float, float], tuple[float, float]]
"""Least and largest sigma'' at (sigma, sigma')."""


@dataclass(frozen=True, eq=False)
class Law:
    """sigma(t) over `duration` s; `breaks` (s): between them it is a polynomial, `bends` where it bends most."""

    duration: float
    breaks: Array
    bends: Array
    _sigma: Callable[[Array, int], Array]
    _pace: float = 1.0

    def at(self, t: Array) -> tuple[Array, Array, Array]:
        """sigma, sigma', sigma'' (M; rad, s) at times t (M, s)."""
        x = t / self._pace
        return self._sigma(x, 0), self._sigma(x, 1) / self._pace, self._sigma(x, 2) / self._pace**2

    def slower(self, factor: float) -> Law:
        """The same law in `factor` times the time."""
        return replace(self, duration=self.duration * factor, breaks=self.breaks * factor, _pace=self._pace * factor)


def quietest(angle: float, duration: float) -> Law:
    """angle (10 x^3 - 15 x^4 + 6 x^5), x = t/duration: the least mean square of the third derivative."""
    polynomial = np.polynomial.Polynomial([0.0, 0.0, 0.0, 10.0, -15.0, 6.0])

    def sigma(t: Array, order: int) -> Array:
        x = np.clip(t / duration, 0.0, 1.0)
        result = polynomial.deriv(order)(x) if order else polynomial(x)
        return np.asarray(angle * result / duration**order)

    return Law(
        duration, np.asarray(np.arange(65) * (duration / 64.0), dtype=np.float64), np.zeros(64, dtype=bool), sigma
    )


@dataclass(frozen=True, eq=False)
class Sharp:
    """The sharpest law: sigma' (M, 1/s) at times t (M, s), linear between; its duration is the least possible."""

    t: Array
    speed: Array

    @property
    def duration(self) -> float:
        """s."""
        return float(self.t[-1])


def sharpest(angle: float, accelerations: Accelerations, cap: Callable[[float], float]) -> Sharp | float:
    """The sharpest law from rest to rest; or the sigma at which nothing accelerates, or the cap leaves no speed."""
    sigma = angle * (1.0 - np.cos(np.pi * np.arange(PLANE + 1) / PLANE)) / 2.0
    most = np.array([cap(float(x)) for x in sigma])
    if most.min() <= 0.0:
        return float(sigma[int(np.argmin(most))])
    squares = np.empty((2, PLANE + 1))
    for way, (order, sign) in enumerate(((1, 1.0), (-1, -1.0))):
        grid, caps = sigma[::order], most[::order] ** 2
        u = 0.0
        row = [0.0]
        for i in range(PLANE):
            step = abs(float(grid[i + 1] - grid[i]))
            first = _limit(accelerations, float(grid[i]), u, sign)
            ahead = min(max(u + 2.0 * step * first, 0.0), float(caps[i + 1]))
            second = _limit(accelerations, float(grid[i + 1]), ahead, sign)
            if u == 0.0 and min(first, second) <= 0.0:
                return float(grid[i])
            u = min(max(u + step * (first + second), 0.0), float(caps[i + 1]))
            row.append(u)
        squares[way] = row[::order]
    speed = np.sqrt(squares.min(axis=0))
    t = np.concatenate([[0.0], np.cumsum(2.0 * np.diff(sigma) / (speed[1:] + speed[:-1]))])
    return Sharp(t, speed)


def _limit(accelerations: Accelerations, sigma: float, square: float, sign: float) -> float:
    """Largest gain of speed forwards (sign 1) or backwards (-1), at sigma'^2."""
    low, high = accelerations(sigma, float(np.sqrt(square)))
    return high if sign > 0.0 else -low


def smooth(sharp: Sharp, angle: float) -> Law:
    """The law with four continuous derivatives of sigma', which is zero at both ends with three of them."""
    h = sharp.duration / KNOTS
    values = np.interp(h * np.arange(1, KNOTS), sharp.t, sharp.speed)
    pad = np.zeros(_DEGREE)
    coefficients = np.concatenate([pad, values, pad])
    knots = h * (np.arange(len(coefficients) + _DEGREE + 1) - _DEGREE)
    speed = BSpline(knots, coefficients, _DEGREE)
    way = speed.antiderivative()
    duration = float(h * (KNOTS + 4))
    share = angle / float(way(duration) - way(0.0))
    begin = float(way(0.0))

    def sigma(t: Array, order: int) -> Array:
        x = np.clip(t, 0.0, duration)
        return np.asarray(share * ((way(x) - begin) if order == 0 else speed(x, order - 1)))

    bends = np.abs(np.diff(coefficients, 2))
    bent = np.concatenate([[0.0], bends, [0.0]]) > 2e-2 * bends.max()  # coefficient j bends the six intervals about it
    kinked = np.array([bent[i : i + _DEGREE + 1].any() for i in range(KNOTS + 4)])
    return Law(duration, np.asarray(h * np.arange(KNOTS + 5), dtype=np.float64), kinked, sigma)
