"""The stand in motion: scene and rows of the motion as data, a canvas that draws them, controls."""

from __future__ import annotations

import base64
import json
from typing import Any

import numpy as np

from mahovik.core.emit.templates import template
from mahovik.out.report.stand.animated import Array, Motion, motion_of, thinned
from mahovik.out.report.stand.drawing import basis
from mahovik.out.report.stand.material import Material
from mahovik.out.report.stand.projection import round_length
from mahovik.out.report.stand.section import Section
from mahovik.out.report.stand.shape import Shape, Solid, shape_of
from mahovik.out.report.stand.views import axis_length, names

BYTES = 900_000
"""Size of a motion's rows: bytes before base64 (which adds a third)."""

SLOW = 0.6
"""Turns per second of the fastest flywheel when the animation begins."""

LONGEST = 120.0
"""s: longest duration of the whole when the animation begins."""

SHOWN, TURNED = 0.08, 0.25
"""Share of the stand's size, and rad, to which small motion is magnified as the animation begins."""

STILL = 1e-9
"""Share of the stand's size, and rad: what stays within it may be rounding, and is not magnified."""


def section(material: Material) -> Section | None:
    """The section: always there."""
    shape = shape_of(material.stand)
    motion, left_out = thinned(motion_of(material), BYTES // (4 * (7 + len(shape.flywheels))))
    position, quaternion = reference(motion)
    rows, moved, turned = relative(motion, position, quaternion)
    still = motion.moves and max(moved / shape.size, turned) < STILL
    steps, begin = magnifications(moved, turned, shape.size) if motion.moves and not still else ([1.0], 0)
    speeds, slow = _speeds(motion)
    data = {
        "scene": scene(shape),
        "reference": {"position": position.tolist(), "quaternion": quaternion.tolist()},
        "rows": base64.b64encode(rows.astype("<f4").tobytes()).decode(),
        "from": float(motion.t[0]),
        "magnifications": steps,
        "far": bool(moved > 0.5 * shape.size),
    }
    html = template("report_animation.html.j2").render(
        name=material.stand.name,
        words=f"{motion.words}; its carrier stands still" if still else motion.words,
        left_out=left_out,
        data=json.dumps(data, allow_nan=False, separators=(",", ":")).replace("<", "\\u003c"),
        count=len(motion.t),
        speeds=[(repr(x), f"{x:g} ×", x == slow) for x in speeds],
        magnifications=len(steps) - 1,
        magnification=begin,
        traced=["O1", *(name for name, _ in shape.points), *(s.name for s in shape.instruments)],
        moves=motion.moves,
        flywheels=bool(shape.flywheels),
    )
    return Section("animation", "Animation", html)


def scene(shape: Shape) -> dict[str, Any]:
    """The fixed part of the scene in E1, for the canvas; m."""

    def solid(of: Solid) -> dict[str, Any]:
        return {"name": of.name, "center": _short(of.center), "axes": _short(of.axes.T)}

    return {
        "size": shape.size,
        "tall": float(max(shape.extent(basis(shape))[1:].max(), 0.25 * shape.size)),
        "axes": 1.25 * axis_length(shape),
        "basis": basis(shape).tolist(),
        "carrier": solid(shape.carrier),
        "instruments": [solid(each) for each in shape.instruments],
        "flywheels": [
            {
                "name": name,
                "center": _short(disc.center),
                "axes": _short(disc.C.T),
                "radius": disc.radius,
                "thickness": disc.thickness,
                "heavy": float(np.arctan2(disc.static[1], disc.static[0])) if disc.static.any() else None,
            }
            for name, disc in zip(names(shape), shape.flywheels, strict=True)
        ],
        "ties": [{"carrier": _short(tie.carrier), "ground": _short(tie.ground)} for tie in shape.ties],
        "traced": [
            [0.0, 0.0, 0.0],
            *(_short(at) for _, at in shape.points),
            *(_short(s.origin) for s in shape.instruments),
        ],
        "points": [_short(at) for _, at in shape.points],
    }


def reference(motion: Motion) -> tuple[Array, Array]:
    """The pose from which motion is magnified: middle of the places (3, m), mean of the attitudes (4).

    The mean is the eigenvector of sum q q^T of the largest eigenvalue: q and -q are the same attitude.
    """
    middle = (motion.position.min(axis=0) + motion.position.max(axis=0)) / 2
    mean = np.linalg.eigh(motion.quaternion.T @ motion.quaternion)[1][:, -1]
    return middle, mean if mean[np.argmax(np.abs(mean))] > 0 else -mean


def relative(motion: Motion, position: Array, quaternion: Array) -> tuple[Array, float, float]:
    """Rows (M, 7 + N): t from the first, place less `position`, vector of the unit quaternion from `quaternion` (its
    scalar is not negative), phases within a turn at the start; and the largest distance (m) and turn (rad)."""
    turn = _product(quaternion * [1.0, -1.0, -1.0, -1.0], motion.quaternion)
    turn = np.where(turn[:, :1] < 0.0, -turn, turn)
    place = motion.position - position
    phi = motion.phi - 2 * np.pi * np.floor(motion.phi[:1] / (2 * np.pi))
    rows = np.hstack([(motion.t - motion.t[0])[:, None], place, turn[:, 1:], phi])
    sine = np.minimum(np.linalg.norm(turn[:, 1:], axis=1), 1.0)
    return rows, float(np.linalg.norm(place, axis=1).max()), float(2 * np.arcsin(sine).max())


def magnifications(moved: float, turned: float, size: float) -> tuple[list[float], int]:
    """Factors by which motion may be magnified, 1, 2, 5, 10, ..., and the number of the one to begin with.

    The largest brings the motion to the stand's size or to a quarter of a turn.
    """
    share = max(moved / (SHOWN * size), turned / TURNED)
    if not share > 0.0:
        return [1.0], 0
    begin = max(round_length(1.0 / share), 1.0)
    last = max(min(size / moved if moved else np.inf, 0.5 * np.pi / turned if turned else np.inf), begin)
    powers = range(int(np.log10(last)) + 1)
    found = [k * 10.0**p for p in powers for k in (1, 2, 5) if k * 10.0**p <= last * (1 + 1e-9)]
    return found, int(np.argmin(np.abs(np.log(np.array(found) / begin))))


def _speeds(motion: Motion) -> tuple[list[float], float]:
    """Choices of how fast time runs, and the one to begin with."""
    span = float(motion.t[-1] - motion.t[0])
    rate = np.abs(np.diff(motion.phi, axis=0)) / np.diff(motion.t)[:, None]
    fastest = float(np.quantile(rate.max(axis=1), 0.9)) if rate.size else 0.0
    begin = max(SLOW * 2 * np.pi / fastest if fastest else 1.0, span / LONGEST)
    begin = float(f"{round_length(min(max(begin, 1e-4), 10.0)):.1g}") if fastest or span > LONGEST else 1.0
    known = [float(f"{k}e{p}") for p in range(-4, 2) for k in (1, 2, 5)]
    return [x for x in known if begin / 200 < x <= max(10.0, begin)], begin


def _product(p: Array, q: Array) -> Array:
    """Quaternion products p q (M, 4), w first, of p (4) and q (M, 4)."""
    scalar = p[0] * q[:, 0] - q[:, 1:] @ p[1:]
    vector = p[0] * q[:, 1:] + q[:, :1] * p[1:] + np.cross(p[1:], q[:, 1:])
    return np.column_stack([scalar, vector])


def _short(a: Array) -> Any:
    """Numbers of a picture: seven digits."""
    flat = [float(f"{x:.7g}") for x in np.ravel(a)]
    return np.reshape(flat, np.shape(a)).tolist()
