"""Items 3 to 6: phi', phi'' are derivatives of phi, a period ends where it began; bounds, bias, windings and start."""

from __future__ import annotations

import numpy as np

from mahovik.core.motion.programme import Angles, Fourier, Programme, Samples
from mahovik.core.motion.required import Bounds, RequiredMotion
from mahovik.core.stand.coordinates import FREE
from mahovik.proof.reference.array import Array
from mahovik.proof.verify.programme.finding import Finding, check_limit, largest


def table_findings(programme: Programme, limit: float) -> list[Finding]:
    """Findings for a Fourier series, by differences of its values, or for a table, row by row."""
    if isinstance(programme.course, Fourier):
        return [_series(programme, limit), _period(programme, limit)]
    if not programme.periodic:
        return [samples_finding("table", programme.course, limit)]
    turn = 2 * np.pi * np.array(programme.winding, dtype=np.float64)
    errors = neighbour_errors(_wrap(programme.course, programme.span, turn))
    joint = max(errors[0], errors[-1])
    inner = errors[1:-1]
    i = int(np.argmax(inner)) + 1 if len(inner) else 0
    words = f"row {i}, t = {programme.course.t[i]:.6g} s, against its neighbours"
    return [
        check_limit("table", float(errors[i]) if len(inner) else 0.0, limit, words),
        check_limit(
            "periodicity", float(joint), limit, "last and first row, winding turns apart, against their neighbours"
        ),
    ]


def samples_finding(name: str, samples: Samples, limit: float) -> Finding:
    """Finding on the inner rows of a table."""
    errors = neighbour_errors(samples)
    if not len(errors):
        return check_limit(name, 0.0, limit, "two rows, which have no neighbours")
    i = int(np.argmax(errors)) + 1
    words = f"row {i}, t = {samples.t[i]:.6g} s, against its neighbours"
    return check_limit(name, float(errors[i - 1]), limit, words)


def neighbour_errors(samples: Samples) -> Array:
    """For each inner row what the quintic between its two neighbours misses phi, phi', phi'' by (M - 2).

    phi' and phi'' as shares of their peaks, phi of the way that the peak speed goes in the step.
    """
    speed = float(np.abs(samples.phi_dot).max()) or 1.0
    acceleration = max(float(np.abs(samples.phi_ddot).max()), 1e-6 * speed / float(np.ptp(samples.t)))
    errors = np.zeros(max(len(samples.t) - 2, 0))
    for first in (1, 2):
        skipped = np.arange(first, len(samples.t) - 1, 2)
        if not len(skipped):
            continue
        kept = np.setdiff1d(np.arange(len(samples.t)), skipped)
        coarse = Samples(samples.t[kept], samples.phi[kept], samples.phi_dot[kept], samples.phi_ddot[kept])
        phi, phi_dot, phi_ddot = coarse.at(samples.t[skipped])
        step = np.diff(samples.t)[skipped - 1][:, None]
        shares = [
            np.abs(phi - samples.phi[skipped]) / (speed * step),
            np.abs(phi_dot - samples.phi_dot[skipped]) / speed,
            np.abs(phi_ddot - samples.phi_ddot[skipped]) / acceleration,
        ]
        errors[skipped - 1] = np.max(shares, axis=(0, 2))
    return errors


def _wrap(samples: Samples, period: float, turn: Array) -> Samples:
    """Samples with the last row before the first and the first after the last, so that all rows are inner rows."""

    def extend(column: Array, shift: Array | float) -> Array:
        return np.concatenate([column[-1:] - shift, column, column[:1] + shift])

    return Samples(
        extend(samples.t, period), extend(samples.phi, turn), extend(samples.phi_dot, 0.0),
        extend(samples.phi_ddot, 0.0),
    )  # fmt: skip


def _series(programme: Programme, limit: float) -> Finding:
    """phi', phi'' against differences of phi, phi' over a thousandth of the shortest period in the series.

    Of phi'' less than a millionth of the speed a period is rounding, as in `neighbour_errors`.
    """
    H = max(len(programme.course.cos) if isinstance(programme.course, Fourier) else 1, 1)
    t = programme.span * (np.arange(8 * H) + 0.5) / (8 * H)
    h = programme.span / (1e3 * max([H, *(abs(n) for n in programme.winding)]))
    before, at, after = programme.at(t - h), programme.at(t), programme.at(t + h)
    worst = 0.0
    floor = 1e-6 * float(np.abs(at.phi_dot).max()) / programme.span
    for lower, upper, derivative, least in (
        (before.phi, after.phi, at.phi_dot, 0.0),
        (before.phi_dot, after.phi_dot, at.phi_ddot, floor),
    ):
        most = max(float(np.abs(derivative).max()), least)
        if most > 0.0:
            worst = max(worst, float(np.abs((upper - lower) / (2 * h) - derivative).max()) / most)
    return check_limit("table", worst, limit, "Fourier series: derivatives against differences")


def _period(programme: Programme, limit: float) -> Finding:
    first, last = programme.at(np.zeros(1)), programme.at(np.array([programme.span]))
    turn = 2 * np.pi * np.array(programme.winding)
    apart = max(
        largest(last.phi - first.phi - turn),
        largest(last.phi_dot - first.phi_dot) * programme.span,
    )
    return check_limit("periodicity", apart, limit, "phi less its winding, and phi', a period apart")


EXCEEDED = 1 + 1e-9
"""Value over its bound that counts as exceeded: rounding of the program that kept it does not."""

UNITS = {"speed": "rad/s", "acceleration": "rad/s2", "torque": "N m", "angle": "rad"}


def bound_findings(
    bounds: Bounds, names: tuple[str, ...], angles: Angles, tau: Array, rocking: Array, prefix: str = ""
) -> list[Finding]:
    """Findings, one for each given bound: largest value over its bound. `rocking` (M, N): phi less winding and mean."""
    found = []
    columns = {"speed": angles.phi_dot, "acceleration": angles.phi_ddot, "torque": tau, "angle": rocking}
    for key, values in columns.items():
        limit = getattr(bounds, key)
        if limit is None or not names:
            continue
        peaks = np.abs(values).max(axis=0)
        shares = peaks / np.array(limit)
        s = int(np.argmax(shares))
        words = f"{names[s]}: {peaks[s]:.6g} of {limit[s]:.6g} {UNITS[key]}"
        found.append(check_limit(f"{prefix}bound {key}", float(shares[s]), EXCEEDED, words))
    return found


def slowest_finding(bounds: Bounds, names: tuple[str, ...], phi_dot: Array) -> list[Finding]:
    """The bound `speed_min` over the least speed; a speed that changes sign is 0."""
    if bounds.speed_min is None or not names:
        return []
    wanted = np.array(bounds.speed_min)
    turns_back = phi_dot.min(axis=0) * phi_dot.max(axis=0) < 0.0
    least = np.where(turns_back, 0.0, np.abs(phi_dot).min(axis=0))
    with np.errstate(divide="ignore", invalid="ignore"):
        shares = np.where(wanted > 0.0, wanted / least, 0.0)
    s = int(np.argmax(shares))
    words = f"{names[s]}: down to {least[s]:.6g}, at least {wanted[s]:.6g} rad/s"
    return [check_limit("bound speed_min", float(shares[s]), EXCEEDED, words)]


def rocking_of(programme: Programme, t: Array, phi: Array) -> Array:
    """Angles phi less their winding and mean (M, N; rad)."""
    turn = 2 * np.pi * np.array(programme.winding, dtype=np.float64)
    left = phi - (t / programme.span)[:, None] * turn
    return np.asarray(left - left.mean(axis=0))


def winding_finding(motion: RequiredMotion, programme: Programme) -> list[Finding]:
    """Flywheels whose winding is not as the motion wants it."""
    wanted, found = motion.winding, programme.winding
    if not motion.periodic or wanted == "any":
        return []
    if wanted == "rock":
        other = sum(n != 0 for n in found)
    elif wanted == "spin":
        other = sum(n == 0 for n in found)
    else:
        other = sum(a != b for a, b in zip(wanted, found, strict=True))
    asked = wanted if isinstance(wanted, str) else list(wanted)
    return [check_limit("winding", other, 0, f"{list(found)}, wanted {asked}")]


def start_findings(motion: RequiredMotion, programme: Programme, limit: float) -> list[Finding]:
    """Findings on the distance from `start` of a finite motion: rad, and share of the peak speed."""
    angles, found = programme.at(np.zeros(1)), []
    if motion.bounds.start_phi is not None:
        apart = largest(angles.phi[0] - np.array(motion.bounds.start_phi))
        found.append(check_limit("start phi", apart, limit, "rad"))
    if motion.bounds.start_phi_dot is not None:
        wanted = np.array(motion.bounds.start_phi_dot)
        peak = largest(programme.at(np.linspace(0.0, programme.span, 999)).phi_dot)
        apart = largest(angles.phi_dot[0] - wanted)
        share = apart / max(peak, largest(wanted), 1e-12)
        found.append(check_limit("start phi_dot", share, limit, "share of the peak speed"))
    return found


def bias_findings(motion: RequiredMotion, programme: Programme) -> list[Finding]:
    """Findings on the bias: zero where the mean is not free; within its bound."""
    names = programme.coordinates or FREE
    held = ~np.array(motion.free_mean)
    worst = int(np.argmax(np.abs(programme.bias) * held))
    value = float(abs(programme.bias[worst])) if held[worst] else 0.0
    words = f"of {names[worst]}, whose mean is not free" if value else "zero where the mean is not free"
    found = [check_limit("bias", value, 0.0, words)]
    if motion.bounds.bias is not None:
        limit = np.array(motion.bounds.bias)
        with np.errstate(divide="ignore", invalid="ignore"):
            shares = np.where(programme.bias != 0.0, np.abs(programme.bias) / limit, 0.0)
        i = int(np.argmax(shares))
        words = f"{names[i]}: {programme.bias[i]:.6g} of {limit[i]:.6g}"
        found.append(check_limit("bound bias", float(shares[i]), EXCEEDED, words))
    return found
