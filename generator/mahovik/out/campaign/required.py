"""How far a carrier is from the motion that a programme is to give it, of many samples."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.core.motion.programme import Programme
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.motion.servo import COORDINATES
from mahovik.core.stand.model import Stand
from mahovik.out.campaign.observe import Chunk
from mahovik.out.campaign.pose import Array
from mahovik.proof.reference.rotation import kinematic_matrix
from mahovik.proof.verify.programme.mechanics import Scale, scale_of
from mahovik.use.control.coordinates import coordinates


@dataclass(frozen=True, eq=False)
class Required:
    """The required motion of a stand's carrier under its programme; `scale`: that of errors of all six coordinates."""

    stand: Stand
    motion: RequiredMotion
    programme: Programme
    scale: Scale

    @staticmethod
    def of(stand: Stand, motion: RequiredMotion, programme: Programme) -> Required:
        """For the stand that the programme was planned for."""
        return Required(stand, motion, programme, scale_of(stand, motion, programme))

    def q(self, t: Array) -> Array:
        """Required coordinates (K, 6; m, rad) at times (K), s."""
        inside = t if self.motion.periodic else np.clip(t, 0.0, self.motion.span)
        return np.asarray(self.motion.at(inside, self.programme.bias).q)

    def error(self, at: Chunk, axis: str) -> Array:
        """One coordinate of the error (K, 1, n; m or rad); without an axis the share of all six, as `follow` has it."""
        K, n = len(at.t), at.state.shape[2]
        q = self.q(at.t)
        near = np.repeat(q[:, None, :], n, axis=1).reshape(K * n, 6)
        place, attitude = (np.moveaxis(each, 1, 2).reshape(K * n, -1) for each in (at.position, at.attitude))
        known = np.isfinite(attitude).all(axis=1) & np.isfinite(place).all(axis=1)
        whole = np.full((K * n, 6), np.nan)
        if known.any():
            whole[known] = coordinates(self.stand, place[known], attitude[known], near[known]) - near[known]
        error = np.moveaxis(whole.reshape(K, n, 6), 1, 2)
        if axis:
            i = COORDINATES.index(axis)
            return np.asarray(error[:, i : i + 1])
        root = self._root
        found = np.zeros((K, 1, n))
        for k in range(K):
            A = root @ kinematic_matrix(self.stand.angles, q[k, 3:])
            for row in A:
                part = row[0] * error[k, 0]
                for j in range(1, 6):
                    part = part + row[j] * error[k, j]
                found[k, 0] += part * part
        return np.asarray(np.sqrt(found) / self.scale.amplitude)

    @property
    def _root(self) -> Array:
        """R with R^T R = K0 of the scale."""
        return np.asarray(np.linalg.cholesky(self.scale.K0).T)
