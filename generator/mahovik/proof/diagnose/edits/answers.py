"""Changes of what is answered."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from mahovik.proof.diagnose.fault import Case, Edit
from mahovik.proof.reference.array import Array, Values
from mahovik.proof.reference.bodies import Spinning
from mahovik.proof.reference.pieces import Pieces


def value(name: str, change: Callable[[Any, Values, Pieces, Case], Any]) -> Edit:
    """One value; `change` takes the right one, all values of the want, the pieces and the case."""

    def edit(values: Values, at: Pieces, case: Case) -> Values:
        return {**values, name: change(values[name], values, at, case)} if name in values else values

    return Edit("values", edit)


def values(want: str, change: Callable[[Values, Pieces, Case], Values]) -> Edit:
    """All values of a want."""
    return Edit("values", lambda right, at, case: change(right, at, case) if case.want == want else right)


def mount_wrench(change: Callable[[Array, Spinning], Array]) -> Edit:
    """The mount wrench (6) of a flywheel."""

    def edit(right: Array, values: Values, at: Pieces, case: Case) -> Array:
        rows = [change(row, s) if case.wrong(s.body) else row for row, s in zip(right, at.flywheels, strict=True)]
        return np.array(rows).reshape(-1, 6)

    return value("mount_wrench", edit)
