"""What a programme is judged by without its mechanics: whose it is, its table, its bounds; limits of all items."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from mahovik.core.motion.programme import Angles, Fourier, Programme, Samples
from mahovik.core.motion.required import Bounds, RequiredMotion
from mahovik.core.stand.coordinates import FREE, coordinates_of
from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand
from mahovik.errors import above_zero
from mahovik.proof.reference.array import Array
from mahovik.proof.verify.check import Check


def check(name: str, value: float, limit: float, words: str = "") -> Check:
    """An item of a programme: `value` against `limit`, of the same unit, mostly a share."""
    made = Check("", name, limit)
    made.note(value, words=words)
    return made


def warns(item: Check) -> bool:
    """Whether an item has passed with a value above its limit."""
    return not item.failed and not item.value <= item.limit


def as_item(item: Check) -> dict[str, Any]:
    """An item for JSON; a value that is not finite is null."""
    value = item.value if math.isfinite(item.value) else None
    return {
        "name": item.quantity,
        "value": value,
        "limit": item.limit,
        "passed": not item.failed,
        "words": item.words,
    }


def largest(values: Array) -> float:
    """Largest magnitude; 0 if there are no values."""
    return float(np.abs(values).max(initial=0.0))


@dataclass(frozen=True)
class Tolerance:
    """residual, error   of the equations and of the carrier's motion by simulation, shares
    runup           of the carrier's state at the end of a run-up or run-down, share of the amplitude
    table           of phi', phi'' in a table, share of their peaks: each row against its prediction by its neighbours
    joint           of two courses that meet, share of peaks; rad for phi
    multiplier      largest Floquet multiplier without a warning
    """

    residual: float
    error: float
    runup: float
    table: float = 0.03
    joint: float = 1e-6
    multiplier: float = 1.001


SMOOTH, KINKED, RUNUP = 1e-6, 1e-5, 1e-5
"""Tolerances. A stand with V|V| has forces of class C1 only, and over a period a mean that nothing may balance."""

DRIFT = 20
"""(2 pi)^2 / 2: amplitudes that a constant residual, of one amplitude's share, moves a floating carrier in a period."""


def tolerance_for(stand: Stand, given: float | None) -> Tolerance:
    """Limits for a stand; `given` replaces that of the residual, and the others follow from it."""
    if given is not None:
        above_zero("tolerance", given)
    nonlinear = any(law.nonlinear for body in stand.bodies for law in body.laws)
    if given is None and not nonlinear:
        return Tolerance(SMOOTH, SMOOTH, RUNUP)
    share = KINKED if given is None else given
    return Tolerance(share, DRIFT * share, max(DRIFT * share, RUNUP))


def stand_check(stand: Stand, programme: Programme) -> Check:
    """How many of name, structure, physics, flywheels and coordinates are of another stand."""
    now = identities(stand)
    pairs = {
        "name": (programme.stand, stand.name),
        "structure": (programme.structure, now.structure),
        "physics": (programme.physics, now.physics),
        "flywheels": (", ".join(programme.flywheels), ", ".join(s.name for s in stand.flywheels)),
        "coordinates": (", ".join(programme.coordinates or FREE), ", ".join(coordinates_of(stand).names)),
    }
    other = [f"{key} is {theirs}, of the stand {ours}" for key, (theirs, ours) in pairs.items() if theirs != ours]
    return _owner("stand", other, f"{now.structure} {now.physics}")


def motion_check(motion: RequiredMotion, programme: Programme) -> Check:
    """How many of name, kind, period (duration) and unbalance are of another motion."""
    kind = {True: "periodic", False: "finite"}
    other = []
    if programme.motion != motion.name:
        other.append(f"name is {programme.motion}, of the motion {motion.name}")
    if programme.periodic != motion.periodic:
        other.append(f"it is {kind[programme.periodic]}, the motion {kind[motion.periodic]}")
    elif abs(programme.span - motion.span) > 1e-12 * motion.span:
        word = "period" if motion.periodic else "duration"
        other.append(f"{word} is {programme.span:.12g} s, of the motion {motion.span:.12g} s")
    wanted = "resisted" if motion.slew is None else motion.slew.unbalance
    if programme.unbalance != wanted:
        other.append(f"unbalance is {programme.unbalance}, of the motion {wanted}")
    return _owner("motion", other, motion.name)


def _owner(kind: str, other: list[str], words: str) -> Check:
    return check(kind, len(other), 0, f"programme of another {kind}: {'; '.join(other)}" if other else words)


def winding_checks(motion: RequiredMotion, programme: Programme) -> list[Check]:
    """Flywheels whose winding is not as the motion wants it."""
    wanted, turns = motion.winding, programme.winding
    if not motion.periodic or wanted == "any":
        return []
    if isinstance(wanted, str):
        other = sum((n != 0) == (wanted == "rock") for n in turns)
    else:
        other = sum(a != b for a, b in zip(wanted, turns, strict=True))
    return [check("winding", other, 0, f"{list(turns)}, wanted {wanted if isinstance(wanted, str) else list(wanted)}")]


OF_WAVE = 32
"""Rows of the table that a Fourier series is judged as, in a period of its highest harmonic."""


def table_checks(programme: Programme, limit: float) -> list[Check]:
    """Whether phi', phi'' are derivatives of phi, and a period ends where it began, a winding further on."""
    samples, span = programme.course, programme.span
    if isinstance(samples, Fourier):
        t = span * np.arange(OF_WAVE * max(len(samples.cos), 1)) / (OF_WAVE * max(len(samples.cos), 1))
        samples = Samples(t, *programme.at(t))
    if not programme.periodic:
        return [rows_check("table", samples, limit)]
    turn = 2 * np.pi * np.array(programme.winding, dtype=np.float64)

    def around(column: Array, further: Array | float = 0.0) -> Array:  # so that all rows are inner rows
        return np.concatenate([column[-1:] - further, column, column[:1] + further])

    wrapped = Samples(
        around(samples.t, span), around(samples.phi, turn), around(samples.phi_dot), around(samples.phi_ddot)
    )
    errors = neighbour_errors(wrapped)
    joint = "last and first row, winding turns apart, against their neighbours"
    return [
        _worst_row("table", samples.t[1:-1], errors[1:-1], limit),
        check("periodicity", float(max(errors[0], errors[-1])), limit, joint),
    ]


def rows_check(name: str, samples: Samples, limit: float) -> Check:
    """The inner rows of a table."""
    return _worst_row(name, samples.t[1:-1], neighbour_errors(samples), limit)


def _worst_row(name: str, t: Array, errors: Array, limit: float) -> Check:
    if not len(errors):
        return check(name, 0.0, limit, "no row has neighbours")
    i = int(np.argmax(errors))
    return check(name, float(errors[i]), limit, f"row {i + 1}, t = {t[i]:.6g} s, against its neighbours")


def neighbour_errors(samples: Samples) -> Array:
    """For each inner row what the quintic between its two neighbours misses phi, phi', phi'' by (M - 2).

    phi' and phi'' as shares of their peaks, phi of the way that the peak speed goes in the step.
    """
    speed = largest(samples.phi_dot) or 1.0
    acceleration = max(largest(samples.phi_ddot), 1e-6 * speed / float(np.ptp(samples.t)))
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


EXCEEDED = 1 + 1e-9
"""Value over its bound that counts as exceeded: rounding of the program that kept it does not."""

UNITS = {"speed": "rad/s", "acceleration": "rad/s2", "torque": "N m", "angle": "rad"}


def bound_check(name: str, values: Array, limits: Any, names: Sequence[str], unit: str) -> Check:
    """Largest magnitude of values (M, N) over its limit (N, or M, N)."""
    with np.errstate(divide="ignore", invalid="ignore"):
        shares = np.where(values == 0.0, 0.0, np.abs(values) / limits)
    i, s = np.unravel_index(np.argmax(shares), shares.shape)
    most = np.broadcast_to(limits, shares.shape)[i, s]
    return check(name, float(shares[i, s]), EXCEEDED, f"{names[s]}: {abs(values[i, s]):.6g} of {most:.6g} {unit}")


def bound_checks(
    bounds: Bounds, names: Sequence[str], angles: Angles, tau: Array, rocking: Array | None, prefix: str = ""
) -> list[Check]:
    """An item for each given bound. `rocking` (M, N): phi less winding and mean; None where it has no bound."""
    columns = {"speed": angles.phi_dot, "acceleration": angles.phi_ddot, "torque": tau, "angle": rocking}
    return [
        bound_check(f"{prefix}bound {key}", values, np.array(getattr(bounds, key)), names, UNITS[key])
        for key, values in columns.items()
        if values is not None and getattr(bounds, key) is not None and names
    ]


def slowest_checks(bounds: Bounds, names: Sequence[str], phi_dot: Array) -> list[Check]:
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
    return [check("bound speed_min", float(shares[s]), EXCEEDED, words)]


def rocking_of(programme: Programme, t: Array, phi: Array) -> Array:
    """Angles phi less their winding and mean (M, N; rad)."""
    turn = 2 * np.pi * np.array(programme.winding, dtype=np.float64)
    left = phi - (t / programme.span)[:, None] * turn
    return np.asarray(left - left.mean(axis=0))


def start_checks(motion: RequiredMotion, programme: Programme, limit: float) -> list[Check]:
    """Distance from `start` of a finite motion: rad, and share of the peak speed."""
    angles, wanted, items = programme.at(np.zeros(1)), motion.bounds, []
    if wanted.start_phi is not None:
        items.append(check("start phi", largest(angles.phi[0] - np.array(wanted.start_phi)), limit, "rad"))
    if wanted.start_phi_dot is not None:
        speeds = np.array(wanted.start_phi_dot)
        peak = max(largest(programme.at(np.linspace(0.0, programme.span, 999)).phi_dot), largest(speeds), 1e-12)
        share = largest(angles.phi_dot[0] - speeds) / peak
        items.append(check("start phi_dot", share, limit, "share of the peak speed"))
    return items


def bias_checks(motion: RequiredMotion, programme: Programme) -> list[Check]:
    """The bias: zero where the mean is not free; within its bound."""
    names, bias = programme.coordinates or FREE, programme.bias
    held = np.where(motion.free_mean, 0.0, np.abs(bias))
    worst = int(np.argmax(held))
    words = f"of {names[worst]}, whose mean is not free" if held[worst] else "zero where the mean is not free"
    items = [check("bias", float(held[worst]), 0.0, words)]
    if motion.bounds.bias is not None:
        items.append(bound_check("bound bias", bias[None], np.array(motion.bounds.bias), names, "m or rad"))
    return items
