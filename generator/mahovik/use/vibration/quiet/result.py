"""Quiet speeds and phases, with the jitter before and after by first order and by full simulation.

Output files: a regime that `simulate` reads, an initial state, and everything as JSON.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.core.toolchain.compiler import find_compiler
from mahovik.errors import StateError
from mahovik.proof.verify.states import state_object
from mahovik.use.plan.array import Array
from mahovik.use.plan.stream import uniform_stream
from mahovik.use.study.linear import linear_model
from mahovik.use.study.linear.modes import modes
from mahovik.use.vibration.band import in_band
from mahovik.use.vibration.quiet.lines import (
    Amplitudes,
    Line,
    best_phases,
    lines,
    mean_square,
    uncontrolled_mean_square,
)
from mahovik.use.vibration.quiet.options import MEASURES, QuietOptions, Wheels, check_options
from mahovik.use.vibration.quiet.search import Search, broken_limits
from mahovik.use.vibration.quiet.simulation import (
    Sampling,
    band_rms,
    expected_samples,
    line_amplitude,
    simulate_point,
)

AGREE = 0.01
"""Part of the RMS before: a larger difference of simulated and expected RMS in the band means first order fails."""


@dataclass(frozen=True, eq=False)
class Jitter:
    """Jitter at some speeds and phases, in the measure's unit; values that were not simulated are None.

    free       RMS in the band if no phase is held, the mean over phases
    rms        RMS in the band with these phases, over all time
    expected   RMS of the simulated samples, by first order
    simulated  RMS by the simulation
    lines      in and outside the band; heard: their simulated amplitudes
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
class QuietResult:
    """Jitter before and after. `hold` (rad): rms error of independent phases that doubles the RMS."""

    stand: Stand
    options: QuietOptions
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
        """Factor of reduction: RMS before, phases not held, over RMS after plus the simulation's excess over expected.

        inf: silence after; 1: silence before, so nothing to reduce. Lines whose beat is longer than the simulated time
        are loud or quiet by chance: the simulation never lowers the first-order value for all time.
        """
        if self.before.free == 0.0:
            return 1.0
        beyond = 0.0
        if self.after.simulated is not None and self.after.expected is not None:
            beyond = max(0.0, self.after.simulated**2 - self.after.expected**2)
        after = math.sqrt(self.after.rms**2 + beyond)
        return self.before.free / after if after > 0.0 else math.inf

    @property
    def broken_options(self) -> tuple[str, ...]:
        """Options that the speeds before break."""
        return tuple(sorted(f"--{name}" for name in broken_limits(self.before.speeds, self.wheels, self.options)))

    @property
    def unit(self) -> str:
        """Unit of the measure."""
        return MEASURES[self.options.measure].unit

    @property
    def momentum_error(self) -> float:
        """Error of the momentum, N m s."""
        return float(np.linalg.norm(self.wheels.axes @ self.after.speeds - self.wheels.momentum))

    @property
    def agrees(self) -> bool:
        """Whether simulation and first order agree on the RMS in the band, before and after; True if not simulated."""
        pairs = [(each.simulated, each.expected) for each in (self.before, self.after)]
        allowed = AGREE * max(self.before.free, 1e-300)
        return all(one is None or other is None or abs(one - other) <= allowed for one, other in pairs)


def quiet(
    stand: Stand,
    options: QuietOptions,
    seconds: float | None = None,
    backend: str | None = "c",
    progress: Callable[[str], None] | None = None,
) -> QuietResult:
    """Find quiet speeds and phases. `backend` of the check: c or scipy; None: no simulation.

    Raises StandError for a stream by depth, UsageError for bad input; ToolchainError if c lacks a compiler, before the
    search; CheckError if no speeds are allowed, or there is no equilibrium.
    """
    uniform_stream(stand)
    check_options(stand, options)
    if backend == "c":
        find_compiler()  # before the search, not after it
    wheels = Wheels.of(stand, options)
    tell = progress or (lambda _: None)
    amplitudes = Amplitudes.of(stand, options)
    tell("searching")
    natural = _carrier_frequencies(stand, amplitudes.scene.rest)
    if options.modes:
        around = tuple((f * (1.0 - options.margin), f * (1.0 + options.margin)) for f in natural)
        options = replace(options, avoid=(*options.avoid, *around))
    outcome = Search(wheels, amplitudes, options, seconds, tell).run()
    speeds = outcome.best.speeds
    rng = np.random.default_rng([options.seed, 1])
    phases, _ = best_phases(speeds, amplitudes.at(speeds), options.guarded_band, rng)
    phases = np.mod(phases, 2 * math.pi)
    unheld = np.random.default_rng([options.seed, 2]).uniform(0.0, 2 * math.pi, len(speeds))
    interrupted = outcome.interrupted

    def jitters(by: str | None) -> list[Jitter]:
        found = []
        for name, (now, angles) in {"before": (wheels.start, unheld), "after": (speeds, phases)}.items():
            tell(f"simulating {name}")
            found.append(_jitter(stand, options, amplitudes, now, angles, by))
        return found

    try:
        before, after = jitters(None if interrupted else backend)
    except KeyboardInterrupt:
        before, after = jitters(None)
        interrupted = True
    hold = _phase_tolerance(after, options)
    return QuietResult(
        stand, options, wheels, before, after, hold, natural, outcome.looked_at, outcome.cut, interrupted
    )


def _carrier_frequencies(stand: Stand, pose: State) -> tuple[float, ...]:
    """Frequencies (Hz) of the carrier's oscillations, with flywheels locked at rest."""
    if stand.hold is not None and not stand.hold.freedoms:
        return ()
    still = replace(pose, phi_dot=(0.0,) * len(stand.flywheels))
    found = modes(linear_model(stand, still, [], locked=True)).modes
    return tuple(mode.frequency for mode in found if mode.kind == "oscillation")


def _jitter(
    stand: Stand,
    options: QuietOptions,
    amplitudes: Amplitudes,
    speeds: Array,
    phases: Array,
    backend: str | None,
) -> Jitter:
    """Jitter by first order, and by simulation."""
    a = amplitudes.at(speeds)
    found = tuple(lines(speeds, phases, a))
    start = amplitudes.start(speeds, phases)
    free, rms = (
        math.sqrt(uncontrolled_mean_square(speeds, a, options.band)),
        math.sqrt(mean_square(list(found), options.band)),
    )
    if backend is None:
        return Jitter(speeds, phases, free, rms, found, start)
    sampling = Sampling.of(options, speeds)
    integrals = MEASURES[options.measure].integrals
    x = simulate_point(stand, options, start, sampling, backend)
    if not np.all(np.isfinite(x)):
        raise StateError(f"{stand.name}: the simulation leaves the computable range")
    ours = expected_samples(speeds, phases, a, integrals, sampling)
    heard = tuple(line_amplitude(x, sampling.every, each.frequency, integrals) for each in found)
    return Jitter(
        speeds,
        phases,
        free,
        rms,
        found,
        start,
        band_rms(ours, sampling.every, options.band, integrals),
        band_rms(x, sampling.every, options.band, integrals),
        heard,
    )


def _phase_tolerance(after: Jitter, options: QuietOptions) -> float | None:
    """Errors e of all phases, independent and normal: the mean square of a line is P + (1 - exp(-e^2)) (apart - P)."""
    held = [each for each in after.lines if in_band(each.frequency, options.band) and len(each.flywheels) > 1]
    lost = sum(each.apart - each.mean_square for each in held)
    now = after.rms**2
    if not held or lost <= 0.0 or 3.0 * now >= lost:
        return None
    return math.sqrt(-math.log1p(-3.0 * now / lost))


def regime_text(found: QuietResult) -> str:
    """The regime as TOML: constant speeds, and phases at t = 0."""
    text = [
        f"# {found.stand.name}: quiet at {found.options.point}, "
        f"{found.options.band[0]:g} to {found.options.band[1]:g} Hz.",
        "# Phases are those at t = 0; flywheels of one speed must hold them.",
        "schema = 1",
    ]
    driven = zip(found.wheels.names, found.after.speeds.tolist(), found.after.phases.tolist(), strict=True)
    for name, speed, phase in driven:
        text += ["", f"[flywheel.{name}]", f"speed = {speed + 0.0!r}", f"phase = {phase + 0.0!r}"]
    return "\n".join(text) + "\n"


def as_object(found: QuietResult) -> dict[str, Any]:
    """Everything, in SI and Hz; strict JSON: an infinite reduction (silence) is null."""
    options = found.options
    reduction = found.reduction
    return {
        "name": found.stand.name,
        "point": options.point,
        "measure": options.measure,
        "unit": found.unit,
        "axes": [list(axis) for axis in options.axes],
        "band": list(options.band),
        "momentum": found.wheels.momentum.tolist(),
        "momentum_error": found.momentum_error,
        "flywheels": list(found.wheels.names),
        "before": _jitter_object(found, found.before),
        "after": _jitter_object(found, found.after),
        "change": (found.after.speeds - found.before.speeds).tolist(),
        "reduction": reduction if math.isfinite(reduction) else None,
        "phase_error_that_doubles": found.hold,
        "avoided": [list(each) for each in options.avoid],
        "natural_frequencies": list(found.natural),
        "agrees": found.agrees,
        "looked_at": found.looked_at,
        "cut_by_time": found.cut,
        "interrupted": found.interrupted,
    }


def _jitter_object(found: QuietResult, jitter: Jitter) -> dict[str, Any]:
    heard = jitter.heard or (None,) * len(jitter.lines)
    lines = [
        {
            "frequency": line.frequency,
            "flywheels": [found.wheels.names[s] for s in line.flywheels],
            "in_band": bool(in_band(line.frequency, found.options.band)),
            "amplitude": math.sqrt(2.0 * line.mean_square),
            "amplitude_of_phases_not_held": math.sqrt(2.0 * line.apart),
            "simulated": simulated,
        }
        for line, simulated in zip(jitter.lines, heard, strict=True)
    ]
    return {
        "speeds": jitter.speeds.tolist(),
        "phases": jitter.phases.tolist(),
        "rms_of_phases_not_held": jitter.free,
        "rms": jitter.rms,
        "expected": jitter.expected,
        "simulated": jitter.simulated,
        "lines": lines,
        "start": state_object(jitter.start),
    }
