"""The one array type of the reference: 64-bit floats. Shapes are in each docstring."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
