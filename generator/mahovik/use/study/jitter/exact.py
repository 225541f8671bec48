"""Lines of the full equations at one set of speeds, by harmonic balance."""

from __future__ import annotations

import numpy as np

from mahovik.use.plan.array import Array
from mahovik.use.study.jitter.balance import SLOW, Balance
from mahovik.use.study.jitter.lines import COMBINATION, UNBALANCE, LineName, Lines
from mahovik.use.study.jitter.quantity import values
from mahovik.use.study.linear.model import Place

NEGLIGIBLE = 1e-9
"""Part of the largest amplitude below which a line is left out."""


def exact_lines(found: Balance, place: Place, quantity: str, phases: Array) -> Lines:
    """Lines (S = 1) of a motion on the torus, at a point, for phases (N, rad) at t = 0."""
    torus = found.torus
    w = found.frequencies
    y, y_dot = torus.values(found.c), torus.values(1j * w[:, None] * found.c)
    a = torus.coefficients(values(place, quantity, y, y_dot[:, 6:]))
    a = a * np.exp(1j * (torus.k @ phases[list(found.turning)]))[:, None]
    a = np.where(w[:, None] < 0.0, a.conj(), a)
    fastest = float(np.abs(found.speeds).max(initial=0.0))
    f = np.where(np.abs(w) <= SLOW * fastest, 0.0, np.abs(w)) / (2.0 * np.pi)
    sizes = np.abs(a).max(axis=1)
    kept = (sizes > NEGLIGIBLE * sizes[f > 0.0].max(initial=0.0)) | (torus.k == 0).all(axis=1)
    names = [found.scene.stand.flywheels[s].name for s in found.turning]
    labels = [_name(k.tolist(), names) for k in torus.k[kept]]
    return Lines(tuple(labels), f[kept][None], a[kept][None])


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
