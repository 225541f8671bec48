"""Lines of the whole equations (8) at one set of speeds and phases, by one base frequency or by as many as turn.

Speeds in small whole ratios have a common period, and the motion is found with its harmonics (`periodic`). Otherwise it
is found on the torus of the wheels' phases (`balance`). Each takes the place of the other where that finds no motion.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mahovik.errors import CheckError, UsageError
from mahovik.use.numeric.se3 import Array, Complex
from mahovik.use.vibration.balance import SLOW, Balance, balance
from mahovik.use.vibration.chain import Chain
from mahovik.use.vibration.lines import COMBINATION, SAME, UNBALANCE, LineName, Spectrum
from mahovik.use.vibration.periodic import harmonics, periodic_response
from mahovik.use.vibration.scene import Scene
from mahovik.use.vibration.speeds import Turning, common_period
from mahovik.use.vibration.torus import Torus, Whole
from mahovik.use.vibration.torus_motion import full_motion, rounding_rates, rounding_wrench
from mahovik.use.vibration.view import LoadView, Observable, View

FEW_TURNS = 40
"""Most turns of the fastest flywheel in a common period at which its harmonics are fewer than those of a torus."""

LOAD_ROUNDING = 1e-13
"""Part of a constant load, as of a weight, below which a line is rounding."""

WRENCH_ROUNDING = 1e-13
"""Part of a mount's largest wrench below which a harmonic of it drives nothing: a mode without damping would ring."""


def spectrum(scene: Scene, chain: Chain, speeds: Sequence[float], phases: Array) -> Spectrum:
    """Lines at speeds (N, rad/s) for phases (N, rad) at t = 0, with what the chain adds: internal and structural modes.

    Raises CheckError: no steady motion is found.
    """
    try:
        turning = common_period(speeds)
    except UsageError:
        return _on_torus(scene, chain, speeds, phases)
    if max(map(abs, turning.turns), default=0) <= FEW_TURNS:
        return _with_period(scene, chain, turning, phases)
    try:
        return _on_torus(scene, chain, speeds, phases)
    except CheckError:
        return _with_period(scene, chain, turning, phases)


def _with_period(scene: Scene, chain: Chain, turning: Turning, phases: Array) -> Spectrum:
    """Lines at the harmonics of the base frequency. Raises CheckError."""
    periodic, speeds = periodic_response(scene, turning.speeds, phases.tolist()), np.array(turning.speeds)
    motion = periodic.motion
    a = harmonics(chain.seen.full(motion))
    w = np.asarray(turning.base * np.arange(len(a)), dtype=np.float64)
    kept = np.arange(len(a)) > 0
    if chain.one_way:
        a[kept] += _driven(chain, speeds, w[kept], harmonics(motion.mount_wrenches())[kept])
    kept &= ~(np.abs(a).max(axis=1) <= _rounding(scene, chain.seen, speeds, w, a[0].real))
    names = _harmonic_names([s.name for s in scene.stand.flywheels], turning, np.flatnonzero(kept))
    method = f"{len(a) - 1} harmonics of the common period"
    return Spectrum(
        names, w[kept] / (2.0 * np.pi), a[kept], np.zeros(3), 0.0, method, periodic.hold, not periodic.stable
    )


def _harmonic_names(wheels: Sequence[str], turning: Turning, kept: Whole) -> tuple[LineName, ...]:
    """Names of harmonics of the base: the lowest whole order of a wheel, else the order of the fastest."""
    turns = np.abs(turning.turns)
    harmonic_names = []
    for k in kept.tolist():
        orders = {s: k // n for s, n in enumerate(turns.tolist()) if n and k % n == 0}
        order = min(orders.values(), default=k / max(turns.max(initial=1), 1))
        those = [s for s in orders if orders[s] == order] or [int(turns.argmax())]
        harmonic_names.append(LineName(", ".join(wheels[s] for s in those), float(order)))
    return tuple(harmonic_names)


def _on_torus(scene: Scene, chain: Chain, speeds: Sequence[float], phases: Array) -> Spectrum:
    """Lines at the combinations of the wheels' frequencies. Raises CheckError."""
    result = balance(scene, speeds, phases.tolist())
    torus, w = result.torus, result.frequencies
    motion = full_motion(result, torus, result.c, result.h)
    a = torus.coefficients(chain.seen.full(motion))
    constant = a[0].real.copy()
    if chain.one_way:
        back = w[:, None, None] < 0.0
        mounts = torus.coefficients(motion.mount_wrenches())
        moving = np.abs(w) > SLOW * float(np.abs(result.speeds).max(initial=0.0))
        driven = _driven(chain, result.speeds, np.abs(w[moving]), np.where(back, mounts.conj(), mounts)[moving])
        a[moving] += np.where(back[moving, 0], driven.conj(), driven)
    a = a * np.exp(1j * (torus.k @ phases[list(result.turning)]))[:, None]
    a = np.where(w[:, None] < 0.0, a.conj(), a)
    w = np.abs(w)
    names = [s.name for s in scene.stand.flywheels]
    kept = w > SLOW * float(np.abs(result.speeds).max(initial=0.0))
    rounding = _rounding(scene, chain.seen, result.speeds, w, constant)
    left = left_out_of(result, chain.seen)
    left = np.where(left <= rounding[kept].sum(), 0.0, left)
    kept &= ~(np.abs(a).max(axis=1) <= rounding)
    order = np.flatnonzero(kept)[np.argsort(w[kept], kind="stable")]
    first = np.flatnonzero(np.concatenate([[True], np.diff(w[order]) > SAME * w[order][1:]])[: len(order)])
    groups = np.split(order, first[1:]) if len(order) else []
    labels = tuple(_name(torus.k[group], [names[s] for s in result.turning]) for group in groups)
    sums = np.array([a[group].sum(axis=0) for group in groups], dtype=np.complex128).reshape(-1, 3)
    method = f"harmonic balance of order {result.order}{f' ({result.short})' if result.short else ''}"
    return Spectrum(labels, w[order][first] / (2.0 * np.pi), sums, left, result.left_out, method, result.hold, False)


def _driven(chain: Chain, speeds: Array, omega: Array, mounts: Complex) -> Complex:
    """Amplitudes (n, 3) that mount wrenches (n, N, 6) at omega (n; rad/s, above 0) drive."""
    rounding = np.abs(mounts) <= WRENCH_ROUNDING * np.abs(mounts).max(axis=0, initial=0.0)
    return np.asarray(chain.driven_amplitudes(speeds[None], omega[None], np.where(rounding, 0.0, mounts)[None])[0])


def _name(k: Whole, wheels: Sequence[str]) -> LineName:
    """Name of lines k (g, count) of one frequency: that of the lowest order; of several wheels' all of them."""
    size = np.abs(k).sum(axis=1)
    lowest = k[size == size.min()].tolist()
    single = [next(s for s, n in enumerate(row) if n) for row in lowest if np.count_nonzero(row) == 1]
    if single:
        return LineName(", ".join(wheels[s] for s in sorted(single)), float(size.min()), UNBALANCE)
    words = ""
    for n, name in zip(lowest[0], wheels, strict=True):
        if n:
            sign = ("-" if n < 0 else "+") if words else ("-" if n < 0 else "")
            words += f" {sign} " if words else sign
            words += name if abs(n) == 1 else f"{abs(n)} {name}"
    return LineName(words, float(size.min()), COMBINATION)


def left_out_of(balance: Balance, seen: Observable) -> Array:
    """Part of the quantity (3) that a balance leaves out at any phases: sum of the amplitudes of its lines.

    The lines are those of `Balance.missing`, of the rigid stand and to first order; NaN where they are not known. Those
    of a load are what the missing motion and the higher orders add to it.
    """
    if balance.missing is None or balance.missing_c is None:
        return np.full(3, np.nan)
    moving = balance.missing_w != 0.0
    if isinstance(seen, View):
        lines = seen.by_pose(balance.missing[moving], np.abs(balance.missing_w[moving]))
        return np.asarray(np.abs(lines).sum(axis=0))
    kept, larger = balance.torus, Torus.of(balance.torus.count, balance.missing_order)
    near = larger.pad(kept.coefficients(seen.full(full_motion(balance, kept, balance.c, balance.h))))
    moved = larger.pad(balance.c) + balance.missing_c
    whole = seen.full(full_motion(balance, larger, moved, larger.pad(balance.h)))
    return np.asarray(np.abs(larger.coefficients(whole) - near)[moving].sum(axis=0))


def _rounding(scene: Scene, seen: Observable, speeds: Array, w: Array, constant: Array) -> Array:
    """Amplitudes (n) of the quantity that rounding makes at w (n; rad/s), beside a constant part (3)."""
    if isinstance(seen, LoadView):
        wrench = rounding_wrench(scene, speeds)[seen.rows].max()
        return np.full(len(w), max(LOAD_ROUNDING * float(np.abs(constant).max(initial=0.0)), float(wrench)))
    fastest = float(np.abs(speeds).max(initial=0.0)) or 1.0
    slow = np.maximum(np.abs(w), SLOW * fastest)
    pose = scene.twist(rounding_rates(scene, speeds)[None]) / (fastest * slow[:, None])
    return np.asarray(np.abs(seen.by_pose(pose.astype(np.complex128), slow)).max(axis=1))
