"""The motion that a report animates: of a run, else of a programme, else flywheels at constant speed."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.summary import summarize
from mahovik.out.report.stand.material import Material
from mahovik.proof.reference.rotation import attitude

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
            q = material.motion.at(t, programme.bias).q
            turns = np.array([attitude(material.stand.angles, *row[3:]) for row in q])
            words = f"{whole} of the programme {material.programme_file}, with the motion it requires of the carrier"
            return Motion(words, t, q[:, :3], _quaternions(turns), phi, True)
        words = (
            f"{whole} of the programme {material.programme_file}, in a carrier drawn at rest: --motion, or a run "
            "by --run, says how it moves"
        )
        return _still(words, t, phi)
    why = "no run was given (mahovik simulate makes one, --run shows it)"
    if run is not None:
        why = f"the run {run.source} has less than two rows"
    if not N:
        return _still(f"the stand at rest: it has no flywheels, and {why}", np.array([0.0, 1.0]), np.zeros((2, 0)))
    speeds = np.array([row.speed for row in summarize(material.stand).unbalance])
    t = np.array([0.0, TURNS * 2 * np.pi / float(speeds.min())])
    words = f"flywheels at constant speed, those of the table of bodies, in a carrier drawn at rest: {why}"
    return _still(words, t, np.outer(t, speeds))


def thinned(motion: Motion, most: int) -> tuple[Motion, str]:
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


def _still(words: str, t: Array, phi: Array) -> Motion:
    quaternion = np.tile([1.0, 0.0, 0.0, 0.0], (len(t), 1))
    return Motion(words, t, np.zeros((len(t), 3)), quaternion, phi, False)


def _continuous(quaternion: Array) -> Array:
    """The same attitudes without leaps from q to -q."""
    leaps = np.sum(quaternion[1:] * quaternion[:-1], axis=1) < 0.0
    return np.asarray(quaternion * np.cumprod(np.append(1.0, np.where(leaps, -1.0, 1.0)))[:, None])


def _quaternions(C: Array) -> Array:
    """Unit quaternions (M, 4), w first, of rotations (M, 3, 3)."""
    from scipy.spatial.transform import Rotation

    found: Array = Rotation.from_matrix(C).as_quat()[:, [3, 0, 1, 2]]
    return found
