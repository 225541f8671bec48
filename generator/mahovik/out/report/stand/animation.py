"""The stand in motion: the motion of a run, of a programme or at constant speed, as data for a canvas that draws it."""

from __future__ import annotations

import base64
import json
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mahovik.core.emit.templates import template
from mahovik.core.stand.model import Stand
from mahovik.core.stand.summary import summarize
from mahovik.out.report.stand.drawing import basis
from mahovik.out.report.stand.material import Material, Section
from mahovik.out.report.stand.projection import round_length
from mahovik.out.report.stand.shape import Shape, Solid, shape_of
from mahovik.out.report.stand.views import axis_length, names
from mahovik.proof.reference.rotation import attitude
from mahovik.use.plan.residual.held_kinematics import held_pose
from mahovik.use.simulate.held import home

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
    motion, left_out = thin_motion(motion_of(material), BYTES // (4 * (7 + len(shape.flywheels))))
    position, quaternion = reference_pose(motion)
    rows, moved, turned = rows_from_reference(motion, position, quaternion)
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


def reference_pose(motion: Motion) -> tuple[Array, Array]:
    """The pose from which motion is magnified: middle of the places (3, m), mean of the attitudes (4).

    The mean is the eigenvector of sum q q^T of the largest eigenvalue: q and -q are the same attitude.
    """
    middle = (motion.position.min(axis=0) + motion.position.max(axis=0)) / 2
    mean = np.linalg.eigh(motion.quaternion.T @ motion.quaternion)[1][:, -1]
    return middle, mean if mean[np.argmax(np.abs(mean))] > 0 else -mean


def rows_from_reference(motion: Motion, position: Array, quaternion: Array) -> tuple[Array, float, float]:
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
    """Factors by which motion may be magnified, 1, 2, 5, 10, ..., and the number of the initial one.

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
    """Choices of how fast time runs, and the initial one."""
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


Array = NDArray[np.float64]

PERIOD_ROWS = 1200
"""Rows for a periodic programme."""

ROWS = 6000
"""Rows for a finite programme."""

TURNS = 60
"""Turns of flywheels at constant speed before the animation starts again."""

STRAIGHT = 0.1
"""A motion may be thinned where straight lines between the rows left keep to this share of its range,"""

PHASE = 0.2
"""and to this many rad of every phase."""


@dataclass(frozen=True, eq=False)
class Motion:
    """Rows of a motion: t (M, s), position of O1 in E0 (M, 3, m), attitude (M, 4, unit quaternion, w first), phases
    (M, N, rad, counted through). `words` say whose it is; `moves`: whether the carrier is known to move."""

    words: str
    t: Array
    position: Array
    quaternion: Array
    phi: Array
    moves: bool

    def rows(self, start: int, step: int) -> Motion:
        """Every `step`-th row from `start` on."""
        cut = slice(start, None, step)
        return replace(
            self,
            t=self.t[cut],
            position=self.position[cut],
            quaternion=self.quaternion[cut],
            phi=self.phi[cut],
        )


def motion_of(material: Material) -> Motion:
    """The motion that there is of a stand: of the run, else of the programme, else constant speeds."""
    run, programme, N = material.run, material.programme, len(material.stand.flywheels)
    if run is not None:
        numbers = np.hstack([run.t[:, None], run.position, run.quaternion, run.phi])
        good = np.isfinite(numbers).all(axis=1)
        if good.sum() > 1:
            attitudes = _continuous(run.quaternion[good])
            return Motion(f"the run {run.source}", run.t[good], run.position[good], attitudes, run.phi[good], True)
    if programme is not None:
        t = np.linspace(0.0, programme.span, (PERIOD_ROWS if programme.periodic else ROWS) + 1)
        phi = programme.at(t).phi
        whole = "one period" if programme.periodic else "the whole"
        if material.motion is not None:
            position, turns = _required_poses(material.stand, material.motion.at(t, programme.bias).q)
            words = f"{whole} of the programme {material.programme_file}, with the motion it requires of the carrier"
            return Motion(words, t, position, _quaternions(turns), phi, True)
        words = (
            f"{whole} of the programme {material.programme_file}, in a carrier drawn at rest: --motion, or a run "
            "by --run, says how it moves"
        )
        return _still(material.stand, words, t, phi)
    why = "no run was given (mahovik simulate makes one, --run shows it)"
    if run is not None:
        why = f"the run {run.source} has less than two rows"
    if not N:
        return _still(
            material.stand, f"the stand at rest: it has no flywheels, and {why}", np.array([0.0, 1.0]), np.zeros((2, 0))
        )
    speeds = np.array([row.speed for row in summarize(material.stand).unbalance])
    t = np.array([0.0, TURNS * 2 * np.pi / float(speeds.min())])
    words = f"flywheels at constant speed, those of the table of bodies, in a carrier drawn at rest: {why}"
    return _still(material.stand, words, t, np.outer(t, speeds))


def _required_poses(stand: Stand, q: Array) -> tuple[Array, Array]:
    """Places of O1 in E0 (M, 3; m) and attitudes (M, 3, 3) of rows q of a required motion."""
    if stand.hold is None:
        return q[:, :3], np.array([attitude(stand.angles, *row[3:]) for row in q])
    turns, position = held_pose(stand, q)
    return position, turns


def thin_motion(motion: Motion, most: int) -> tuple[Motion, str]:
    """At most about `most` rows, and what was left out in words.

    Every k-th row of the whole; where that would lose the motion between the rows, fewer are skipped and only the end
    is kept.
    """
    M = len(motion.t)
    step = -(-M // most)
    if step == 1:
        return motion, ""
    while True:
        start = max(0, M - 1 - step * ((M - 1) // step if most * step >= M else most - 1))
        found = motion.rows(start, step)
        if step == 1 or _follows(motion, found, start):
            break
        step //= 2
    words = f"every {step}th row" if step > 3 else ("every row", "every other row", "every third row")[step - 1]
    if start >= step:
        words += f" of the end, from {found.t[0]:.4g} s on"
    return found, words


def _follows(motion: Motion, thin: Motion, start: int) -> bool:
    """Whether straight lines between the rows of `thin` keep to the motion from row `start` on."""
    t = motion.t[start:]

    def error(whole: Array, few: Array) -> Array:
        between = np.stack([np.interp(t, thin.t, few[:, i]) for i in range(few.shape[1])], axis=1)
        return np.asarray(np.abs(between - whole[start:]).max(axis=0, initial=0.0))

    for whole, few in ((motion.position, thin.position), (motion.quaternion, thin.quaternion)):
        span = float(np.ptp(whole[start:], axis=0).max())
        if float(error(whole, few).max()) > STRAIGHT * span:
            return False
    return bool((error(motion.phi, thin.phi) <= PHASE).all()) if motion.phi.shape[1] else True


def _still(stand: Stand, words: str, t: Array, phi: Array) -> Motion:
    """The carrier at rest: aligned with E0, or in the home pose of its hold."""
    at = home(stand)
    position, quaternion = (np.tile(np.array(each), (len(t), 1)) for each in (at.position, at.quaternion))
    return Motion(words, t, position, quaternion, phi, False)


def _continuous(quaternion: Array) -> Array:
    """The same attitudes without leaps from q to -q."""
    leaps = np.sum(quaternion[1:] * quaternion[:-1], axis=1) < 0.0
    return np.asarray(quaternion * np.cumprod(np.append(1.0, np.where(leaps, -1.0, 1.0)))[:, None])


def _quaternions(C: Array) -> Array:
    """Unit quaternions (M, 4), w first, of rotations (M, 3, 3)."""
    from scipy.spatial.transform import Rotation

    found: Array = Rotation.from_matrix(C).as_quat()[:, [3, 0, 1, 2]]
    return found
