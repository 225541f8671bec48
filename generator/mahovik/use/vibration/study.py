"""Vibration of what is seen, at one set of constant speeds or over a sweep: linear lines, and the whole equations.

At every speed each wheel's first order is a line of the linear equations about the mean motion, beside the lines of
makers' tables. The whole equations (8) are solved for the phases as they are: for one set of speeds; of a sweep where
any sum is largest, and at some speeds more. Where they give another root mean square by FAR_OFF or more, or none, at
all speeds; where the next speed has a larger motion, or alone has one, that is followed: at a lightly damped peak that
bends, Newton's method finds nothing from rest, or the smaller of two motions.
So what a requirement is judged by, the largest value, is that of the whole equations, for one speed as in a sweep.

A sweep needs speeds beside its even grid, so that its largest amplitude is the true one. First where an order of a
flywheel meets a natural frequency, and a half width of the resonance to either side: a peak that is narrower than the
grid is not missed. Orders of makers' tables meet very many: of these only resonances that stand out or that a largest
sum may be at. Then gaps beside the largest peaks are halved until a parabola through the logarithms says that nothing
is between them: springs that stiffen move peaks.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mahovik.contract.quantities import RPM
from mahovik.core.stand.hold import numbers_in_words
from mahovik.core.stand.model import Stand
from mahovik.errors import CheckError
from mahovik.use.numeric.se3 import Array
from mahovik.use.vibration.chain import Band, Chain, Makers, noise, spectrum, undamped_mode
from mahovik.use.vibration.lines import LineName, Lines, Requirement, Spectrum, Sums, in_band, size_of
from mahovik.use.vibration.plant import Plant, Scene, crossings, natural_at, orders_of
from mahovik.use.vibration.speeds import SpeedPlan
from mahovik.use.vibration.steady import Steady, steady
from mahovik.use.vibration.view import Observable

GRID = 200
"""Speeds, at least, between which natural frequencies are followed."""

NARROWEST = 1e-7
"""Part of the swept range: closer speeds are one."""

LARGEST = 0.9
"""Part of the largest value that another peak must have to be looked at."""

MISSED = 0.003
"""Part by which a parabola may say that a peak is above its largest value."""

STEEP = 0.6
"""Part of a peak's value below which its neighbour is too far for a parabola."""

ROUNDS = 16
"""Halvings of the speeds about a peak at most."""

ROUNDING = 1e-6
"""Part of the largest sum of all axes below which that of one is rounding."""

CHUNK = 1_000_000
"""Pairs of resonances treated at once."""

TURN = 2.0 * np.pi


class Resonances(NamedTuple):
    """Values of the swept speed and half widths (C, rad/s) where an order of a wheel, by its number, is resonant."""

    at: Array
    width: Array
    wheel: NDArray[np.int_]
    order: Array

    def some(self, which: NDArray[np.bool_]) -> Resonances:
        """Those of which (C) is true."""
        return Resonances(self.at[which], self.width[which], self.wheel[which], self.order[which])

    @property
    def values(self) -> Array:
        """The values, and those a half width beside them."""
        return np.concatenate([self.at - self.width, self.at, self.at + self.width])


def resonances(
    plant: Plant,
    plan: SpeedPlan,
    steps: int,
    orders: Sequence[Iterable[float]],
    modes: Sequence[tuple[float, float]] = (),
) -> Resonances:
    """The resonances within a sweep.

    orders   by flywheel; modes: natural frequency (rad/s) and damping of others than the carrier's
    """
    low, high = sorted(plan.sweep or (0.0, 0.0))
    values = np.linspace(low, high, max(steps, GRID))
    natural = natural_at(plant, plan.rows(values))[0] if plant.scene.count else np.zeros((len(values), 0))
    rows: list[tuple[float, float, int, float]] = []
    for s, (c, k) in enumerate(zip(plan.constant, plan.factor, strict=True)):
        for order in orders[s] if c or k else ():
            met = crossings(plant, plan, values, natural, order * c, order * k)
            near = [(mode.speed, mode.damping * mode.frequency * TURN) for mode in met]
            if k:
                near += [((way * omega / order - c) / k, zeta * omega) for omega, zeta in modes for way in (-1.0, 1.0)]
            rows += [(x, abs(width / (order * k or np.inf)), s, order) for x, width in near if low <= x <= high]
    at, half, wheel, of = np.array(rows).reshape(-1, 4).T
    return Resonances(at, half, wheel.astype(int), of)


def mattering(values: Array, sums: Sums, met: Resonances, size: Array) -> NDArray[np.bool_]:
    """(C): whether resonances whose lines have sizes (C, 3) matter beside sums at values (S, rad/s).

    Such stand out of the root mean square beside them, or a largest sum may be at them: at most that beside them and
    the resonances about them.
    """
    result: NDArray[np.bool_] = np.asarray(~np.isfinite(size).all(axis=1))
    size, order = np.where(result[:, None], 0.0, size), np.argsort(values)
    right = np.clip(np.searchsorted(values[order], met.at), 1, len(values) - 1)
    width, more = np.maximum(met.width, 1e-300), np.zeros_like(size)
    for rows in np.array_split(np.arange(len(size)), 1 + len(size) ** 2 // CHUNK):
        more[rows] = 1.0 / np.hypot(1.0, (met.at[rows, None] - met.at) / width) @ size
    for sum_ in sums:
        beside = np.maximum(sum_[order[right - 1]], sum_[order[right]])
        bound, known = (np.column_stack([x, np.linalg.norm(x, axis=1)]) for x in (beside + more, sum_))
        largest = np.nan_to_num(known).max(axis=0)
        result |= (~(bound < LARGEST * largest) & (largest > ROUNDING * largest[3])).any(axis=1)
        if sum_ is sums.rms:
            result |= np.linalg.norm(size, axis=1) > np.linalg.norm(beside, axis=1)
    return result


def merged(plan: SpeedPlan, values: Array, more: Array) -> Array:
    """Values of the swept speed with more between them, in the direction of the sweep; close ones are one."""
    low, high = sorted(plan.sweep or (0.0, 0.0))
    kept = [x for x in more[(more >= low) & (more <= high)] if np.abs(values - x).min() > NARROWEST * (high - low)]
    result = np.unique(np.concatenate([values, kept]))
    return result if plan.sweep is None or plan.sweep[0] < plan.sweep[1] else result[::-1]


def unsettled(values: Array, sizes: Array) -> Array:
    """Values (rad/s) to be added about the largest peaks of sizes (S) at values (S, in order); none: they are true.

    A size that is NaN has no limit, beside it nothing can be settled. Ends of the range are no peaks, nor are places
    beside a size of 0, that of a stand at rest.
    """
    q = np.nan_to_num(sizes, nan=np.inf)
    largest = q[np.isfinite(q)].max(initial=0.0)
    more: list[float] = []
    for i in range(1, len(q) - 1):
        left, top, right = q[i - 1 : i + 2]
        if not (min(left, right) > 0.0 and max(left, right, LARGEST * largest) <= top < np.inf):
            continue
        if min(left, right) < STEEP * top or _missed(values, q, i) > MISSED:
            more += [(values[i - 1] + values[i]) / 2.0, (values[i] + values[i + 1]) / 2.0]
    return np.array(more)


def _missed(values: Array, q: Array, i: int) -> float:
    """Part by which the top of a parabola through three logarithms is above the middle one."""
    x, y = values[i - 1 : i + 2] - values[i], np.log(np.maximum(q[i - 1 : i + 2], 1e-300) / q[i])
    slope, curve = np.linalg.solve(np.column_stack([x[[0, 2]], x[[0, 2]] ** 2]), y[[0, 2]])
    return float(np.expm1(-(slope**2) / (4.0 * curve))) if curve < 0.0 else 0.0


FAR_OFF = 0.01
"""Difference of the RMS of the linear equations from that of the whole ones above which these are solved everywhere."""

SMALL = 1e-3
"""Part of the largest RMS of a sweep below which such a difference does not matter."""

STILL = 1e-15
"""SI: a smaller RMS is rounding."""

EQUAL, MOST_OFF = 1e-6, 1e-3
"""Part by which a sum may be above the largest of the whole equations and count as equal to it, beside what the linear
equations are off where both are known, of which at most MOST_OFF: a free satellite has the same amplitudes at all
speeds.
"""

COMPARED = 4
"""Speeds of a sweep at which the whole equations are solved beside those of the largest sums."""

FOLLOWED = 32
"""Steps at most, by their size, in which a motion is followed to the next speed."""

TOO_MUCH = 0.01
"""Part of the worst case that a solution may leave out."""

NOISES = 9
"""Speeds of a sweep at which noise is found beside those of the largest sums; it is linear between them."""

GoOn = Callable[[int, int], bool]


class Verdict(NamedTuple):
    """How a requirement is met: value on the worst axis at the worst speed; infinite without a steady motion."""

    requirement: Requirement
    value: float
    step: int
    axis: int

    @property
    def met(self) -> bool:
        """Whether the value is within the limit."""
        return self.value <= self.requirement.limit


class Largest(NamedTuple):
    """The largest length that one frequency gives what is seen: at a step, Hz."""

    value: float
    step: int
    frequency: float


@dataclass(frozen=True, eq=False)
class Vibration:
    """Lines of what is seen at S speeds.

    value      (S, rad/s): the swept speed, or that of the first wheel that turns; phases (N, rad) at t = 0
    noises     (S, 3): mean square of the noise by band (Hz; None: all)
    whole      by step: solutions of the whole equations, or why there is none
    problems   by step: why there is no steady motion, or an inaccurate one; no requirement is met there
    off        largest difference of the linear equations' RMS from the whole ones', where both are known
    coarse     a speed (rad/s) near which `go_on` ended the search of the largest amplitude; None: it is the true one
    """

    scene: Scene
    plan: SpeedPlan
    chain: Chain
    value: Array
    phases: Array
    lines: Lines
    noises: dict[Band | None, Array]
    whole: dict[int, Spectrum]
    problems: dict[int, str]
    off: float = 0.0
    coarse: float | None = None

    @property
    def seen(self) -> Observable:
        """What is seen."""
        return self.chain.seen

    @property
    def speeds(self) -> Array:
        """Speeds (S, N; rad/s)."""
        return self.plan.rows(self.value)

    def sums(self, band: Band | None = None) -> Sums:
        """The sums within a band that the study knows (Hz; None: all)."""
        return self.lines.sums(self.noises[band], band)

    def lengths(self, band: Band | None = None) -> Sums:
        """Those of the length of what is seen."""
        return self.lines.lengths(self.noises[band], band)

    def judge(self, requirement: Requirement) -> Verdict:
        """Whether a requirement is met at all speeds, with the makers' tolerances and what solutions leave out."""
        sums = self.lines.with_tolerances().sums(self.noises[requirement.band], requirement.band)
        values = getattr(sums, requirement.sum).copy()
        for i, solution in self.whole.items():
            values[i] += np.nan_to_num(solution.left_out)
        values[list(self.problems)] = np.inf
        values = np.where(np.isfinite(values), values, np.inf)
        step, axis = np.unravel_index(int(np.argmax(values)), values.shape)
        return Verdict(requirement, float(values.max()), int(step), int(axis))

    def rpm(self, step: int) -> str:
        """The swept speed at a step, in words."""
        return f"{RPM * self.value[step]:.6g} rpm"

    def verdict_entry(self, verdict: Verdict) -> dict[str, Any]:
        """A requirement and how it is met, in SI."""
        wanted, axes = verdict.requirement, self.seen.axes
        return {
            "text": wanted.text, "value": verdict.value, "limit": wanted.limit, "unit": self.seen.measure.unit,
            "met": verdict.met, "speed": float(self.value[verdict.step]),
            "axis": axes[min(verdict.axis, len(axes) - 1)],
        }  # fmt: skip

    def verdict_words(self, verdict: Verdict) -> str:
        """A requirement and how far it is met, in words."""
        wanted, axes = verdict.requirement, self.seen.axes
        said = f"{'met' if verdict.met else 'FAILED'}: {wanted.text}"
        where = f" at {self.rpm(verdict.step)}" if self.plan.sweep is not None else ""
        if not np.isfinite(verdict.value):
            return f"{said}: there is no steady motion{where}"
        unit, size = wanted.unit
        largest = f"{verdict.value / size:.4g} {unit} on {axes[min(verdict.axis, len(axes) - 1)]}{where}"
        tolerant = " with the makers' tolerances" if any(name.tolerance for name in self.lines.names) else ""
        share = float(f"{verdict.value / wanted.limit:.3g}")
        return f"{said}: {largest}{tolerant}, {share:g} times the limit"

    def remarks(self) -> list[str]:
        """Sentences on accuracy, problems, stability, and what is held."""
        many, messages = len(self.value), []
        if many > 1:
            of = f"the whole equations are solved at {len(self.whole)} of {many} speeds; "
            messages.append(f"{of}the RMS of the linear ones is that of theirs within {self.off:.1e}")
        for step, words in list(self.problems.items())[:1]:
            where = f"at {self.rpm(step)}: " if many > 1 else ""
            more = f"; so at {len(self.problems)} speeds" if len(self.problems) > 1 else ""
            messages.append(f"warning: {where}{words}{more}")
        if self.coarse is not None:
            near = f"coarse near {RPM * self.coarse:.6g} rpm"
            messages.append(
                f"warning: {near}: its search ended before the largest amplitude was known to be the true one"
            )
        unstable = [step for step, spectrum in self.whole.items() if spectrum.unstable]
        if unstable:
            messages.append(f"warning: unstable at {self.rpm(min(unstable))}: deviations from this motion grow")
        holds = [spectrum.hold for spectrum in self.whole.values()]
        hold = max(holds, key=lambda w: float(np.abs(w).max()), default=np.zeros(6))
        if np.abs(hold).max() > 1e-12:
            force, moment = (float(np.linalg.norm(part)) for part in (hold[:3], hold[3:]))
            words = f"a constant wrench of up to {force:.3g} N and {moment:.3g} N m holds its mean place"
            messages.append(f"the stand is free to drift: {words}")
        if self.chain.makers.structure is not None:
            mass, gyro = (float(ratio.max(initial=0.0)) for ratio in self.chain.ratios)
            shift = f"would shift a frequency by up to {50 * mass:.3g} % and couple modes by up to {100 * gyro:.3g} %"
            messages.append(f"structural modes do not act back on the wheels, which {shift}")
        if self.seen.name.startswith("hold.") and (words := numbers_in_words(self.scene.stand.hold, "hold.")):
            messages.append(words)
        return messages

    def largest(self, band: Band | None = None) -> Largest:
        """The largest amplitude in a band; lines of one frequency add up."""
        f, a = self.lines.by_frequency(band)
        size = np.nan_to_num(size_of(a))
        if not size.any():
            return Largest(0.0, 0, 0.0)
        at = np.unravel_index(int(size.argmax()), size.shape)
        return Largest(float(size[at]), int(at[0]), float(f[at]))


def vibration(
    stand: Stand | Scene,
    plan: SpeedPlan,
    seen: Observable,
    *,
    steps: int = 61,
    phases: Sequence[float] | None = None,
    makers: Makers | None = None,
    bands: Sequence[Band | None] = (None,),
    go_on: GoOn = lambda done, planned: True,
) -> Vibration:
    """Vibration at `steps` even speeds, and more at resonances and about the largest peaks; at one without a sweep.

    bands   whose sums will be asked for, Hz; None: all
    makers  tables of the wheels' disturbances and of structural modes; an order in a wheel's table replaces its own
    go_on   gets numbers of solutions done and planned, and ends the search with False

    Raises UsageError, TableError: a mode shape is missing. CheckError: no equilibrium, or no speed has a steady
    state.
    """
    scene = stand if isinstance(stand, Scene) else Scene.of(stand)
    value = np.array(plan.values(steps))
    fastest = np.abs(plan.rows(value)).max(axis=0)
    chain = Chain.of(scene, seen, makers or Makers(), fastest)
    start = np.zeros(len(fastest)) if phases is None else np.array(phases, dtype=np.float64)
    study = _Study(scene, plan, chain, start, tuple(dict.fromkeys([None, *bands])), go_on)
    result = study.sweep(value, steps) if plan.sweep is not None else study.one(value)
    if len(result.problems) == len(result.value):
        raise CheckError(next(iter(result.problems.values())))
    return result


def _size(solved: Spectrum | str) -> float:
    """Root of the sum of the squares of the lines; 0 where there is no steady motion."""
    return 0.0 if isinstance(solved, str) else float(np.linalg.norm(solved.amplitude))


@dataclass(eq=False)
class _Study:
    """What is known of a study so far: solutions, noise and linear lines by the value of the swept speed."""

    scene: Scene
    plan: SpeedPlan
    chain: Chain
    phases: Array
    bands: tuple[Band | None, ...]
    go_on: GoOn
    solved: dict[float, Spectrum | str] = field(default_factory=dict)
    motions: dict[float, Steady] = field(default_factory=dict)
    followed: set[tuple[float, float]] = field(default_factory=set)
    noises: dict[float, Array] = field(default_factory=dict)
    known: tuple[Array, Lines, Lines] = field(default_factory=lambda: (np.zeros(0), Lines.none(0), Lines.none(0)))
    cut: bool = False

    def one(self, value: Array) -> Vibration:
        """One set of speeds."""
        self.solve(value)
        return self.result(value)

    def sweep(self, value: Array, steps: int) -> Vibration:
        """A sweep, with speeds added until its largest values are the true ones."""
        tables = self.chain.makers.harmonics
        orders = [{*orders_of(self.scene), *(tables[s].order if s in tables else ())} for s in self.plan.names]
        met = resonances(self.chain.plant, self.plan, steps, orders, self.chain.modes)
        of_table = [
            self.plan.names[s] in tables and order in tables[self.plan.names[s]].order
            for s, order in zip(met.wheel, met.order, strict=True)
        ]
        tabled = np.array(of_table, dtype=bool)
        value = merged(self.plan, value, met.some(~tabled).values)
        value = merged(self.plan, value, self.mattering(value, met.some(tabled)).values)
        value, _ = self.refine(value, lambda value: self.result(value, noisy=False))
        rows = np.linspace(0, len(value) - 1, COMPARED).astype(int).tolist()
        self.solve(value[self.largest(self.result(value)) + rows])
        vibration = self.result(value)
        while (rows := self.largest(vibration)) and self.solve(value[rows]):  # the largest need not stay so
            vibration = self.result(value)
        if self.cut or (vibration.off <= FAR_OFF and len(self.motions) == len(self.solved)):
            return replace(vibration, coarse=float(value[vibration.largest().step]) if self.cut else None)
        value, coarse = self.refine(value, lambda value: self.result(value) if self.follow(value) else None)
        return replace(self.result(value), coarse=coarse)

    def mattering(self, value: Array, met: Resonances) -> Resonances:
        """Those of the resonances of makers' tables that matter in any band, with the tolerances of the tables."""
        if not len(met.at):
            return met
        vibration, tables = self.result(value, noisy=False), self.chain.makers.harmonics
        size, hertz, matters = np.zeros((len(met.at), 3)), np.zeros(len(met.at)), np.zeros(len(met.at), dtype=bool)
        for s in np.unique(met.wheel):
            rows, speeds = met.wheel == s, self.plan.rows(met.at[met.wheel == s])
            lines = self.chain.wheel_lines(s, tables[self.plan.names[s]], speeds).with_tolerances()
            of_order = np.array([name.order for name in lines.names]) == met.order[rows, None]
            size[rows] = np.where(of_order[..., None], lines.sizes, 0.0).sum(axis=1)
            hertz[rows] = np.abs(speeds[:, s]) * met.order[rows] / (2.0 * np.pi)
        for band in self.bands:
            inside = in_band(hertz, band or (0.0, np.inf))
            sums = vibration.lines.with_tolerances().sums(0.0, band)
            largest = np.linalg.norm(size, axis=1) >= LARGEST * vibration.largest(band).value
            matters[inside] |= largest[inside] | mattering(value, sums, met.some(inside), size[inside])
        return met.some(matters)

    def refine(self, value: Array, study: Callable[[Array], Vibration | None]) -> tuple[Array, float | None]:
        """Speeds with those that the largest peaks need, and one near which they may be higher; None: they are true."""
        near = np.zeros(0)
        for _ in range(ROUNDS):
            vibration = study(value)
            if vibration is None:
                break
            lengths = vibration.lengths()
            near = np.concatenate([unsettled(value, size) for size in (lengths.rms, lengths.worst)])
            more = merged(self.plan, value, np.append(near, list(self.motions)))
            if len(more) == len(value):
                return value, None
            value = more
        return value, float(near[0]) if len(near) else float(value[0])

    def largest(self, vibration: Vibration) -> list[int]:
        """Unsolved steps at which a sum is largest: each sum in each band, on each axis and of the length."""
        solved, steps = np.isin(vibration.value, list(self.solved)), set()
        unbalance, tabled = self.linear(vibration.value)
        linear = self.without_tabled(unbalance).join(tabled)
        for band in self.bands:
            within = vibration.noises[band], band
            known, estimated = (
                [np.nan_to_num(np.column_stack(of)) for of in zip(x.sums(*within), x.lengths(*within), strict=True)]
                for x in (vibration.lines, linear)
            )
            for sizes, estimates in zip(known, estimated, strict=True):
                for size, estimate in zip(sizes.T, estimates.T, strict=True):
                    most = size[solved].max(initial=0.0)
                    off = min(np.abs(size - estimate)[solved].max(initial=0.0), MOST_OFF * most)
                    if size.max() > most + off + EQUAL * (most + sizes[:, 3].max()):
                        steps.add(int(size.argmax()))
        return sorted(steps)

    def solve(self, values: Array) -> bool:
        """Solve the whole equations at values of the swept speed; False if that was ended before it was done."""
        missing = [float(x) for x in values if float(x) not in self.solved]
        for n, x in enumerate(missing):
            if self.cut or not self.go_on(len(self.solved), len(self.solved) + len(missing) - n):
                self.cut = True
                return False
            try:
                self.keep(x)
            except CheckError as error:
                self.solved[x] = str(error)
        return True

    def keep(self, x: float, near: Steady | None = None) -> None:
        """Find a motion at a value of the swept speed, the larger of two counts. Raises CheckError: there is none."""
        motion = steady(self.scene, self.plan.speeds(x), self.phases.tolist(), near)
        lines = spectrum(motion, self.chain)
        if near is not None and lines.unstable:
            raise CheckError(f"{self.scene.stand.name}: the motion that was followed is unstable")
        if x not in self.motions or _size(lines) > _size(self.solved[x]):
            self.motions[x], self.solved[x] = motion, lines

    def follow(self, value: Array) -> bool:
        """Solve at values, then follow motions from each to the next that has a smaller one, or, in small steps, none.

        False if that was ended before it was done.
        """
        if not self.solve(value):
            return False
        for way in (value, value[::-1]):
            for near, x in pairwise(way.tolist()):
                smaller = _size(self.solved[x]) < LARGEST * _size(self.solved[near])
                if not smaller or (near, x) in self.followed:
                    continue
                if not self.go_on(len(self.solved), len(self.solved) + 1):
                    self.cut = True
                    return False
                self.followed.add((near, x))
                at, part, least = near, 1.0, 1.0 / FOLLOWED if isinstance(self.solved[x], str) else 1.0
                while at != x and part * abs(x - at) >= least * abs(x - near):
                    to = x if part == 1.0 else at + part * (x - at)
                    try:
                        self.keep(to, self.motions[at])
                        at, part = to, 1.0
                    except CheckError:
                        part /= 2.0
        return True

    def result(self, value: Array, noisy: bool = True) -> Vibration:
        """What is known at values (S) of the swept speed."""
        whole = {i: self.solved[float(x)] for i, x in enumerate(value) if float(x) in self.solved}
        spectra = {i: spectrum for i, spectrum in whole.items() if not isinstance(spectrum, str)}
        problems = {i: why for i, why in whole.items() if isinstance(why, str)}
        unbalance, tabled = self.linear(value)
        lines = unbalance.with_whole(spectra)
        off = self.difference(unbalance, lines, list(spectra))
        lines = self.without_tabled(lines).join(tabled)
        lines.amplitude[list(problems)] = np.nan
        problems |= self.resonances(value, lines, problems)
        noises = self.noise(value, set(whole)) if noisy else np.zeros((len(self.bands), len(value), 3))
        vibration = Vibration(
            self.scene, self.plan, self.chain, value, self.phases, lines, dict(zip(self.bands, noises, strict=True)),
            spectra, problems, off,
        )  # fmt: skip
        return replace(vibration, problems=problems | self.inaccurate(vibration))

    def linear(self, value: Array) -> tuple[Lines, Lines]:
        """Lines of the linear equations at values (S) of the swept speed: first orders, those of makers' tables.

        Those of a value that was asked for before are kept.
        """
        new = np.setdiff1d(value, self.known[0])
        if len(new):
            speeds = self.plan.rows(new)
            omega, a = self.chain.first_orders(speeds, self.phases)
            names = tuple(LineName(name, 1.0) for name in self.plan.names)
            lines = Lines(names, omega / (2.0 * np.pi), a), self.chain.table_lines(speeds)
            joined = [b.below(a) for a, b in zip(self.known[1:], lines, strict=True)] if len(self.known[0]) else lines
            self.known = np.concatenate([self.known[0], new]), *joined
        order = np.argsort(self.known[0])
        steps = order[np.searchsorted(self.known[0], value, sorter=order)]
        return self.known[1].at(steps), self.known[2].at(steps)

    def difference(self, linear: Lines, lines: Lines, rows: list[int]) -> float:
        """Largest relative difference of the RMS, root of the sum of squares over the axes, at solved rows."""
        if not rows:
            return 0.0
        one, other = (np.linalg.norm(part.sums().rms, axis=1) for part in (linear, lines))
        least = max(SMALL * float(np.nanmax(other, initial=0.0)), STILL)
        known = [i for i in rows if other[i] > least and np.isfinite(one[i])]
        return max((float(abs(one[i] - other[i]) / other[i]) for i in known), default=0.0)

    def without_tabled(self, lines: Lines) -> Lines:
        """Lines without those that a maker's table replaces."""
        tables = self.chain.makers.harmonics
        kept = [name.wheel not in tables or name.order not in tables[name.wheel].order for name in lines.names]
        return lines.select(np.array(kept, dtype=bool))

    def noise(self, value: Array, rows: set[int]) -> Array:
        """Mean square (bands, S, 3) of noise at values of the swept speed: exact at some of them, linear between."""
        if not self.chain.makers.noise:
            return np.zeros((len(self.bands), len(value), 3))
        at = sorted({*rows, *np.linspace(0, len(value) - 1, NOISES).astype(int).tolist()})
        missing = [float(x) for x in value[at] if float(x) not in self.noises]
        if missing:
            levels = noise(self.chain, self.plan.rows(np.array(missing)), self.bands)
            self.noises |= dict(zip(missing, np.moveaxis(levels, 1, 0), strict=True))
        known = np.array([self.noises[float(x)] for x in value[at]])
        columns = known.reshape(len(at), -1).T
        return np.array([np.interp(np.arange(len(value)), at, column) for column in columns]).T.reshape(
            len(value), *known.shape[1:]
        ).swapaxes(0, 1)  # fmt: skip

    def resonances(self, value: Array, lines: Lines, besides: dict[int, str]) -> dict[int, str]:
        """Steps at which a line has no finite amplitude, and why."""
        result = {}
        for i in np.flatnonzero(~lines.is_finite).tolist():
            if i not in besides:
                at = np.flatnonzero(~np.isfinite(lines.amplitude[i]).all(axis=1))[0]
                hertz, speeds = float(lines.frequency[i, at]), self.plan.speeds(float(value[i]))
                mode = undamped_mode(self.chain.makers, self.chain.names, np.array(speeds), 2.0 * np.pi * hertz)
                what = f"{mode}: expected a damping above 0" if mode else "the stand itself: expected some damping"
                result[i] = f"line {lines.names[at].text} at {hertz:.6g} Hz is an undamped resonance of {what}"
        return result

    def inaccurate(self, vibration: Vibration) -> dict[int, str]:
        """Steps at which a solution leaves out too much, and how much."""
        problems, rows = dict[int, str](), list(vibration.whole)
        sums = vibration.lines.at(rows).sums(vibration.noises[None][rows])
        worst = dict(zip(rows, np.linalg.norm(sums.worst, axis=1), strict=True))
        for i, motion in vibration.whole.items():
            left = float(np.linalg.norm(motion.left_out))
            known = np.isfinite(left)
            share = (left / worst[i] if left else 0.0) if known else motion.residual
            if share > TOO_MUCH and np.isfinite(worst[i]):
                what = self.chain.seen.quantity if known else "acceleration"
                problems[i] = f"inaccurate: {motion.method} leaves out {share:.2g} of the {what}"
        return problems
