"""Tables for notebooks: plain HTML without colours of its own, so that it follows the notebook's."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from typing import TYPE_CHECKING

import numpy as np

from mahovik.api.fields import Named, spread

if TYPE_CHECKING:
    from mahovik.api.core import Built


def table(title: str, head: Sequence[str], rows: Sequence[Sequence[str]], note: str = "") -> str:
    """A table with a caption; every text is escaped."""
    cells = "".join(f"<th style='text-align:left'>{escape(text)}</th>" for text in head)
    body = "".join(
        "<tr>" + "".join(f"<td style='text-align:left'>{escape(text)}</td>" for text in row) + "</tr>" for row in rows
    )
    after = f"<div>{escape(note)}</div>" if note else ""
    caption = f"<div><strong>{escape(title)}</strong></div>"
    return f"{caption}<table><thead><tr>{cells}</tr></thead><tbody>{body}</tbody></table>{after}"


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
