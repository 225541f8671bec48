"""What notebooks show of states, results and models."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from mahovik.core.stand.notebook import table
from mahovik.out.api.fields import Named, spread

if TYPE_CHECKING:
    from mahovik.out.api.core import Built


def arrays(title: str, named: Named) -> str:
    """Arrays with shape, unit, meaning; a single state's numbers, the range of many."""
    found = named.to_dict()
    rows = []
    for f in named.fields:
        a = found[f.name]
        values = [f"{x:.5g}" for x in np.ravel(a)] if a.size <= 12 and named.batch is None else [spread(a)]
        rows.append([f.name, " × ".join(map(str, a.shape)) or "number", f.unit, ", ".join(values), f.meaning])
    status = getattr(named, "status", None)
    note = ""
    if status is not None:
        refused = int(np.count_nonzero(np.asarray(status) < 0))
        note = f"{refused} of {np.size(status)} refused: NaN" if refused else ""
    return table(title.strip("<>"), ["name", "shape", "unit", "values", "meaning"], rows, note)


def model(of: Built) -> str:
    """The functions of a model."""
    rows = [
        [f.name, ", ".join(f.takes), ", ".join(f.gives), "batch C" if f.wide else "C, state by state"]
        for f in of.functions
    ]
    return table(repr(of).strip("<>"), ["function", "takes", "gives", "how"], rows)
