"""How well a carrier follows its programme: the error of each coordinate, and one total.

A periodic motion has steady errors, measured over the last periods. A stand that differs from its file hangs at a
slightly different mean pose, which flywheels cannot correct: they have no mean wrench. So the error is that of the
motion about its mean, and the mean is reported separately. A finite motion, a slew among them, is followed once, from
its required state: there the errors are those of the whole run, and what is left at the end.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from mahovik.core.motion.required import Slew, rows_of
from mahovik.core.stand.coordinates import Coordinates, coordinates_of
from mahovik.errors import CheckError
from mahovik.proof.verify.programme.mechanics import scale_of, twist
from mahovik.use.control.loop import MEASURED, Case, Record
from mahovik.use.numeric.se3 import Array
from mahovik.use.plan.basis import harmonics

HARMONICS = 6
"""Harmonics of the error, at least; more if the motion has more."""

STILL = 1e-9
"""m, rad: a coordinate with a smaller amplitude is held still."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Errors:
    """Errors of following a required motion (all in m and rad), six; of a held carrier one a freedom.

    coordinates  that these are of
    amplitude  (6): of the required motion about its mean; of a finite one the largest distance from its beginning
    peak, rms  (6): of the error
    share, share_rms   largest and root mean square of the error of all six together, by the inertia's norm, as shares
               of the largest of the motion: no choice of units or axes changes them (`Scale` of proof/verify/programme)
    apart      (N): largest distance of the flywheels from the programme, rad
    periods, mean, harmonics   of a periodic programme: periods measured; mean error (6), and its amplitudes at
               harmonics 1..K of the programme (K, 6)
    end, share_end   of a finite one: error at the end (6), and that of all six together
    slew       where a slew ends: `angle` (rad) to the demanded attitude or line of sight, largest `rate` (rad/s) of its
               angular rows
    """

    coordinates: Coordinates
    amplitude: Array
    peak: Array
    rms: Array
    share: float
    share_rms: float
    apart: Array
    periods: int = 0
    mean: Array | None = None
    harmonics: Array | None = None
    end: Array | None = None
    share_end: float | None = None
    slew: Mapping[str, float] | None = None

    def shares(self) -> list[float | None]:
        """Peak errors over each coordinate's own amplitude; None for one that is held still."""
        return [float(p / a) if a > STILL else None for p, a in zip(self.peak, self.amplitude, strict=True)]

    def words(self, case: Case, record: Record, of: str) -> list[str]:
        """How well the carrier follows, in sentences; `of`: the mismatch of the run."""
        names = [s.name for s in case.reference.stand.flywheels]
        furthest, torques = int(np.argmax(self.apart)), np.abs(record.tau).max(axis=0)
        strongest = int(np.argmax(torques))
        about = f"about its mean, over the last {self.periods} of {case.periods} periods"
        if self.end is not None:
            about = f"{100 * (self.share_end or 0.0):.3g} % at the end"
        result = [
            f"error of the carrier {100 * self.share:.3g} % of its amplitude (rms {100 * self.share_rms:.3g} %), "
            f"{about}; {of}",
            f"flywheels: at most {1e3 * self.apart[furthest]:.3g} mrad from the programme ({names[furthest]}); torque "
            f"at most {torques[strongest]:.4g} N m ({names[strongest]}), cut in {record.limited} of {len(record.t)} "
            "samples",
        ]
        if self.slew is not None:
            angle, rate = (math.degrees(self.slew[key]) * 3600 for key in ("angle", "rate"))
            result.append(f"the slew ends {angle:.3g} arcsec from its end, with rates up to {rate:.3g} arcsec/s")
        if case.design is not None:
            result.append(
                f"trim: {record.rounds} rounds; an error falls to {case.design.radius:.3g} per round; the settled "
                f"trim converges while its model is less than {100 * case.design.margin:.3g} % wrong"
            )
        return result


def errors_of(record: Record, periods: int = MEASURED) -> Errors:
    """Errors of a run: of a periodic programme those of its last `periods` periods. Raises CheckError: too short."""
    motion = record.reference.motion
    error = record.q - record.required
    if not motion.periodic:
        shares = _shares(record, record.required, error)
        slew = None if motion.slew is None else _slew_end(record, motion.slew)
        amplitude = np.abs(record.required - record.required[0]).max(axis=0)
        errors = _errors(record, error, amplitude, shares, record.apart)
        return Errors(**errors, end=error[-1], share_end=float(shares[-1]), slew=slew)
    span, step = motion.span, float(record.t[1] - record.t[0]) if len(record.t) > 1 else np.inf
    rows = round(periods * span / step)
    if rows >= len(record.t):
        raise CheckError(f"the run ended at t = {record.t[-1] if len(record.t) else 0:.6g} s, before {periods} periods")
    last = slice(len(record.t) - 1 - rows, len(record.t) - 1)
    required, error = record.required[last], error[last]
    K = max(HARMONICS, *motion.harmonics, 1)
    terms = harmonics(span, 2 * min(K, max(1, round(span / step) // 2 - 1)) + 1, record.t[last]).value
    waves = np.linalg.lstsq(terms, error, rcond=None)[0]  # samples need not divide a period
    error, mean = error - waves[0], waves[0]
    amplitude = np.abs(required - np.linalg.lstsq(terms, required, rcond=None)[0][0]).max(axis=0)
    errors = _errors(record, error, amplitude, _shares(record, required, error), record.apart[last])
    return Errors(**errors, periods=periods, mean=mean, harmonics=np.hypot(waves[1::2], waves[2::2]))


def _errors(record: Record, error: Array, amplitude: Array, shares: Array, apart: Array) -> dict[str, Any]:
    return {
        "coordinates": coordinates_of(record.reference.stand),
        "amplitude": amplitude,
        "peak": np.abs(error).max(axis=0),
        "rms": np.sqrt(np.mean(error**2, axis=0)),
        "share": float(shares.max()),
        "share_rms": float(np.sqrt(np.mean(shares**2))),
        "apart": np.abs(apart).max(axis=0),
    }


def _shares(record: Record, required: Array, error: Array) -> Array:
    """Errors (M, 6; m, rad) of all six coordinates together (M), as shares of the largest of the motion."""
    wanted = record.reference
    moved = [twist(wanted.stand, q, e) for q, e in zip(required, error, strict=True)]
    scale = scale_of(wanted.stand, wanted.motion, wanted.exact)
    return scale.displacement_share(np.array(moved).reshape(-1, 6))


def _slew_end(record: Record, slew: Slew) -> Mapping[str, float] | None:
    if slew.kind == "still":
        return None
    w, x, y, z = record.attitude[-1]
    C = Rotation.from_quat([x, y, z, w]).as_matrix()
    demanded = slew.path(np.array([slew.angle]))[0] @ slew.start
    if slew.kind == "attitude":
        angle = float(Rotation.from_matrix(demanded.T @ C).magnitude())
    else:
        sight, wanted = C @ slew.axis, demanded @ slew.axis
        angle = float(np.arctan2(np.linalg.norm(np.cross(sight, wanted)), sight @ wanted))
    turning = [row.component.startswith("w") for row in slew.task.rows]
    rates = rows_of(record.reference.stand, slew.task)[turning] @ record.V[-1]
    return {"angle": angle, "rate": float(np.abs(rates).max())}
