"""Quiet speeds and phases, with the jitter before and after by first order and by the full equations.

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
from mahovik.errors import CheckError
from mahovik.proof.verify.states import state_object
from mahovik.use.numeric import Array, uniform_stream
from mahovik.use.study.linear import linear_model
from mahovik.use.study.linear.modes import modes
from mahovik.use.vibration.balance import balance
from mahovik.use.vibration.band import in_band
from mahovik.use.vibration.exact import exact_lines
from mahovik.use.vibration.lines import SAME, coherent
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

AGREE = 0.01
"""Part of the RMS before: a larger difference from the full equations in the band means first order fails."""


@dataclass(frozen=True, eq=False)
class Jitter:
    """Jitter at some speeds and phases, in the measure's unit.

    free       RMS in the band if no phase is held, the mean over phases
    rms        RMS in the band with these phases, by first order
    full       RMS by the full equations, with lines at all orders; None: not found, for the reason `unchecked`
    lines      in and outside the band; full_lines: their amplitudes by the full equations
    start      state at t = 0
    """

    speeds: Array
    phases: Array
    free: float
    rms: float
    lines: tuple[Line, ...]
    start: State
    full: float | None = None
    full_lines: tuple[float, ...] | None = None
    unchecked: str = ""


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
        """Factor of reduction: RMS before, phases not held, over the larger RMS after, by first order or in full.

        inf: silence after; 1: silence before, so nothing to reduce.
        """
        if self.before.free == 0.0:
            return 1.0
        after = max(self.after.rms, self.after.full or 0.0)
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
        """Whether the full equations and first order agree on the RMS in the band, before and after, where known."""
        allowed = AGREE * max(self.before.free, 1e-300)
        return all(each.full is None or abs(each.full - each.rms) <= allowed for each in (self.before, self.after))


def quiet(
    stand: Stand,
    options: QuietOptions,
    seconds: float | None = None,
    progress: Callable[[str], None] | None = None,
) -> QuietResult:
    """Find quiet speeds and phases.

    Raises StandError for a stream by depth, UsageError for bad input; CheckError if no speeds are allowed, or there is
    no equilibrium.
    """
    uniform_stream(stand)
    check_options(stand, options)
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

    def jitters(full: bool) -> list[Jitter]:
        tell("solving the full equations" if full else "first order")
        return [_jitter(amplitudes, options, *each, full) for each in ((wheels.start, unheld), (speeds, phases))]

    try:
        before, after = jitters(not interrupted)
    except KeyboardInterrupt:
        before, after = jitters(False)
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


def _jitter(amplitudes: Amplitudes, options: QuietOptions, speeds: Array, phases: Array, full: bool) -> Jitter:
    """Jitter by first order, and by the full equations."""
    a = amplitudes.at(speeds)
    first = tuple(lines(speeds, phases, a))
    free = math.sqrt(uncontrolled_mean_square(speeds, a, options.band))
    rms = math.sqrt(mean_square(list(first), options.band))
    jitter = Jitter(speeds, phases, free, rms, first, amplitudes.start(speeds, phases))
    if not full:
        return jitter
    try:
        motion = balance(amplitudes.scene, speeds.tolist(), phases.tolist())
    except CheckError as error:
        return replace(jitter, unchecked=str(error))
    every = exact_lines(motion, amplitudes.chain.seen, phases)
    frequency, amplitude = coherent(every.frequency[0], every.amplitude[0])
    sizes = np.linalg.norm(amplitude @ np.array(options.axes).T, axis=1)
    total = math.sqrt(float((sizes[in_band(frequency, options.band)] ** 2).sum()) / 2.0)
    at = [np.abs(frequency - line.frequency) <= SAME * line.frequency for line in first]
    return replace(jitter, full=total, full_lines=tuple(float(sizes[each].sum()) for each in at))


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
    in_full = jitter.full_lines or (None,) * len(jitter.lines)
    lines = [
        {
            "frequency": line.frequency,
            "flywheels": [found.wheels.names[s] for s in line.flywheels],
            "in_band": bool(in_band(line.frequency, found.options.band)),
            "amplitude": math.sqrt(2.0 * line.mean_square),
            "amplitude_of_phases_not_held": math.sqrt(2.0 * line.apart),
            "full": full,
        }
        for line, full in zip(jitter.lines, in_full, strict=True)
    ]
    return {
        "speeds": jitter.speeds.tolist(),
        "phases": jitter.phases.tolist(),
        "rms_of_phases_not_held": jitter.free,
        "rms": jitter.rms,
        "full": jitter.full,
        "lines": lines,
        "start": state_object(jitter.start),
    }
