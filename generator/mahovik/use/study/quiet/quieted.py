"""Speeds and phases that are quiet, jitter before and after by first order and by full simulation."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.core.toolchain.compiler import find_compiler
from mahovik.errors import StateError
from mahovik.use.study.linear import linear_model
from mahovik.use.study.linear.modes import modes
from mahovik.use.study.quiet.amplitude import Amplitudes
from mahovik.use.study.quiet.lines import Line, apart, best_phases, inside, lines, mean_square
from mahovik.use.study.quiet.planes import refused
from mahovik.use.study.quiet.search import Search
from mahovik.use.study.quiet.simulated import Sampling, beginning, expected, simulated
from mahovik.use.study.quiet.spectrum import band_rms, line_amplitude
from mahovik.use.study.quiet.wheels import Wheels
from mahovik.use.study.quiet.wish import MEASURES, Wish, check
from mahovik.use.study.rest import rest

Array = NDArray[np.float64]

AGREE = 0.01
"""Of the RMS before: difference of simulated and expected RMS in the band above which first order falls short."""


@dataclass(frozen=True, eq=False)
class Jitter:
    """At some speeds and phases, in the measure's unit; what was not simulated is None.

    free       RMS in the band when no phase is held, the mean over phases
    rms        RMS in the band with these phases, in the long run
    expected   the same of the samples of a simulation, by first order
    simulated  by the simulation itself
    lines      in and out of the band; heard: their simulated amplitudes
    start      state at t = 0
    """

    speeds: Array
    phases: Array
    free: float
    rms: float
    lines: tuple[Line, ...]
    start: State
    expected: float | None = None
    simulated: float | None = None
    heard: tuple[float, ...] | None = None


@dataclass(frozen=True, eq=False)
class Quieted:
    """Before and after. `hold` (rad): errors of the phases, each by itself, rms, by which the RMS doubles."""

    stand: Stand
    wish: Wish
    wheels: Wheels
    before: Jitter
    after: Jitter
    hold: float | None
    natural: tuple[float, ...]
    looked_at: int
    cut: bool
    interrupted: bool

    @property
    def reduction(self) -> float:
        """How many times lower: RMS before, phases not held, to RMS after and what the simulation has beyond expected.

        inf: silence after; 1: silence before, there is nothing to lower. Lines that beat longer than is simulated are
        loud or quiet there by chance: what first order says of all time is never lowered by the simulation.
        """
        if self.before.free == 0.0:
            return 1.0
        beyond = 0.0
        if self.after.simulated is not None and self.after.expected is not None:
            beyond = max(0.0, self.after.simulated**2 - self.after.expected**2)
        after = math.sqrt(self.after.rms**2 + beyond)
        return self.before.free / after if after > 0.0 else math.inf

    @property
    def broken(self) -> tuple[str, ...]:
        """Which options the speeds before break."""
        return tuple(sorted(f"--{name}" for name in refused(self.before.speeds, self.wheels, self.wish)))

    @property
    def unit(self) -> str:
        """Of the measure."""
        return MEASURES[self.wish.measure].unit

    @property
    def momentum_error(self) -> float:
        """N m s."""
        return float(np.linalg.norm(self.wheels.axes @ self.after.speeds - self.wheels.momentum))

    @property
    def agrees(self) -> bool:
        """Whether simulation and first order give the same RMS in the band, before and after; True: not simulated."""
        pairs = [(each.simulated, each.expected) for each in (self.before, self.after)]
        allowed = AGREE * max(self.before.free, 1e-300)
        return all(one is None or other is None or abs(one - other) <= allowed for one, other in pairs)


def quiet(
    stand: Stand,
    wish: Wish,
    seconds: float | None = None,
    backend: str | None = "c",
    progress: Callable[[str], None] | None = None,
) -> Quieted:
    """Finds speeds and phases. `backend`: of the check, c or scipy; None: no simulation.

    Raises UsageError for bad input; ToolchainError without a compiler for c, before anything is searched; CheckError
    where nothing is allowed, or where there is no pose to be in.
    """
    check(stand, wish)
    if backend == "c":
        find_compiler()  # before the search, not after it
    wheels = Wheels.of(stand, wish)
    tell = progress or (lambda _: None)
    pose = rest(stand).state
    amplitudes = Amplitudes.of(stand, wish, pose)
    tell("searching")
    natural = _natural(stand, pose)
    if wish.modes:
        around = tuple((f * (1.0 - wish.margin), f * (1.0 + wish.margin)) for f in natural)
        wish = replace(wish, avoid=(*wish.avoid, *around))
    outcome = Search(wheels, amplitudes, wish, seconds, tell).run()
    speeds = outcome.best.speeds
    rng = np.random.default_rng([wish.seed, 1])
    phases, _ = best_phases(speeds, amplitudes.at(speeds), wish.guarded, rng)
    phases = np.mod(phases, 2 * math.pi)
    unheld = np.random.default_rng([wish.seed, 2]).uniform(0.0, 2 * math.pi, len(speeds))
    interrupted = outcome.interrupted

    def both(by: str | None) -> list[Jitter]:
        found = []
        for name, (now, angles) in {"before": (wheels.start, unheld), "after": (speeds, phases)}.items():
            tell(f"simulating {name}")
            found.append(_jitter(stand, wish, amplitudes, pose, now, angles, by))
        return found

    try:
        before, after = both(None if interrupted else backend)
    except KeyboardInterrupt:
        before, after = both(None)
        interrupted = True
    hold = _hold(after, wish)
    return Quieted(stand, wish, wheels, before, after, hold, natural, outcome.looked_at, outcome.cut, interrupted)


def _natural(stand: Stand, pose: State) -> tuple[float, ...]:
    """Frequencies (Hz) of the carrier's oscillations, flywheels at rest and locked."""
    still = replace(pose, phi_dot=(0.0,) * len(stand.flywheels))
    found = modes(linear_model(stand, still, [], locked=True)).modes
    return tuple(mode.frequency for mode in found if mode.kind == "oscillation")


def _jitter(
    stand: Stand, wish: Wish, amplitudes: Amplitudes, pose: State, speeds: Array, phases: Array, backend: str | None
) -> Jitter:
    """By first order, and by simulation."""
    a = amplitudes.at(speeds)
    found = tuple(lines(speeds, phases, a))
    start = beginning(pose, amplitudes, stand, speeds, phases)
    free, rms = math.sqrt(apart(speeds, a, wish.band)), math.sqrt(mean_square(list(found), wish.band))
    if backend is None:
        return Jitter(speeds, phases, free, rms, found, start)
    sampling = Sampling.of(wish, speeds)
    integrals = MEASURES[wish.measure].integrals
    x = simulated(stand, wish, start, sampling, backend)
    if not np.all(np.isfinite(x)):
        raise StateError(f"{stand.name}: the simulation leaves what can be computed")
    ours = expected(speeds, phases, a, integrals, sampling)
    heard = tuple(line_amplitude(x, sampling.every, each.frequency, integrals) for each in found)
    return Jitter(
        speeds,
        phases,
        free,
        rms,
        found,
        start,
        band_rms(ours, sampling.every, wish.band, integrals),
        band_rms(x, sampling.every, wish.band, integrals),
        heard,
    )


def _hold(after: Jitter, wish: Wish) -> float | None:
    """Errors e of all phases, independent and normal: the mean square is P + (1 - exp(-e^2)) (apart - P) a line."""
    held = [each for each in after.lines if inside(each.frequency, wish.band) and len(each.flywheels) > 1]
    lost = sum(each.apart - each.mean_square for each in held)
    now = after.rms**2
    if not held or lost <= 0.0 or 3.0 * now >= lost:
        return None
    return math.sqrt(-math.log1p(-3.0 * now / lost))
