"""The one array type of planning: 64-bit floats. Shapes are in each docstring; M times, N flywheels."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
