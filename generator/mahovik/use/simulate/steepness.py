"""Length of steps that a torque law needs: a torque that falls steeply with speed acts like a stiff damper."""

from __future__ import annotations

import math

import numpy as np

from mahovik.errors import UsageError
from mahovik.use.simulate.case import Array, Case

BOUND = 0.1
"""Largest (fall of torque by speed) (turning acceleration by torque) dt of a step.

The torque of a step is taken at a speed extrapolated from the previous step. Such a scheme is stable below 1; at 0.1
its error in approaching a speed is a thousandth of the remaining difference.
"""

MOST = 1000
"""Most parts of a step; a law that needs more is refused before the run."""


class Steepness:
    """Parts into which the steps of a case must be cut.

    `mobility`: d phi_ddot / d tau at the present state (N x N, magnitudes, 1/(kg m2)).
    """

    def __init__(self, case: Case) -> None:
        self._regime = case.regime
        self._motors = tuple(s.motor for s in case.stand.flywheels)
        anywhere = np.full(len(self._motors), np.inf)
        self._most = self._regime.steepness(-anywhere, anywhere, self._motors)
        self.matters = bool(np.any(self._most > 0.0))

    def parts(self, h: float, mobility: Array, speeds: Array, rate: Array) -> int:
        """Number of parts of a step of `h` s that begins at these speeds (rad/s), changing at `rate` (rad/s2)."""
        if _parts(h, mobility, self._most) == 1:
            return 1
        reach = 2.0 * h * np.abs(rate)  # steepest slope in the range that the step may reach
        return min(MOST, _parts(h, mobility, self._regime.steepness(speeds - reach, speeds + reach, self._motors)))

    def check(self, h: float, mobility: Array) -> None:
        """Raise UsageError if steps of `h` s need too many parts."""
        parts = _parts(h, mobility, self._most)
        if parts > MOST:
            worst = int(np.argmax(self._most * np.diag(mobility)))
            raise UsageError(
                f"{self._regime.name}: flywheel {self._regime.flywheels[worst].name}: its torque falls by up to "
                f"{self._most[worst]:.3g} N m a rad/s, too steep for steps of {h:.3g} s; expected a wider `band` "
                f"(or `coulomb_speed` of its motor), --dt {h * MOST / parts:.2g}, or --backend scipy"
            )


def _parts(h: float, mobility: Array, falls: Array) -> int:
    fastest = float((mobility * falls).sum(axis=1).max())  # 1/s; upper bound of the eigenvalues
    return max(1, math.ceil(h * fastest / BOUND))
