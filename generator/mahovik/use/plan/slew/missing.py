"""What flywheels cannot do, in words."""

from __future__ import annotations

import numpy as np

from mahovik.use.plan.array import Array


def missing_words(twist: Array) -> str:
    """No moment about the axis of a twist (6, in E1) on which they do no work; no force along a translation."""
    turns = float(np.linalg.norm(twist[3:])) > 1e-6 * float(np.linalg.norm(twist[:3]))
    part = twist[3:] if turns else twist[:3]
    unit = part / np.linalg.norm(part)
    direction = ", ".join(f"{x:.4g}" for x in np.where(np.abs(unit) > 1e-9, unit, 0.0) + 0.0)
    return f"they give no {'moment about' if turns else 'force along'} ({direction}) of E1"
