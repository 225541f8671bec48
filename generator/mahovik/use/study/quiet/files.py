"""Output files: a regime that `simulate` reads, an initial state, and everything as JSON."""

from __future__ import annotations

import math
from typing import Any

from mahovik.proof.verify.evaluate import state_object
from mahovik.use.study.quiet.lines import in_band
from mahovik.use.study.quiet.result import Jitter, QuietResult


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


def result(found: QuietResult) -> dict[str, Any]:
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
        "before": _jitter(found, found.before),
        "after": _jitter(found, found.after),
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


def _jitter(found: QuietResult, jitter: Jitter) -> dict[str, Any]:
    heard = jitter.heard or (None,) * len(jitter.lines)
    lines = [
        {
            "frequency": line.frequency,
            "flywheels": [found.wheels.names[s] for s in line.flywheels],
            "in_band": in_band(line.frequency, found.options.band),
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
