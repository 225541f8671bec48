"""Items 5, 6: bounds on a fine grid, the bias, and what the motion says of windings and start."""

from __future__ import annotations

import numpy as np

from mahovik.core.motion.programme import Angles, Programme
from mahovik.core.motion.required import Bounds, RequiredMotion
from mahovik.proof.reference.array import Array
from mahovik.proof.verify.programme.finding import Finding, judged

EXCEEDED = 1 + 1e-9
"""Value over its bound that counts as exceeded: rounding of the program that kept it does not."""

UNITS = {"speed": "rad/s", "acceleration": "rad/s2", "torque": "N m", "angle": "rad"}


def bound_findings(
    bounds: Bounds, names: tuple[str, ...], angles: Angles, tau: Array, rocking: Array, prefix: str = ""
) -> list[Finding]:
    """One for each bound that is given: largest value over its bound. `rocking` (M, N): phi less winding and mean."""
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
        found.append(judged(f"{prefix}bound {key}", float(shares[s]), EXCEEDED, words))
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
    return [judged("bound speed_min", float(shares[s]), EXCEEDED, words)]


def rocking_of(programme: Programme, t: Array, phi: Array) -> Array:
    """phi less its winding and its mean (M, N; rad)."""
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
    return [judged("winding", other, 0, f"{list(found)}, wanted {asked}")]


def start_findings(motion: RequiredMotion, programme: Programme, limit: float) -> list[Finding]:
    """Distance from `start` of a finite motion: rad, and share of the peak speed."""
    angles, found = programme.at(np.zeros(1)), []
    if motion.bounds.start_phi is not None:
        apart = float(np.abs(angles.phi[0] - np.array(motion.bounds.start_phi)).max(initial=0.0))
        found.append(judged("start phi", apart, limit, "rad"))
    if motion.bounds.start_phi_dot is not None:
        wanted = np.array(motion.bounds.start_phi_dot)
        peak = float(np.abs(programme.at(np.linspace(0.0, programme.span, 999)).phi_dot).max(initial=0.0))
        apart = float(np.abs(angles.phi_dot[0] - wanted).max(initial=0.0))
        found.append(
            judged(
                "start phi_dot",
                apart / max(peak, float(np.abs(wanted).max(initial=0.0)), 1e-12),
                limit,
                "share of the peak speed",
            )
        )
    return found


def bias_findings(motion: RequiredMotion, programme: Programme) -> list[Finding]:
    """Zero where the mean is not free; within its bound."""
    names = ("x", "y", "z", "psi", "theta", "phi")
    held = ~np.array(motion.free_mean)
    worst = int(np.argmax(np.abs(programme.bias) * held))
    value = float(abs(programme.bias[worst])) if held[worst] else 0.0
    words = f"of {names[worst]}, whose mean is not free" if value else "zero where the mean is not free"
    found = [judged("bias", value, 0.0, words)]
    if motion.bounds.bias is not None:
        limit = np.array(motion.bounds.bias)
        with np.errstate(divide="ignore", invalid="ignore"):
            shares = np.where(programme.bias != 0.0, np.abs(programme.bias) / limit, 0.0)
        i = int(np.argmax(shares))
        found.append(
            judged("bound bias", float(shares[i]), EXCEEDED, f"{names[i]}: {programme.bias[i]:.6g} of {limit[i]:.6g}")
        )
    return found
