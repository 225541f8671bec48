"""Tables that notebooks show: plain HTML without colours of its own, so that it follows the notebook's."""

from __future__ import annotations

import math
from collections.abc import Sequence
from html import escape

import numpy as np

from mahovik import laws
from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand
from mahovik.core.stand.summary import summarize
from mahovik.out.api.fields import Named, spread

_LEFT = ' style="text-align: left"'


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


def functions(title: str, rows: Sequence[Sequence[str]]) -> str:
    """The functions of a model: name, what it takes, what it gives, and how many states its C takes at once."""
    return table(title.strip("<>"), ["function", "takes", "gives", "how"], rows)


def table(title: str, head: Sequence[str], rows: Sequence[Sequence[str]], note: str = "") -> str:
    """A table under its title; every text is escaped."""
    cells = "".join(f"<th{_LEFT}>{escape(text)}</th>" for text in head)
    body = "".join("<tr>" + "".join(f"<td{_LEFT}>{escape(text)}</td>" for text in row) + "</tr>" for row in rows)
    after = f"<div>{escape(note)}</div>" if note else ""
    return (
        f"<div><strong>{escape(title)}</strong></div>"
        f"<table><thead><tr>{cells}</tr></thead><tbody>{body}</tbody></table>{after}"
    )


def bodies(stand: Stand) -> str:
    """The bodies of a stand with their masses, and the unbalance of its flywheels in workshop units."""
    summary = summarize(stand)
    unbalance = {row.name: row for row in summary.unbalance}
    rows = []
    for row in summary.bodies:
        wheel = unbalance.get(row.name)
        numbers = [f"{wheel.spin_inertia:.4g}", f"{wheel.static:.4g}", f"{wheel.dynamic:.4g}"] if wheel else [""] * 3
        at = ", ".join(f"{x * 1e3:.4g}" for x in row.center_of_mass)
        rows.append([row.name, row.kind, row.mount, f"{row.mass:.4g}", at, *numbers])
    head = [
        "body", "kind", "mount", "mass, kg", "mass centre in E1, mm", "spin inertia, kg m2", "static, g mm",
        "dynamic, g mm2",
    ]  # fmt: skip
    gravity = math.hypot(*stand.gravity)
    parts = [f"{summary.mass:.4g} kg in all", f"gravity {gravity:.4g} m/s2"]
    parts += [words for law in laws.parts("text") if (words := law.short(stand))]
    parts += [f"points {', '.join(p.name for p in stand.points)}"] if stand.points else []
    title = f"{repr(stand).strip('<>')}; physics {identities(stand).physics}"
    return table(title, head, rows, "; ".join(parts))
