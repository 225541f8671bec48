"""Steady motions of the carrier under flywheels at constant speeds: (8) in full, on a torus of base frequencies.

The flywheels have the phases phi + n theta, theta those of the torus, which turn at r base frequencies w: one where
the speeds have a common period, else one for each flywheel that turns; none where all stand still. The state about rest
is a function of theta that obeys

    sum_i w_i dy/dtheta_i = y'(theta, y),

so that coefficient k obeys i k . w y_k = [y'(theta, y)]_k. Kept are all k up to an order. With one base frequency it is
doubled until the highest harmonics are negligible. With more it is raised by one, and what the others would add is
measured twice: rates at random phases differ by `left_out`; and `missing` is the motion, to first order, by the lines
that the equations still have up to MORE higher orders. Newton's method solves the equations, GMRES its linear ones,
preconditioned by their mean over all phases.

Directions without a restoring force are kept from drifting: of all motions the one is found whose mean pose is that of
rest and whose mean rotation is zero, for any phases.

The coordinates are those of the freedoms, see `scene`. A clamped carrier has no motion, and its reaction is all.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from scipy.linalg import expm
from scipy.sparse.linalg import LinearOperator, gmres

from mahovik.core.stand.model import Stand, State
from mahovik.errors import CheckError
from mahovik.use.numeric.residual import Drive
from mahovik.use.numeric.se3 import Array, Complex
from mahovik.use.vibration.lines import coherent
from mahovik.use.vibration.plant import FREE, LARGEST, Scene
from mahovik.use.vibration.speeds import Turning, common_period
from mahovik.use.vibration.torus import Torus, Whole
from mahovik.use.vibration.view import FullMotion, Observable

FEW_TURNS = 40
"""Most turns of the fastest flywheel in a common period at which its harmonics are fewer than those of a torus."""

SLOW = 1e-7
"""Part of the fastest speed below which a combination k . w is a constant, as of two flywheels of one speed.

By (8) a slower beat has the displacement of its rounding over the square of its frequency.
"""

ROUNDING = 1e-15
"""m/s2, rad/s2: smaller rates are rounding."""

PER_TURN, MOST = 4, 8192
"""Harmonics per turn of the fastest flywheel at first; most harmonics of a common period."""

TAIL, KINKED_TAIL = 1e-10, 1e-7
"""Largest part of the largest harmonic of V* that the highest third may hold; otherwise harmonics are doubled.

Damping with magnitudes has kinks: harmonics fall only as the third power of their number.
"""

COARSE = 1e-6
"""Larger limit of that part, if more harmonics do not help or are too many; beyond it there is no result."""

SMALLEST = 1e-14
"""m/s2, rad/s2: smaller harmonics count as zero."""

FIRST, HIGHEST = 2, 8
"""Orders of several base frequencies that are tried."""

ENOUGH, ENOUGH_POSE = 1e-6, 1e-4
"""Rates and pose left out, relative, at which no higher order is tried: slow beats move far by small accelerations."""

MORE = 2
"""Orders above the kept ones whose remaining lines are found."""

SAMPLES = 64
"""Random phases at which rates are compared."""

LITTLE = 1e-6
"""Part of the other below which a displacement or turning of the carrier is not judged."""

UNSTABLE = 1e-3
"""Multipliers above 1 by more than this grow; less may be rounding of a neutral one."""


ACCURATE = 1e-9
"""Accuracy of GMRES in one step of Newton's method."""

RESTART, ROUNDS = 40, 5

NEWTON = 20
"""Most steps of Newton's method."""

SETTLED = 1e-11
"""Relative size of a last step."""

LOOSE = 0.01
"""Part of a settled step that its linear equations may be off: more accuracy changes nothing."""

SAME = 0.1
"""The linear equations serve for further steps as long as each step is at most this part of the one before."""


class Missing(NamedTuple):
    """What a motion leaves out, to first order: states c (m, 2 n) and pose (x, r) (m, 6) on the torus of more orders.

    w   (m; rad/s): frequencies, 0 of constants
    """

    torus: Torus
    c: Complex
    pose: Complex
    w: Array


@dataclass(frozen=True, eq=False)
class Steady:
    """A steady motion on a torus.

    base      (r, rad/s); turns (N, r): whole turns of each flywheel with each phase of the torus
    phases    (N, rad): of the flywheels at t = 0, where the torus has phases zero
    order     of the torus
    c         (n, 2 m): coefficients of states y = (xi, u)
    h         (n, f): constant numbers along the free directions that keep the mean place
    left_out  largest difference of V* from (8) at random phases, part of its largest; 0 with one base frequency
    missing   None: not known
    short     why no higher order was found though this one leaves out too much; empty: it does not
    """

    scene: Scene
    torus: Torus
    base: Array
    turns: Whole
    phases: Array
    order: int
    c: Complex
    h: Complex
    left_out: float = 0.0
    missing: Missing | None = None
    short: str = ""

    @property
    def speeds(self) -> Array:
        """(N, rad/s)."""
        return np.asarray(self.turns @ self.base)

    @property
    def frequencies(self) -> Array:
        """k . w (n; rad/s), of either sign."""
        return np.asarray(self.torus.k @ self.base)

    @property
    def hold(self) -> Array:
        """(6; N, N m): constant wrench on the carrier in E1 that keeps its mean place along free directions."""
        return np.asarray(self.scene.wrench @ self.h[0].real)

    @property
    def method(self) -> str:
        """How it was found, in words."""
        if len(self.base) < 2:
            return f"{self.order} harmonics of the common period"
        return f"harmonic balance of order {self.order}{f' ({self.short})' if self.short else ''}"

    def full(self, torus: Torus | None = None, c: Complex | None = None) -> FullMotion:
        """Values at the nodes of a torus of these phases, of coefficients c of states; by default its own."""
        torus, c = self.torus if torus is None else torus, self.c if c is None else c
        rates = 1j * (torus.k @ self.base)[:, None] * c
        phi, push = self.phases + torus.angles(self.turns), torus.values(torus.pad(self.h)) @ self.scene.wrench.T
        y, V_dot = self.scene.whole(torus.values(c)), self.scene.twist(torus.values(rates)[:, self.scene.count :])
        return FullMotion(self.scene, phi, np.tile(self.speeds, (len(phi), 1)), y, V_dot, push)

    def harmonics(self, seen: Observable) -> tuple[Array, Complex]:
        """Frequencies (n; Hz, ascending) and amplitudes (n, axes) of what is seen; those of one frequency add up."""
        a, w = self.torus.coefficients(seen.full(self.full())), self.frequencies
        f, a = coherent(np.abs(w)[None] / (2.0 * np.pi), np.where(w[:, None] < 0.0, a.conj(), a)[None])
        return f[0], a[0, :, : len(seen.axes)]

    def at(self, theta: Array) -> tuple[Array, Array, Array, Array]:
        """Flywheels' phases (m, N), states y and their rates (m, 2 n), h (m, f) at phases theta (m, r; rad)."""
        values = (self.torus.at(x, theta) for x in (self.c, 1j * self.frequencies[:, None] * self.c, self.h))
        y, rates, h = values
        return self.phases + theta @ self.turns.T, y, rates, h

    def state(self, theta: Array) -> State:
        """The state as `eval` and `simulate` take it, at phases theta (r; rad)."""
        phi, y, *_ = self.at(theta[None])
        return self.scene.chart.state(y[0], phi[0], self.speeds)

    @property
    def multiplier(self) -> float:
        """Largest modulus of the multipliers of small deviations over the period of the one base frequency.

        Exponentials between middles of nodes. Where all stand still infinite if deviations grow, else 1.
        """
        full = self.full()
        J = self.scene.chart.jacobian(self.scene.drive(full.phi, full.phi_dot), self.torus.values(self.c))
        if not J.size:
            return 1.0
        if not len(self.base):
            return np.inf if float(np.linalg.eigvals(J[0]).real.max()) > np.sqrt(FREE) else 1.0
        monodromy = np.eye(J.shape[1])
        for factor in expm(J * (2.0 * np.pi / self.base[0] / len(J))):
            monodromy = factor @ monodromy
        return float(np.abs(np.linalg.eigvals(monodromy)).max())

    @property
    def unstable(self) -> bool:
        """Whether deviations grow; known of at most one base frequency."""
        return len(self.base) < 2 and self.multiplier > 1.0 + UNSTABLE

    @property
    def pose_left_out(self) -> float:
        """Sum of the amplitudes left out of the pose as a part of the sum of those found: of x or r, the larger.

        0 where they are not known.
        """
        if self.missing is None:
            return 0.0
        whole = self.c[(self.torus.k != 0).any(axis=1), : self.scene.count] @ self.scene.S.T
        left = self.missing.pose[self.missing.w != 0.0]
        radius = np.array([1.0, gyration_radius(self.scene)])
        sizes = [radius * np.linalg.norm(np.abs(c).sum(axis=0).reshape(2, 3), axis=1) for c in (left, whole)]
        least = LITTLE * float(sizes[1].max())
        return float((sizes[0] / np.maximum(sizes[1], least)).max()) if least else 0.0


def steady(
    stand: Stand | Scene, speeds: Sequence[float], phases: Sequence[float] | None = None, near: Steady | None = None
) -> Steady:
    """The motion at constant `speeds` (N, rad/s), flywheels at `phases` (N, rad; default 0) at t = 0.

    stand   or its Scene, for many speeds
    near    that of speeds near these, from which it is sought; None: from rest

    Raises CheckError: no equilibrium, or no motion is found.
    """
    scene = Scene.of(stand) if isinstance(stand, Stand) else stand
    turning = common_period(speeds)
    if turning is not None and max(map(abs, turning.turns), default=0) <= FEW_TURNS:
        return periodic(scene, turning, phases, near)
    try:
        return quasiperiodic(scene, speeds, phases, near=near)
    except CheckError:
        if turning is None:
            raise
        return periodic(scene, turning, phases, near)


def periodic(
    stand: Stand | Scene, turning: Turning, phases: Sequence[float] | None = None, near: Steady | None = None
) -> Steady:
    """The motion on one base frequency, as `steady`."""
    r = int(turning.base > 0.0)
    search = _Search(stand, np.full(r, turning.base), np.array(turning.turns).reshape(-1, 1)[:, :r], phases, near)
    enough, before = KINKED_TAIL if search.scene.stand.has_kinks else TAIL, np.inf
    H = max(8, search.near, PER_TURN * max(map(abs, turning.turns))) if r else 1
    while H <= MOST:
        motion = search.at(H)
        tail = _tail(motion)
        if tail <= enough or (tail <= COARSE and (tail > before / 2 or 2 * H > MOST)):
            return motion
        before, H = tail, 2 * H
    raise search.failure(f"its harmonics do not fall off within {MOST} of the period")


def quasiperiodic(
    stand: Stand | Scene, speeds: Sequence[float], phases: Sequence[float] | None = None, order: int | None = None,
    near: Steady | None = None,
) -> Steady:  # fmt: skip
    """The motion on a base frequency for each flywheel that turns, as `steady`.

    order   largest sum of |k_s|; None: raised until little enough is left out or it no longer helps
    """
    speed = np.array(speeds, dtype=np.float64)
    turning = np.flatnonzero(speed)
    search = _Search(stand, speed[turning], np.eye(len(speed), dtype=np.int64)[:, turning], phases, near)
    motion = search.judged(FIRST if order is None else order)
    for higher in range(FIRST + 1, HIGHEST + 1) if order is None else ():
        if motion.left_out <= ENOUGH and motion.pose_left_out <= ENOUGH_POSE:
            break
        try:
            motion = search.judged(higher)
        except CheckError as error:
            return replace(motion, short=str(error))
    return motion


def _tail(motion: Steady) -> float:
    """Part of the largest harmonic of V* that the highest third holds; 0 if it is rounding."""
    rates = motion.frequencies[:, None] * motion.c[:, motion.scene.count :]
    size = np.abs(rates @ motion.scene.S.T) * np.repeat([1.0, gyration_radius(motion.scene)], 3)
    harmonic = size.max(axis=1) / 2.0
    last = float(harmonic[2 * len(harmonic) // 3 :].max())
    return 0.0 if last <= SMALLEST else last / float(harmonic.max())


@dataclass(frozen=True, eq=False)
class Linearised:
    """i w_k dc_k - [J dy + push dh]_k = r_k, with free . dc_k = - free . c_k for constant k; unknown dc, dh.

    J (M, m, m), push (M, m, f) at the nodes; free (f, m); w (n, rad/s); slow: the constant k; size (m).
    """

    torus: Torus
    J: Array
    push: Array
    free: Array
    w: Array
    slow: Whole
    size: Array

    def solve(self, r: Complex, c: Complex, enough: float = 0.0) -> tuple[Complex, Complex] | None:
        """dc (n, m), dh (n, f); None if the equations are singular, at an undamped resonance.

        `enough`: error of dc, in units of `size`, below which no more accuracy is wanted.
        """
        n, (f, m) = len(self.w), self.free.shape
        inverse = self.inverse(self.w, self.slow)
        if inverse is None:
            return None
        slow = np.zeros(n, dtype=bool)
        slow[self.slow] = True

        def pack(result: Complex) -> Array:
            scaled = result / np.concatenate([self.size, np.ones(f)])
            return np.concatenate([scaled.real.ravel(), scaled.imag.ravel()])

        def unpack(x: Array) -> Complex:
            half = len(x) // 2
            result = (x[:half] + 1j * x[half:]).reshape(n, m + f)
            result[0] = result[0].real
            return np.asarray(result * np.concatenate([self.size, np.ones(f)]))

        def back(right: Complex) -> Array:
            result = (inverse @ right[:, :, None])[:, :, 0]
            result[0] = result[0].real
            return pack(result)

        def forward(x: Array) -> Array:
            result = unpack(x)
            dc, dh = result[:, :m], np.where(slow[:, None], result[:, m:], 0.0)
            dy, at = self.torus.values(dc), self.torus.values(dh)
            moved = (self.J @ dy[:, :, None])[:, :, 0] + (self.push @ at[:, :, None])[:, :, 0]
            left = 1j * self.w[:, None] * dc - self.torus.coefficients(moved)
            last = np.where(slow[:, None], dc @ self.free.T, result[:, m:])
            return back(np.concatenate([left, last], axis=1))

        last = np.where(slow[:, None], -c @ self.free.T, 0.0)
        count = 2 * n * (m + f)
        operator = LinearOperator((count, count), matvec=forward, dtype=np.float64)
        right = back(np.concatenate([r, last], axis=1))
        x, missed = gmres(operator, right, rtol=ACCURATE, atol=enough, restart=RESTART, maxiter=ROUNDS)
        if missed or not np.all(np.isfinite(x)):
            return None
        result = unpack(x)
        return result[:, :m], np.where(slow[:, None], result[:, m:], 0.0)

    def inverse(self, w: Array, slow: Whole) -> Complex | None:
        """Inverses (n, m + f, m + f) of the mean equations at any w (n; rad/s), h unknown at `slow`; None: singular."""
        n, (f, m) = len(w), self.free.shape
        A = np.zeros((n, m + f, m + f), dtype=np.complex128)
        A[:, :m, :m] = -self.J.mean(axis=0)
        A[:, range(m), range(m)] += 1j * w[:, None]
        A[:, range(m, m + f), range(m, m + f)] = 1.0
        A[slow, m:, m:] = 0.0
        A[slow, :m, m:], A[slow, m:, :m] = -self.push.mean(axis=0), self.free
        try:
            result = np.asarray(np.linalg.inv(A), dtype=np.complex128)
        except np.linalg.LinAlgError:
            return None
        return result if np.all(np.isfinite(result)) else None


@dataclass(frozen=True, eq=False)
class _Carrier:
    """(8) about rest, y' = rate(y, h), at the nodes of a torus: y a state, h constant wrenches along free directions.

    size   (2 m): natural sizes of the numbers of a state
    """

    scene: Scene
    drive: Drive
    size: Array

    @property
    def free(self) -> Array:
        """(f, 2 m): displacement along free directions from a state."""
        return self.scene.free_displacement

    def rate(self, y: Array, h: Array) -> Array:
        """(M, 2 m)."""
        push = self.scene.effect_of_wrench(self.drive) @ h[:, :, None]
        return np.asarray(self.scene.chart.rate(self.drive, y) + push[:, :, 0])

    def slopes(self, y: Array) -> tuple[Array, Array]:
        """Derivatives (M, 2 m, 2 m) of the rates by y, and (M, 2 m, f) by h."""
        return self.scene.chart.jacobian(self.drive, y), self.scene.effect_of_wrench(self.drive)

    def is_lost(self, y: Array) -> bool:
        """Whether states are beyond what the coordinates reach."""
        return float(np.abs(self.scene.whole(y)[:, 3:6]).max()) > LARGEST


class Solved(NamedTuple):
    """States c (n, m), constant numbers h (n, f) on a torus, and the last linear equations."""

    c: Complex
    h: Complex
    linear: Linearised


def newton(
    equations: _Carrier, torus: Torus, w: Array, slow: Whole, start: tuple[Complex, Complex],
    least: Array, rounding: Array,
) -> Solved | None:  # fmt: skip
    """The solution at frequencies w (n; rad/s), constant at `slow`, from a guess of c and h. None: there is none near.

    least      (n): size of a step, in units of `size`, that is rounding; rounding (m): likewise of a rate
    """
    (c, h), size, linear, before = start, equations.size, None, np.inf
    for _ in range(NEWTON):
        y, at = torus.values(c), torus.values(h)
        if not np.all(np.isfinite(y)) or equations.is_lost(y):
            return None
        left = torus.coefficients(equations.rate(y, at)) - 1j * w[:, None] * c
        if linear is not None and np.all(np.abs(left) <= rounding):
            return Solved(c, h, linear)
        if linear is None:
            linear = Linearised(torus, *equations.slopes(y), equations.free, w, slow, size)
        enough = LOOSE * float((SETTLED * np.abs(c / size).max(initial=0.0) + least).min())
        step = linear.solve(left, c, enough)
        if step is None:
            return None
        c, h = c + step[0], h + step[1]
        change = np.abs(step[0] / size).max(axis=1, initial=0.0)
        if np.all(change <= SETTLED * np.abs(c / size).max(initial=0.0) + least):
            return Solved(c, h, linear)
        if change.max() > SAME * before:  # the linear equations of an earlier step help little here
            linear = None
        before = change.max()
    return None


class _Search:
    """Motions of one order after the other, each from the last."""

    def __init__(
        self, stand: Stand | Scene, base: Array, turns: Whole, phases: Sequence[float] | None, near: Steady | None
    ) -> None:  # fmt: skip
        self.scene = Scene.of(stand) if isinstance(stand, Stand) else stand
        self.base, self.turns, self.speeds = base, turns, turns @ base
        self.phases = np.zeros(len(turns)) if phases is None else np.array(phases, dtype=np.float64)
        self.fastest = float(np.abs(self.speeds).max(initial=0.0)) or 1.0
        self.rounding, self.c = rounding_rates(self.scene, self.speeds), np.zeros((1, 2 * self.scene.count), complex)
        self.near = near.order if near is not None and np.array_equal(near.turns, turns) else 0
        if near is not None and self.near:
            self.c = near.c * np.repeat([1.0, self.fastest / np.abs(near.speeds).max()], self.scene.count)

    def at(self, order: int) -> Steady:
        """The motion by (8). Raises CheckError."""
        torus = Torus.of(len(self.base), order)
        return self._by_equations(order, torus)[0]

    def judged(self, order: int) -> Steady:
        """The motion, with what it leaves out. Raises CheckError."""
        torus = Torus.of(len(self.base), order)
        try:
            larger = Torus.of(len(self.base), order + MORE)
        except CheckError:  # too many nodes
            larger = None
        motion, missing = self._by_equations(order, torus, larger)
        if missing is not None and not motion.c[(torus.k != 0).any(axis=1)].any():
            missing = missing._replace(c=0.0 * missing.c, pose=0.0 * missing.pose)  # no order of the wrenches is above
        return replace(motion, left_out=self._left_out(motion), missing=missing)

    def _by_equations(self, order: int, torus: Torus, larger: Torus | None = None) -> tuple[Steady, Missing | None]:
        w, slow = self._frequencies(torus)
        m, f = self.scene.count, self.scene.free.shape[1]
        size = np.repeat([1.0, self.fastest], m)
        least = np.full(len(w), (ROUNDING + self.scene.noise) / self.fastest**2)
        rounding = np.concatenate([np.full(m, np.inf), self.rounding])
        carrier = _Carrier(self.scene, self._drive(torus), size)
        still = Linearised(torus, np.zeros((torus.M, 0, 0)), np.zeros((torus.M, 0, f)), carrier.free, w, slow, size)
        solved: Solved | None = None
        # at a resonance that of a lower order may lead nowhere
        for known in (self.c,) if self.near else (self.c, np.zeros_like(self.c)):
            start = torus.pad(known[: len(torus.k)]), np.zeros((len(w), f), dtype=np.complex128)
            solved = newton(carrier, torus, w, slow, start, least, rounding) if m else Solved(*start, still)  # clamped
            if solved is not None:
                break
        if solved is None:
            raise self.failure("", order)
        motion = self._motion(order, torus, solved.c, solved.h)
        if larger is None:
            return motion, None
        w, slow = self._frequencies(larger)
        inverse, c, h = solved.linear.inverse(w, slow), larger.pad(solved.c), larger.pad(solved.h)
        if inverse is None:
            return motion, None
        rate = _Carrier(self.scene, self._drive(larger), size).rate(larger.values(c), larger.values(h))
        left = larger.coefficients(rate) - 1j * w[:, None] * c
        missing = (inverse[:, : 2 * m, : 2 * m] @ left[:, :, None])[:, :, 0]
        return motion, self._missing(larger, missing, missing[:, :m] @ self.scene.S.T)

    def _missing(self, torus: Torus, c: Complex, pose: Complex) -> Missing:
        w, slow = self._frequencies(torus)
        w[slow] = 0.0
        return Missing(torus, c, pose, w)

    def _motion(self, order: int, torus: Torus, c: Complex, h: Complex) -> Steady:
        self.c = c
        pose, speeds = np.split(c, 2, axis=1)
        moving = (torus.k != 0).any(axis=1)
        rates = np.maximum(np.abs((torus.k @ self.base)[:, None] * pose), np.abs(speeds))[moving]
        if np.all(rates <= self.rounding / self.fastest):  # nothing moves the carrier
            c = np.where(moving[:, None], 0.0, c)
        return Steady(self.scene, torus, self.base, self.turns, self.phases, order, c, h)

    def _left_out(self, motion: Steady) -> float:
        """See `Steady.left_out`; turning counts by the radius of gyration."""
        scene, m = self.scene, self.scene.count
        theta = np.random.default_rng(1).uniform(0.0, 2.0 * np.pi, (SAMPLES, len(self.base)))
        phi, y, rates, h = motion.at(theta)
        carrier = _Carrier(scene, scene.drive(phi, np.tile(self.speeds, (len(phi), 1))), np.ones(2 * m))
        scale = np.repeat([1.0, gyration_radius(scene)], 3)
        exact, off = (scene.twist(u) * scale for u in (carrier.rate(y, h)[:, m:], (carrier.rate(y, h) - rates)[:, m:]))
        most = float(np.linalg.norm(exact, axis=1).max())
        rounding = float(np.linalg.norm(scene.twist(self.rounding) * scale))
        return float(np.linalg.norm(off, axis=1).max()) / most if most > max(ROUNDING, scene.noise, rounding) else 0.0

    def _frequencies(self, torus: Torus) -> tuple[Array, Whole]:
        """k . w (n; rad/s) and the places of those that are constant."""
        w = torus.k @ self.base
        return w, np.flatnonzero(np.abs(w) <= SLOW * self.fastest)

    def _drive(self, torus: Torus) -> Drive:
        phi = self.phases + torus.angles(self.turns)
        return self.scene.drive(phi, np.tile(self.speeds, (len(phi), 1)))

    def failure(self, why: str, order: int = 0) -> CheckError:
        """Why no motion is found; without a reason, at an order."""
        reason = why or "an undamped resonance, or the carrier moves too violently"
        if not why and len(self.base) > 1:
            reason = f"to order {order} {reason}, or a beat is too slow to be resolved"
        text = ", ".join(f"{x:.6g}" for x in self.speeds)
        return CheckError(f"{self.scene.stand.name} at speeds {text} rad/s: no steady motion found: {reason}")


def rounding_wrench(scene: Scene, speeds: Array) -> Array:
    """(6; N, N m): wrench on the carrier in E1 about O1 that is rounding, at speeds (N, rad/s).

    In a balanced stand inertia forces of the flywheels about O1 cancel, and so do weights.
    """
    still = np.zeros((1, len(speeds)))
    Theta = scene.drive(still, still).Theta[0]
    fastest, g = np.abs(speeds).max(initial=0.0), np.linalg.norm(scene.stand.gravity)
    size = fastest**2 * np.abs(Theta[:, 3:]).sum(axis=1) + g * np.abs(scene.K[:, :3]).sum(axis=1)
    return np.asarray(4.0 * np.finfo(float).eps * size)  # of some sums and products


def rounding_rates(scene: Scene, speeds: Array) -> Array:
    """(m; m/s2, rad/s2): rates of the speeds in a state by that wrench."""
    still = np.zeros((1, len(speeds)))
    return np.asarray(np.abs(scene.drive(still, still).mobility[0]) @ rounding_wrench(scene, speeds))


def gyration_radius(scene: Scene) -> float:
    """Radius of gyration, m."""
    return float(np.sqrt(np.trace(scene.K[3:, 3:]) / np.trace(scene.K[:3, :3])))
