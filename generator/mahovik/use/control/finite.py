"""Accuracy of following a finite programme, a slew among them: errors over the whole run, and where it ends.

A periodic motion has steady errors, which `record` measures. A finite one is followed once, from its required state:
what counts besides the largest error is what is left at the end.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from mahovik.core.motion.required import Slew, rows_of
from mahovik.core.stand.coordinates import coordinates_of
from mahovik.proof.verify.programme.mechanics import scale_of
from mahovik.use.control.record import Errors, Following, Record, displacement_shares, following
from mahovik.use.numeric import Array


@dataclass(frozen=True)
class SlewEnd:
    """Where a slew ends: angle (rad) to the demanded attitude or line of sight, largest rate of its angular rows."""

    angle: float
    rate: float


@dataclass(frozen=True, eq=False, kw_only=True)
class Tracking(Errors):
    """Errors over the run of a finite programme; the motion's amplitude is its largest distance from its beginning.

    end        (6): the error at the end
    share_end  that of all six together, as `share`
    slew       where it ends; None: the motion is no slew with rows that turn
    """

    end: Array
    share_end: float
    slew: SlewEnd | None

    def as_json(self) -> Mapping[str, Any]:
        """See Errors."""
        found = {"error_end": self.share_end, **self._object({"end": self.end})}
        return found if self.slew is None else found | {"slew_end": {"angle": self.slew.angle, "rate": self.slew.rate}}


def tracking(record: Record) -> Tracking:
    """Errors of a whole run of a finite programme."""
    wanted = record.reference
    error = record.q - record.required
    scale = scale_of(wanted.stand, wanted.motion, wanted.exact)
    shares = displacement_shares(scale, wanted.stand, record.required, error)
    return Tracking(
        coordinates=coordinates_of(wanted.stand),
        amplitude=np.abs(record.required - record.required[0]).max(axis=0),
        peak=np.abs(error).max(axis=0),
        rms=np.sqrt(np.mean(error**2, axis=0)),
        end=error[-1],
        share=float(shares.max()),
        share_rms=float(np.sqrt(np.mean(shares**2))),
        share_end=float(shares[-1]),
        apart=np.abs(record.apart).max(axis=0),
        slew=None if wanted.motion.slew is None else _slew_end(record, wanted.motion.slew),
    )


def errors_of(record: Record, periods: int) -> Following | Tracking:
    """Errors of a run: of a periodic programme those of its last `periods` periods. Raises CheckError: too short."""
    return following(record, periods) if record.reference.motion.periodic else tracking(record)


def _slew_end(record: Record, slew: Slew) -> SlewEnd | None:
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
    return SlewEnd(angle, float(np.abs(rates).max()))
