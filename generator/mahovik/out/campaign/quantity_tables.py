"""`[[quantity]]` of a campaign file: an array of tables with `name` and `what`, as tables by name."""

from __future__ import annotations

import re
from typing import Any

from mahovik.core.stand.problems import Problems
from mahovik.core.stand.units import show
from mahovik.out.campaign.wanted import STATISTICS

_EXAMPLE = 'expected a statistic and a signal such as "rms acceleration"'


def quantities_by_name(document: dict[str, Any], problems: Problems) -> dict[str, Any]:
    """The document with its quantities by name, and `rms = "acceleration"` for `what = "rms acceleration"`."""
    if "quantity" not in document:
        return document
    given, found = document["quantity"], dict[str, Any]()
    if not isinstance(given, list) or not all(isinstance(each, dict) for each in given):
        problems.add("quantity", f"expected an array of tables, [[quantity]], found {show(given)}")
        given = []
    for i, each in enumerate(given):
        table = dict(each)
        name = table.pop("name", None)
        if name is None:
            problems.add(f"quantity[{i}]", "name", "required, but missing")
        elif not isinstance(name, str):
            problems.add(f"quantity[{i}]", "name", f"expected a string, found {show(name)}")
        elif name in found:
            problems.add(f"quantity[{i}]", "name", f"{show(name)} is the name of another quantity")
        else:
            table = _with_statistic(table, f"quantity {show(name)}", problems)
            if table:
                found[name] = table
    return {**document, "quantity": found}


def _with_statistic(table: dict[str, Any], where: str, problems: Problems) -> dict[str, Any]:
    """The table with a statistic as key; empty where it says none."""
    for key in STATISTICS:
        if key in table:
            problems.add(where, key, f'unknown key; expected what = "{key} {table[key]}"')
            return {}
    if "what" not in table:
        return table
    what = table.pop("what")
    words = re.split(r"[ _]+", what.strip().lower()) if isinstance(what, str) else []
    statistics = [word for word in words if word in STATISTICS]
    if len(statistics) != 1 or len(words) < 2:
        problems.add(where, "what", f"{_EXAMPLE}, a statistic of {', '.join(STATISTICS)}; found {show(what)}")
        return {}
    table[statistics[0]] = "_".join(word for word in words if word not in statistics)
    return table
