"""Items 3, 4: phi', phi'' are derivatives of phi, and a period ends where it began."""

from __future__ import annotations

import numpy as np

from mahovik.core.motion.programme import Fourier, Programme, Samples
from mahovik.proof.reference.array import Array
from mahovik.proof.verify.programme.finding import Finding, judged


def findings(programme: Programme, limit: float) -> list[Finding]:
    """Findings for a Fourier series, by differences of its values, or for a table, row by row."""
    if isinstance(programme.course, Fourier):
        return [_series(programme, limit), _period(programme, limit)]
    if not programme.periodic:
        return [samples_finding("table", programme.course, limit)]
    turn = 2 * np.pi * np.array(programme.winding, dtype=np.float64)
    errors = foretold(_wrapped(programme.course, programme.span, turn))
    joint = max(errors[0], errors[-1])
    inner = errors[1:-1]
    i = int(np.argmax(inner)) + 1 if len(inner) else 0
    words = f"row {i}, t = {programme.course.t[i]:.6g} s, against its neighbours"
    return [
        judged("table", float(errors[i]) if len(inner) else 0.0, limit, words),
        judged("periodicity", float(joint), limit, "last and first row, winding turns apart, against their neighbours"),
    ]


def samples_finding(name: str, samples: Samples, limit: float) -> Finding:
    """Inner rows of a table."""
    errors = foretold(samples)
    if not len(errors):
        return judged(name, 0.0, limit, "two rows, which have no neighbours")
    i = int(np.argmax(errors)) + 1
    words = f"row {i}, t = {samples.t[i]:.6g} s, against its neighbours"
    return judged(name, float(errors[i - 1]), limit, words)


def foretold(samples: Samples) -> Array:
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


def _wrapped(samples: Samples, period: float, turn: Array) -> Samples:
    """With the last row before the first and the first after the last: all rows of the table are inner rows."""

    def around(column: Array, shift: Array | float) -> Array:
        return np.concatenate([column[-1:] - shift, column, column[:1] + shift])

    return Samples(
        around(samples.t, period), around(samples.phi, turn), around(samples.phi_dot, 0.0),
        around(samples.phi_ddot, 0.0),
    )  # fmt: skip


def _series(programme: Programme, limit: float) -> Finding:
    """phi', phi'' against differences of phi, phi' over a thousandth of the shortest period in the series.

    Of phi'' less than a millionth of the speed a period is rounding, as in `foretold`.
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
    return judged("table", worst, limit, "Fourier series: derivatives against differences")


def _period(programme: Programme, limit: float) -> Finding:
    first, last = programme.at(np.zeros(1)), programme.at(np.array([programme.span]))
    turn = 2 * np.pi * np.array(programme.winding)
    apart = max(
        float(np.abs(last.phi - first.phi - turn).max(initial=0.0)),
        float(np.abs(last.phi_dot - first.phi_dot).max(initial=0.0)) * programme.span,
    )
    return judged("periodicity", apart, limit, "phi less its winding, and phi', a period apart")
