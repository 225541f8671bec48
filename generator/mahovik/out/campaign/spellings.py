"""Other spellings of a campaign file's keys: short names, and arrays of tables in the place of tables by name."""

from __future__ import annotations

import re
from typing import Any

from mahovik.core.stand.problems import Problems
from mahovik.core.stand.units import show

DESIGNS = {
    "monte-carlo": "random", "latin-hypercube": "latin", "sobol-indices": "saltelli",
}  # fmt: skip
"""Names of designs, and what they are called in a file otherwise."""


_WHAT = re.compile(r"([A-Za-z]+)[ _]+(\w[\w ]*)")
"""A statistic and its signal."""


def usual(document: dict[str, Any], problems: Problems) -> dict[str, Any]:
    """The document in its usual spelling: `[over]` is `[run]`, and each `[[quantity]]` a key of `[quantities]`."""
    found = dict(document)
    if isinstance(found.get("design"), str):
        found["design"] = DESIGNS.get(found["design"], found["design"])
    for other, key in (("over", "run"), ("quantity", "quantities")):
        if other in found and key in found:
            problems.add(other, f"another spelling of {key}, which the file has too")
    if "over" in found:
        found.setdefault("run", found.pop("over"))
        found.pop("over", None)
    if "quantity" in found:
        given = found.pop("quantity")
        tables = _by_name(given, problems)
        found.setdefault("quantities", tables)
    return found


def _by_name(given: Any, problems: Problems) -> dict[str, Any]:
    """`[[quantity]]` with `name`, and `what = "rms acceleration"` for `rms = "acceleration"`."""
    found: dict[str, Any] = {}
    if not isinstance(given, list) or not all(isinstance(each, dict) for each in given):
        problems.add("quantity", f"expected an array of tables, [[quantity]], found {show(given)}")
        return found
    for i, each in enumerate(given):
        table = dict(each)
        name, what = table.pop("name", None), table.pop("what", None)
        if not isinstance(name, str) or name in found:
            problems.add(f"quantity[{i}]", "name", "expected a name of its own" if name is None or name in found
                         else f"expected a string, found {show(name)}")  # fmt: skip
            continue
        if what is not None:
            parted = _WHAT.fullmatch(what.strip()) if isinstance(what, str) else None
            if parted is None:
                problems.add(
                    f"quantity {show(name)}", "what", f'expected such as "rms acceleration", found {show(what)}'
                )
                continue
            table[parted[1].lower()] = parted[2].replace(" ", "_")
        found[name] = table
    return found
