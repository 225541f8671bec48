"""Speeds and phases of redundant wheels that make what is seen quiet in a band, while their momentum stays the same.

The search is to first order in unbalance. Wheels whose spin axes depend on one another have combinations of speeds
without momentum; of wheels that turn together the phases cancel lines. The best speeds lie where something changes:
two wheels begin to turn together, a line leaves the band, a limit is reached. Each is a plane in the space of speeds;
their intersections are tried, and the best are refined by steps along what keeps together wheels that turn together.
Wheels are neither to stop nor to race, unless limits say so: `Freedom.of`.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from scipy.optimize import least_squares, linprog

from mahovik.contract.quantities import RPM
from mahovik.core.stand.hold import twists
from mahovik.core.stand.model import Stand, rest_state
from mahovik.core.stand.motor import UNLIMITED
from mahovik.errors import CheckError, UsageError
from mahovik.proof.reference import pieces
from mahovik.proof.reference.algebra import f
from mahovik.use.numeric.se3 import Array, Complex
from mahovik.use.vibration.chain import Chain
from mahovik.use.vibration.lines import EDGE, SAME, in_band, read_band, read_frequency
from mahovik.use.vibration.plant import natural_at
from mahovik.use.vibration.speeds import SpeedPlan
from mahovik.use.vibration.study import Vibration, vibration
from mahovik.use.vibration.torus import Flags

Band = tuple[float, float]
Limits = tuple[float | None, float | None]

GUARD = 0.02
"""Part of an end of the band that a line keeps from it, to be outside."""

CHANGE = 2.0
"""Largest ratio of speeds of the wheels to what they were, without limits."""

ROUNDING = 1e-9
"""Part of the RMS before below which nothing is left but rounding."""

ORDERS = (1, 2)
"""Orders of the wheels that keep out of frequencies to be avoided."""

RANK = 1e-9
"""Part of the largest singular value below which one is zero."""

MOST, TRIED = 3000, 300
"""Random intersections of planes, if there are more; of these as many are tried, the most promising first."""

QUIET_ENOUGH, ALIKE = 1e-4, 1.02
"""Part of the RMS before, and ratio to the least RMS, within which the smaller change of speeds is preferred."""

STARTS, SWEEPS = 12, 400
"""Random phases from which they are improved one after the other, and rounds over them."""


@dataclass(frozen=True, eq=False)
class Freedom:
    """Speeds that hold a momentum: start + nullspace times anything, N wheels within `floor` and `limit` (rad/s).

    axes     (r, N): momentum along the directions that carrier and wheels share, by speed, kg m2
    avoid    bands (Hz) that no order of a wheel may meet
    """

    start: Array
    nullspace: Array
    axes: Array
    floor: Array
    limit: Array
    avoid: tuple[Band, ...]

    @staticmethod
    def of(stand: Stand, speeds: Array, momentum: Array | None, limit: Limits, avoid: Sequence[Band]) -> Freedom:
        """Freedom of the wheels of a stand about speeds (N, rad/s); momentum (3, in E1, N m s), None: that of them.

        limit   lowest and highest speed, rad/s. None: each wheel keeps half of its given speed, or of that at the start
                if it is less, and none is faster than its motor without load, or than twice the fastest without motor.

        Raises UsageError: no speeds are free, or none hold the momentum; CheckError: it needs more than the limits.
        """
        N = len(stand.flywheels)
        turns = twists(stand.hold)[3:].T
        size = np.linalg.norm(turns, axis=1)
        shared = turns[size > 0.0] / size[size > 0.0, None]  # along them wheels and carrier share momentum
        bodies = pieces(stand, rest_state(stand)).flywheels
        axes = shared @ np.array([s.L[3:, 3:] @ f[3:] * float(f @ s.Theta @ f) for s in bodies]).reshape(N, 3).T
        left, sizes, right = np.linalg.svd(axes)
        rank = int(np.sum(sizes > RANK * sizes.max(initial=0.0)))
        if max(rank + 1, 2) > N:
            raise UsageError(
                f"improve: {N} flywheels with spin axes of rank {rank} leave no speeds free; "
                f"expected {max(rank + 1, 2)} or more"
            )
        wanted = axes @ speeds if momentum is None else shared @ momentum
        outside = float(np.linalg.norm(left[:, rank:].T @ wanted))
        if outside > RANK * max(float(np.linalg.norm(wanted)), 1e-30):
            raise UsageError(f"momentum: {outside:.4g} N m s of it are perpendicular to all spin axes")
        start = speeds + np.linalg.pinv(axes, rcond=RANK) @ (wanted - axes @ speeds)
        low, high = limit
        fastest = CHANGE * float(np.abs([speeds, start]).max()) if high is None else math.inf
        motors = [(s.motor or UNLIMITED).no_load or fastest for s in stand.flywheels]
        limits = np.minimum(np.array(motors), math.inf if high is None else high)
        start = start_within_limits(start, right[rank:].T, limits)
        floor = np.minimum(np.abs(start), np.abs(speeds)) / CHANGE if low is None else np.full(N, low)
        return Freedom(start, right[rank:].T, axes, floor, limits, tuple(avoid))

    def allows(self, speeds: Array) -> Flags:
        """Whether speeds (S, N) are within the limits and avoid what they must."""
        size = np.abs(speeds)
        good = ((size >= self.floor * (1.0 - EDGE)) & (size <= self.limit * (1.0 + EDGE))).all(axis=1)
        for low_high, order in itertools.product(self.avoid, ORDERS):
            good &= ~in_band(order * size / (2.0 * np.pi), low_high).any(axis=1)
        return np.asarray(good)

    def intersections(self, band: Band, rng: np.random.Generator) -> Iterator[Array]:
        """The start, then speeds on as many planes as speeds are free: all of them, or MOST random ones."""
        rows, values, pairs = self._planes(band)
        yield self.start
        P, d = len(values), self.nullspace.shape[1]
        choices: Iterator[Sequence[int]] = itertools.chain.from_iterable(
            itertools.combinations(range(P), k) for k in range(1, d + 1)
        )
        if sum(math.comb(P, k) for k in range(1, d + 1)) > MOST:
            choices = itertools.chain(((p,) for p in range(P)), (_draw(P, pairs, d, rng) for _ in range(MOST)))
        for chosen in map(list, choices):
            off = values[chosen] - rows[chosen] @ self.start
            step, *_ = np.linalg.lstsq(rows[chosen] @ self.nullspace, off, rcond=1e-9)
            speeds = self.start + self.nullspace @ step
            if np.abs(rows[chosen] @ speeds - values[chosen]).max() <= 1e-10 * max(1.0, float(np.abs(speeds).max())):
                yield speeds

    def _planes(self, band: Band) -> tuple[Array, Array, int]:
        """row . speeds = value: rows (P, N), values (P), and how many are those where two wheels turn together."""
        N = len(self.start)
        unit = np.eye(N)
        rows = [unit[i] + sign * unit[j] for i, j in itertools.combinations(range(N), 2) for sign in (-1.0, 1.0)]
        values, pairs = [0.0] * len(rows), len(rows)
        edges = [2.0 * np.pi * x for x in (band[0] * (1.0 - 2 * EDGE), band[1] * (1.0 + 2 * EDGE)) if 0 < x < math.inf]
        for (low, high), order in itertools.product(self.avoid, ORDERS):
            edges += [2.0 * np.pi * low / order * (1.0 - 2 * EDGE), 2.0 * np.pi * high / order * (1.0 + 2 * EDGE)]
        for s in range(N):
            for edge in (*edges, *(x for x in (self.floor[s], self.limit[s]) if 0.0 < x < math.inf)):
                rows += [unit[s], unit[s]]
                values += [edge, -edge]
        return np.array(rows), np.array(values), pairs

    def directions(self, speeds: Array) -> Array:
        """Orthonormal rows: changes of speeds that keep the momentum, and wheels together that turn together."""
        kept = []
        for first, *more in groups(speeds):
            for s in more:
                row = np.zeros(len(speeds))
                row[first], row[s] = np.sign(speeds[first]), -np.sign(speeds[s])
                kept.append(row @ self.nullspace)
        if not kept:
            return self.nullspace.T
        _, sizes, right = np.linalg.svd(np.array(kept))
        return np.asarray(right[int(np.sum(sizes > 1e-9)) :] @ self.nullspace.T)


def _draw(P: int, pairs: int, d: int, rng: np.random.Generator) -> list[int]:
    """A random choice of at most d planes, most of them where two wheels turn together."""
    k = int(rng.integers(2, d + 1)) if d > 1 else 1
    return sorted({int(rng.integers(0, pairs if rng.random() < 0.7 else P)) for _ in range(k)})


def start_within_limits(start: Array, nullspace: Array, limit: Array) -> Array:
    """Speeds of the momentum of `start` within the limits, the start itself where it is. Raises CheckError."""
    bounded = np.isfinite(limit)
    if (np.abs(start) <= limit).all():
        return start
    rows, d = nullspace[bounded], nullspace.shape[1]
    bound = limit[bounded, None]
    upper = np.vstack([np.hstack([rows, -bound]), np.hstack([-rows, -bound])])
    right = np.concatenate([-start[bounded], start[bounded]])
    solution = linprog(np.append(np.zeros(d), 1.0), upper, right, bounds=[(None, None)] * d + [(0.0, None)])
    if solution.x is None or solution.x[-1] > 1.0 + EDGE:
        times = "" if solution.x is None else f"it needs {solution.x[-1]:.4g} times "
        raise CheckError(f"momentum out of reach: {times or 'no speeds are within '}the speed limits")
    return np.asarray(start + nullspace @ solution.x[:-1])


def improve(
    chain: Chain,
    freedom: Freedom,
    band: Band,
    *,
    seed: int = 0,
    go_on: Callable[[], bool] = lambda: True,
) -> tuple[Array, Array]:
    """Quiet speeds (N, rad/s) and phases at t = 0 (N, rad) of the wheels. Raises CheckError: no speeds are allowed.

    band    Hz, in which the root mean square counts, of all axes together; go_on: False ends the search
    """
    search = _Search(chain, freedom, (band[0] * (1.0 - GUARD), band[1] * (1.0 + GUARD)), np.random.default_rng(seed))
    tried = np.array(list(freedom.intersections(search.band, search.rng)))
    tried = tried[np.unique(np.round(tried, 6), axis=0, return_index=True)[1]]
    tried = tried[freedom.allows(tried)]
    if not len(tried):
        raise CheckError(
            "limit, avoid: no speeds that hold the momentum keep out of these frequencies within the limits"
        )
    bounds = search.bound(tried)
    before = max(float(search.unheld(freedom.start[None])[0]), 1e-300)
    evaluated: list[tuple[float, float, Array]] = []
    for i in np.argsort(bounds, kind="stable")[:TRIED]:
        enough = max(ALIKE**2 * min((one[0] for one in evaluated), default=np.inf), QUIET_ENOUGH**2 * before)
        if evaluated and (bounds[i] > enough or not go_on()):
            break
        evaluated.append(search.evaluate(tried[i]))
    for one in sorted(evaluated, key=lambda one: one[0])[:4]:
        if one[0] > QUIET_ENOUGH**2 * before and go_on():
            evaluated.append(search.descend(one, go_on))
    enough = max(ALIKE**2 * min(one[0] for one in evaluated), QUIET_ENOUGH**2 * before)
    _, _, speeds = min((one for one in evaluated if one[0] <= enough), key=lambda one: one[1])
    return speeds, np.mod(search.phases(speeds, 4 * STARTS)[0], 2.0 * np.pi)


class Improved(NamedTuple):
    """Quiet speeds (N, rad/s) and phases (N, rad); RMS of the whole equations before and after."""

    speeds: Array
    phases: Array
    before: float
    after: float

    @property
    def gain(self) -> str:
        """How much quieter it is, in words."""
        if not self.after < self.before:
            return "no allowed speeds are quieter"
        if self.after <= ROUNDING * self.before:
            return "no line above rounding is left in the band"
        return f"{self.before / self.after:.4g} times quieter"

    def remarks(self, start: Vibration, band: Band) -> list[str]:
        """Sentences: wheels that stop, wheels with order 1 outside of the band, speed and phase of every wheel."""
        inside = [in_band(np.abs(x) / (2.0 * np.pi), band) & (x != 0.0) for x in (start.speeds[0], self.speeds)]
        still = np.flatnonzero((self.speeds == 0.0) & (start.speeds[0] != 0.0))
        gone = np.flatnonzero(inside[0] & ~inside[1] & (self.speeds != 0.0))
        changes = {"stop: ": still, f"order 1 is outside of {band[0]:g}..{band[1]:g} Hz: ": gone}
        names = start.plan.names
        return [
            *(words + ", ".join(names[s] for s in wheels) for words, wheels in changes.items() if len(wheels)),
            *(
                f"{wheel}: {RPM * turning:.6f} rpm, phase {np.degrees(angle):.3f} deg at t = 0"
                for wheel, turning, angle in zip(names, self.speeds, self.phases, strict=True)
            ),
        ]


def improve_vibration(
    start: Vibration, freedom: Freedom, band: Band, *, seed: int = 0, go_on: Callable[[], bool] = lambda: True
) -> Improved:
    """Quieter speeds and phases than those of a study at one set of speeds, judged by the whole equations.

    band, seed, go_on  as of `improve`

    Raises CheckError: no speeds are allowed.
    """
    speeds, phases = improve(start.chain, freedom, band, seed=seed, go_on=go_on)
    speeds = np.where(np.abs(speeds) > ROUNDING * np.abs(start.speeds[0]).max(initial=1.0), speeds, 0.0)
    stand, within = start.scene.stand, None if band == (0.0, np.inf) else band
    plan, makers = SpeedPlan.constants(stand, speeds.tolist()), start.chain.makers
    after = vibration(start.scene, plan, start.seen, phases=phases.tolist(), makers=makers, bands=[within])
    before, now = (float(np.linalg.norm(spectra.sums(within).rms[0])) for spectra in (start, after))
    return Improved(speeds, phases, before, now)


def avoided_bands(vibration: Vibration, avoid: str | Sequence[str | Sequence[float | str]]) -> list[Band]:
    """Bands (Hz) to be avoided: ranges as they are, 10 % to both sides of frequencies. Raises UsageError."""
    bands = []
    for text in [avoid] if isinstance(avoid, str) else avoid:
        if not isinstance(text, str) or ".." in text:
            bands.append(read_band("avoid", text))
            continue
        single = [read_frequency("avoid", text)] if text != "modes" else []
        if text == "modes" and vibration.scene.count:
            single = natural_at(vibration.chain.plant, vibration.speeds)[0][0].tolist()
        bands += [(0.9 * f, 1.1 * f) for f in single if f > 0.0]
    return bands


@dataclass(frozen=True, eq=False)
class _Search:
    chain: Chain
    freedom: Freedom
    band: Band
    rng: np.random.Generator

    def amplitudes(self, speeds: Array) -> Complex:
        """Amplitudes (S, N, 3) of first orders in the band, of phases zero, at speeds (S, N); zero outside."""
        omega, a = self.chain.first_orders(speeds, np.zeros(speeds.shape[1]))
        return np.where((in_band(omega / (2.0 * np.pi), self.band) & (omega > 0.0))[:, :, None], a, 0.0)

    def unheld(self, speeds: Array) -> Array:
        """Mean square (S) where no phase is held, the mean over all."""
        return np.asarray((np.abs(self.amplitudes(speeds)) ** 2).sum(axis=(1, 2)) / 2.0)

    def bound(self, speeds: Array) -> Array:
        """Lower bound (S) of the mean square, of wheels that turn alone: of others the lines may cancel."""
        a = self.amplitudes(speeds)
        for row, omega in zip(a, speeds, strict=True):
            for group in groups(omega):
                row[group if len(group) > 1 else []] = 0.0
        return np.asarray((np.abs(a) ** 2).sum(axis=(1, 2)) / 2.0 * (1.0 - 1e-3))

    def evaluate(self, speeds: Array) -> tuple[float, float, Array]:
        """Mean square with the best phases, largest change of a speed, the speeds."""
        return self.phases(speeds)[1], float(np.abs(speeds - self.freedom.start).max()), speeds

    def phases(self, speeds: Array, starts: int = STARTS) -> tuple[Array, float]:
        """Best phases (N, rad) at speeds (N), and the mean square; the first of wheels that turn together has zero."""
        a, phases, total = self.amplitudes(speeds[None])[0].T, np.zeros(len(speeds)), 0.0
        for group in groups(speeds):
            psi, least = cancel(a[:, group], self.rng, starts)
            phases[group] = np.sign(speeds[group]) * psi
            total += least / 2.0
        return phases, total

    def descend(self, best: tuple[float, float, Array], go_on: Callable[[], bool]) -> tuple[float, float, Array]:
        """Steps along directions that keep wheels together, halved where none helps."""
        basis = self.freedom.directions(best[2])
        step = 0.1 * max(float(np.abs(best[2]).max()), 1.0)
        smallest = 1e-5 * step
        while step > smallest and len(basis) and go_on():
            near = best[2] + step * np.vstack([basis, -basis])
            better = min(
                map(self.evaluate, near[self.freedom.allows(near)]),
                key=lambda candidate: candidate[0],
                default=(math.inf, 0.0, near),
            )
            if better[0] < best[0] * (1.0 - 1e-9):
                best = better
            else:
                step /= 2.0
        return best


def groups(speeds: Array) -> list[list[int]]:
    """Groups of wheels of equal speed, by magnitude of speed, without those at rest."""
    result: list[list[int]] = []
    for s in np.argsort(np.abs(speeds), kind="stable").tolist():
        size = abs(speeds[s])
        if result and size - abs(speeds[result[-1][0]]) <= SAME * size:
            result[-1].append(s)
        elif size > 0.0:
            result.append([s])
    return result


def cancel(a: Complex, rng: np.random.Generator, starts: int) -> tuple[Array, float]:
    """Angles psi (m; the first 0) that minimise |sum_k a_k exp(i psi_k)|^2, and the minimum; a: axes x m.

    Each angle in turn is set to its best value for the others, which never increases the sum, from many starts at once;
    the best is refined by least squares.
    """
    m = a.shape[1]
    if m == 1 or not a.any():
        return np.zeros(m), float(np.sum(np.abs(a) ** 2))
    R = a.conj().T @ a
    z = np.exp(1j * rng.uniform(-np.pi, np.pi, (starts, m)))
    before = np.full(starts, np.inf)
    for sweep in range(SWEEPS):
        for k in range(m):
            rest = z @ R[k] - z[:, k] * R[k, k]
            z[:, k] = np.where(rest == 0.0, z[:, k], -rest / np.where(rest == 0.0, 1.0, np.abs(rest)))
        if sweep % 10 == 9:
            now = np.sum(np.abs(z @ a.T) ** 2, axis=1)
            if np.all(before - now <= 1e-9 * now):
                break
            before = now
    best = np.angle(z[int(np.argmin(np.sum(np.abs(z @ a.T) ** 2, axis=1)))])
    scale = 1.0 / np.abs(a).max()

    def rows(psi: Array) -> Array:
        total = scale * (a @ np.exp(1j * np.append(0.0, psi)))
        return np.concatenate([total.real, total.imag])

    psi = np.append(0.0, least_squares(rows, (best - best[0])[1:], xtol=1e-15, ftol=1e-15, gtol=1e-15).x)
    return np.angle(np.exp(1j * psi)), float(np.sum(np.abs(a @ np.exp(1j * psi)) ** 2))
