"""Array types of planning and of the stages above it. Shapes are in each docstring; M times, N flywheels."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
