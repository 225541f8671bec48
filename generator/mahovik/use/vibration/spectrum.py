"""Lines of the whole equations (8) at one set of speeds and phases, with what internal and structural modes add."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mahovik.use.numeric.se3 import Array, Complex
from mahovik.use.vibration.chain import Chain
from mahovik.use.vibration.lines import COMBINATION, SAME, UNBALANCE, LineName, Spectrum
from mahovik.use.vibration.scene import Scene
from mahovik.use.vibration.steady import SLOW, Steady, rounding_rates, rounding_wrench, steady
from mahovik.use.vibration.torus import Whole
from mahovik.use.vibration.view import LoadView, Observable, View

LOAD_ROUNDING = 1e-13
"""Part of a constant load, as of a weight, below which a line is rounding."""

WRENCH_ROUNDING = 1e-13
"""Part of a mount's largest wrench below which a harmonic of it drives nothing: a mode without damping would ring."""


def spectrum(scene: Scene, chain: Chain, speeds: Sequence[float], phases: Array) -> Spectrum:
    """Lines at speeds (N, rad/s) for phases (N, rad) at t = 0. Raises CheckError: no steady motion is found."""
    motion = steady(scene, speeds, phases.tolist())
    torus, w, full = motion.torus, motion.frequencies, motion.full()
    a = torus.coefficients(chain.seen.full(full))
    rounding = _rounding(scene, chain.seen, motion.speeds, w, a[0].real.copy())
    moving, back = np.abs(w) > SLOW * float(np.abs(motion.speeds).max(initial=0.0)), w[:, None] < 0.0
    a = np.where(back, a.conj(), a)
    if chain.one_way:
        mounts = torus.coefficients(full.mount_wrenches())
        mounts = np.where(back[..., None], mounts.conj(), mounts)[moving]
        a[moving] += _driven(chain, motion.speeds, np.abs(w[moving]), mounts)
    left = np.zeros(3)
    if len(motion.base) > 1:
        left = left_out_of(motion, chain.seen)
        left = np.where(left <= rounding[moving].sum(), 0.0, left)
    kept = moving & ~(np.abs(a).max(axis=1) <= rounding)
    w = np.abs(w)
    order = np.flatnonzero(kept)[np.argsort(w[kept], kind="stable")]
    first = np.flatnonzero(np.concatenate([[True], np.diff(w[order]) > SAME * w[order][1:]])[: len(order)])
    groups = np.split(order, first[1:]) if len(order) else []
    names = [s.name for s in scene.stand.flywheels]
    return Spectrum(
        tuple(_name(motion, torus.k[group], names) for group in groups),
        w[order][first] / (2.0 * np.pi),
        np.array([a[group].sum(axis=0) for group in groups], dtype=np.complex128).reshape(-1, 3),
        left,
        motion.left_out,
        motion.method,
        motion.hold,
        motion.unstable,
    )


def _driven(chain: Chain, speeds: Array, omega: Array, mounts: Complex) -> Complex:
    """Amplitudes (n, 3) that mount wrenches (n, N, 6) at omega (n; rad/s, above 0) drive."""
    rounding = np.abs(mounts) <= WRENCH_ROUNDING * np.abs(mounts).max(axis=0, initial=0.0)
    return np.asarray(chain.driven_amplitudes(speeds[None], omega[None], np.where(rounding, 0.0, mounts)[None])[0])


def _name(motion: Steady, k: Whole, wheels: Sequence[str]) -> LineName:
    """Name of lines k (g, r) of one frequency: that of the lowest order; of several wheels' all of them.

    A harmonic of a common period that is no whole order of a wheel is an order of the fastest.
    """
    if len(motion.base) == 1:
        turns, n = np.abs(motion.turns[:, 0]).tolist(), abs(int(k[0, 0]))
        orders = {s: n // turn for s, turn in enumerate(turns) if turn and n % turn == 0}
        order = min(orders.values(), default=n / max(turns))
        single = [s for s in orders if orders[s] == order] or [turns.index(max(turns))]
        return LineName(", ".join(wheels[s] for s in single), float(order))
    size = np.abs(k).sum(axis=1)
    lowest = (k[size == size.min()] @ motion.turns.T).tolist()
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


def left_out_of(motion: Steady, seen: Observable) -> Array:
    """Part of the quantity (3) that a motion leaves out at any phases: sum of the amplitudes of its lines.

    The lines are those of `Steady.missing`, of the rigid stand and to first order; NaN where they are not known. Those
    of a load are what the missing motion and the higher orders add to it.
    """
    missing = motion.missing
    if missing is None:
        return np.full(3, np.nan)
    moving, larger = missing.w != 0.0, missing.torus
    if isinstance(seen, View):
        return np.asarray(np.abs(seen.by_pose(missing.pose[moving], np.abs(missing.w[moving]))).sum(axis=0))
    near = larger.pad(motion.torus.coefficients(seen.full(motion.full())))
    whole = seen.full(motion.full(larger, larger.pad(motion.c) + missing.c))
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
