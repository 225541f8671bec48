"""Nanoseconds a state of `Model.forward` beside the same batch C called on arrays that lie ready: docs/python.md.

    python tools/api_speed.py [--print]

`C`: the library's function alone, on arrays made once. `Model`: the whole call, with new results; `by state`: where the
accelerations come as an ordinary array of shape (n, N), which has to be turned.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
from targets_table import processor, version

import mahovik
from marked import put

PAGE = Path(__file__).resolve().parents[1] / "docs" / "python.md"
BEGIN, END = "<!-- speed -->", "<!-- end of speed -->"
COUNTS = (1, 100, 10_000, 1_000_000)
