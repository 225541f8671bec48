"""Names of programmes in C, so that two of one stand can lie in one image."""

from __future__ import annotations

from mahovik.core.lower.layout import Layout
from mahovik.core.lower.program import lower_layout
from mahovik.core.stand.fields import name_problem
from mahovik.core.stand.model import Stand
from mahovik.errors import UsageError

_BESIDE = frozenset(
    [
        "arrays",
        "batch",
        "default",
        "eva",
        "fuzz",
        "real",
        "record",
        "recorder",
        "selftest",
        "servo",
        "status",
        "tables",
        "trim",
        "wide",
        "word",
    ]
)
"""Words that other files of a stand have after its name."""


def check_name(stand: Stand, layout: Layout, called: str) -> None:
    """Raises UsageError where a programme of that name would have names in C that the stand's C has."""
    problem = name_problem(called)
    if problem is not None:
        raise UsageError(f"name {called}: {problem}")
    program = lower_layout(layout)
    taken = {*_BESIDE, *(f.name for f in program.functions), *(s.name for s in program.structs)}
    bodies = [name.lower() for name in (*(b.name for b in stand.bodies), *(p.name for p in stand.points))]
    for name in sorted(taken) + bodies:
        if name == called.lower() or name.startswith(f"{called.lower()}_"):
            raise UsageError(
                f"name {called}: the C of {stand.name} has {stand.name}_{name}: choose another name, such as lap"
            )
