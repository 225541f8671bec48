"""Lines of the full equations at one set of speeds, by harmonic balance."""

from __future__ import annotations

import numpy as np

from mahovik.core.stand.hold import wrenches
from mahovik.use.numeric import Array, Complex
from mahovik.use.vibration.balance import SLOW, Balance
from mahovik.use.vibration.chain import Chain
from mahovik.use.vibration.lines import COMBINATION, UNBALANCE, LineName, Lines
from mahovik.use.vibration.scene import Scene
from mahovik.use.vibration.torus import Torus
from mahovik.use.vibration.torus_motion import full_motion, rounding_rates, rounding_wrench
from mahovik.use.vibration.view import FreedomView, LoadView, Observable, View

NEGLIGIBLE = 1e-9
"""Part of the largest amplitude below which a line is left out."""

LOAD_ROUNDING = 1e-13
"""Part of the constant load, as of a weight, below which a line is rounding, and left out."""


def exact_lines(found: Balance, seen: Observable, phases: Array, chain: Chain | None = None) -> Lines:
    """Lines (S = 1) of a motion on the torus, for phases (N, rad) at t = 0.

    chain    what the exact mount wrenches drive in addition: internal modes of wheels, structural modes
    """
    torus = found.torus
    w = found.frequencies
    a = torus.coefficients(seen.full(full_motion(found, torus, found.c, found.h)))
    if chain is not None and chain.one_way:
        mounts = torus.coefficients(full_motion(found, torus, found.c, found.h).mount_wrenches())
        a = a + _driven_amplitudes(chain, found.speeds, w, mounts)
    a = a * np.exp(1j * (torus.k @ phases[list(found.turning)]))[:, None]
    a = np.where(w[:, None] < 0.0, a.conj(), a)
    fastest = float(np.abs(found.speeds).max(initial=0.0))
    f = np.where(np.abs(w) <= SLOW * fastest, 0.0, np.abs(w)) / (2.0 * np.pi)
    sizes = np.abs(a).max(axis=1)
    largest = sizes[(f > 0.0) & np.isfinite(sizes)].max(initial=0.0)
    constant = (torus.k == 0).all(axis=1)
    rounding = 0.0
    if isinstance(seen, LoadView):
        rounding = max(
            LOAD_ROUNDING * float(sizes[constant].max(initial=0.0)),
            rounding_wrench(found.scene, found.speeds)[seen.rows].max(),
        )
    kept = ~(sizes <= max(NEGLIGIBLE * largest, rounding)) | constant
    names = [found.scene.stand.flywheels[s].name for s in found.turning]
    labels = [_name(k.tolist(), names) for k in torus.k[kept]]
    return Lines(tuple(labels), f[kept][None], a[kept][None])


def constant_load(scene: Scene, seen: LoadView, speeds: Array, phases: Array) -> Array:
    """The constant part (3) to first order: a load at rest under wheels at speeds (N, rad/s), mean over phase."""
    turning = tuple(int(s) for s in np.flatnonzero(speeds))
    torus, m, f = Torus.of(len(turning), 1), scene.count, scene.free.shape[1]
    c, h = (np.zeros((len(torus.k), n), dtype=np.complex128) for n in (2 * m, f))
    motion = full_motion(Balance(scene, torus, 1, speeds, phases, turning, c, h, np.zeros(6), 0.0), torus, c, h)
    wrench = motion.reaction() if seen.wheel is None else motion.mount(seen.wheel)
    if seen.wheel is None and scene.stand.hold is not None:  # what is along the freedoms moves the carrier
        wrench -= wrench @ scene.S @ wrenches(scene.stand.hold).T
    return np.asarray(wrench[:, seen.rows].mean(axis=0))


def left_out_of(found: Balance, seen: Observable) -> Array:
    """Part of the quantity (3) that the balance leaves out at any phases: sum of the amplitudes of its lines.

    The lines are those of `Balance.missing`, of the rigid stand and to first order; NaN where they are not known. Those
    of a load are what the missing motion and the higher orders add to it.
    """
    if found.missing is None or found.missing_c is None:
        return np.full(3, np.nan)
    moving = found.missing_w != 0.0
    if isinstance(seen, View | FreedomView):
        lines = seen.by_pose(found.missing[moving], np.abs(found.missing_w[moving]))
        return np.asarray(np.abs(lines).sum(axis=0))
    kept, larger = found.torus, Torus.of(found.torus.count, found.missing_order)
    near = larger.pad(kept.coefficients(seen.full(full_motion(found, kept, found.c, found.h))))
    moved = larger.pad(found.c) + found.missing_c
    whole = seen.full(full_motion(found, larger, moved, larger.pad(found.h)))
    return np.asarray(np.abs(larger.coefficients(whole) - near)[moving].sum(axis=0))


def rounding_of(found: Balance, seen: Observable) -> float:
    """What rounding makes of the quantity, root of the sum of squares over its axes: sum of the amplitudes of lines."""
    if isinstance(seen, LoadView):
        return float(np.linalg.norm(rounding_wrench(found.scene, found.speeds)[seen.rows]))
    assert isinstance(seen, View | FreedomView)
    w = np.abs(found.frequencies)
    w = w[w > SLOW * w.max(initial=0.0)]
    moved = found.scene.twist(
        rounding_rates(found.scene, found.speeds)[None] / max(np.abs(found.speeds).max(initial=0.0), 1e-300)
    )
    return float(np.linalg.norm(np.abs(seen.by_pose(moved / w[:, None], w)).sum(axis=0)))


def _name(k: list[int], names: list[str]) -> LineName:
    """Name of the line of k, one whole number per flywheel that turns."""
    there = [(n, name) for n, name in zip(k, names, strict=True) if n]
    if len(there) == 1:
        return LineName(there[0][1], float(abs(there[0][0])), UNBALANCE)
    words = ""
    for n, name in there:
        sign = ("-" if n < 0 else "+") if words else ("-" if n < 0 else "")
        words += f" {sign} " if words else sign
        words += name if abs(n) == 1 else f"{abs(n)} {name}"
    return LineName(words, float(sum(map(abs, k))), COMBINATION)


def _driven_amplitudes(chain: Chain, speeds: Array, w: Array, mounts: Complex) -> Complex:
    """Amplitudes (n, 3) that mount wrenches (n, N, 6) at w (n; rad/s, of either sign) drive; none at 0."""
    a = np.zeros((len(w), 3), dtype=np.complex128)
    moving = np.abs(w) > SLOW * float(np.abs(speeds).max(initial=0.0))
    if not moving.any():
        return a
    back = w[moving, None, None] < 0.0
    given = np.where(back, mounts[moving].conj(), mounts[moving])
    driven = chain.driven_amplitudes(speeds[None], np.abs(w[None, moving]), given[None])[0]
    a[moving] = np.where(back[:, 0], driven.conj(), driven)
    return a
