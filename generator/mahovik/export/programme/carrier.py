"""What the prescribed motion asks of the flywheels, by the reference: drive torques, and what (12) leaves over."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from mahovik.motion.programme import Angles, Programme
from mahovik.motion.required import RequiredMotion
from mahovik.stand.model import Stand
from mahovik.verify.programme.along import instants
from mahovik.verify.programme.scale import Scale, scale_of

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Prescribed:
    """A stand whose carrier does the required motion of a programme, its mean shifted by the programme's bias."""

    stand: Stand
    motion: RequiredMotion
    programme: Programme

    def torques(self, t: Array) -> Array:
        """Drive torques (M, N; N m) of the programme at the times t (M, s)."""
        course = self.motion.at(t, self.programme.bias)
        return np.array([each.torque() for each in instants(self.stand, course, self.programme.at(t))])

    def residual(self, t: Array, angles: Angles) -> Array:
        """F - K V* - M V - J phi' - I phi'' (M, 6; N, N m) of (12) at the motion and these angles."""
        course = self.motion.at(t, self.programme.bias)
        return np.array([each.residual() for each in instants(self.stand, course, angles)])

    def relative(self, R: Array) -> float:
        """The largest of residuals (M, 6), relative to the required wrench."""
        return max(self._scale.of_wrench(each) for each in R)

    @cached_property
    def _scale(self) -> Scale:
        return scale_of(self.stand, self.motion, self.programme)
