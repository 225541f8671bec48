"""How far a carrier is from the motion that a programme is to give it, of many samples."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.core.motion.programme import Programme
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.stand.coordinates import coordinates_of
from mahovik.core.stand.model import Stand
from mahovik.out.campaign.holds import Holds
from mahovik.out.campaign.observe import Chunk
from mahovik.out.campaign.pose import Array, rotation
from mahovik.proof.reference.coordinates import kinematic_matrix
from mahovik.proof.verify.programme.mechanics import Scale, scale_of
from mahovik.use.control.coordinates import coordinates, held_coordinates
from mahovik.use.numeric import Frame


@dataclass(frozen=True, eq=False)
class Required:
    """The required motion of a stand's carrier under its programme; `scale`: that of errors of all coordinates.

    `holds`: of samples that are held at other places; their coordinates count from their own home poses.
    """

    stand: Stand
    motion: RequiredMotion
    programme: Programme
    scale: Scale
    holds: Holds | None = None

    @staticmethod
    def of(stand: Stand, motion: RequiredMotion, programme: Programme) -> Required:
        """For the stand that the programme was planned for."""
        return Required(stand, motion, programme, scale_of(stand, motion, programme))

    def q(self, t: Array) -> Array:
        """Required coordinates (K, 6; m, rad) at times (K), s; of a held carrier those of its freedoms."""
        inside = t if self.motion.periodic else np.clip(t, 0.0, self.motion.span)
        return np.asarray(self.motion.at(inside, self.programme.bias).q)

    def error(self, at: Chunk, axis: str) -> Array:
        """One coordinate of the error (K, 1, n; m or rad); without an axis the share of all, as `follow` has it."""
        K, n = len(at.t), at.state.shape[2]
        q = self.q(at.t)
        m = q.shape[1]
        near = np.repeat(q[:, None, :], n, axis=1).reshape(K * n, m)
        pose = at.position, at.attitude
        if self.holds is not None:
            pose = self.holds.nominal_poses(*pose)
        place, attitude = (np.moveaxis(each, 1, 2).reshape(K * n, -1) for each in pose)
        known = np.isfinite(attitude).all(axis=1) & np.isfinite(place).all(axis=1)
        whole = np.full((K * n, m), np.nan)
        if known.any():
            whole[known] = self._coordinates(place[known], attitude[known], near[known]) - near[known]
        error = np.moveaxis(whole.reshape(K, n, m), 1, 2)
        if axis:
            i = coordinates_of(self.stand).names.index(axis)
            return np.asarray(error[:, i : i + 1])
        found = np.zeros((K, 1, n))
        for k, A in enumerate(self._root @ self._slopes(q)):
            for row in A:
                part = row[0] * error[k, 0]
                for j in range(1, m):
                    part = part + row[j] * error[k, j]
                found[k, 0] += part * part
        return np.asarray(np.sqrt(found) / self.scale.amplitude)

    def _coordinates(self, place: Array, attitude: Array, near: Array) -> Array:
        """q (M, 6, of a held carrier m) of positions (M, 3; m) and quaternions (M, 4) near others."""
        if self.stand.hold is None:
            return coordinates(self.stand, place, attitude, near)
        return held_coordinates(self.stand, place, np.moveaxis(rotation(attitude.T), -1, 0), near)

    def _slopes(self, q: Array) -> Array:
        """A of V = A q' (K, 6, 6, of a held carrier K, 6, m) at coordinates."""
        if self.stand.hold is None:
            return np.array([kinematic_matrix(self.stand.angles, each[3:]) for each in q])
        return Frame.of(self.stand).slopes(q)[2]

    @property
    def _root(self) -> Array:
        """R with R^T R = K0 of the scale."""
        return np.asarray(np.linalg.cholesky(self.scale.K0).T)
