"""Names that no function or class may have: a function is a verb, or a noun for what it returns."""

from __future__ import annotations

import ast
import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]

EVERYWHERE = (
    "across|after|afloat|along|among|apart|around|away|before|beneath|beside|between|beyond|both|by|drawn|each|"
    "gone|heaviness|held|helpers?|kept|known|left|manager|meant|misc|near|off|on|over|said|seen|stuff|taken|told|"
    "turned|utils?|ways|weighed|whose|wishes|within|without"
)
PACKAGE_AND_TOOLS = EVERYWHERE + "|broken|chosen|found|given|heard|hidden|lost|made|met|shown|worn|written"
FOLDERS = {"generator": PACKAGE_AND_TOOLS, "tools": PACKAGE_AND_TOOLS, "tests": EVERYWHERE, "bench": EVERYWHERE}
"""Names that are banned in a folder."""

C_NAMES = ("core/lower/", "core/derive/")
"""Functions here are named like those of the emitted C, or like a formula after an operation."""


def is_property(node: ast.AST) -> bool:
    """A property is read like an attribute, so that it may be called by an adjective."""
    return any(ast.unparse(decorator).endswith("property") for decorator in getattr(node, "decorator_list", ()))


def test_names_are_plain() -> None:
    faults = []
    for folder, banned in FOLDERS.items():
        for path in sorted((ROOT / folder).rglob("*.py")):
            text = path.read_text(encoding="utf-8")
            if re.search(rf"\b(def|class) _?({banned})\b", text) and not any(x in str(path) for x in C_NAMES):
                defined = [n for n in ast.walk(ast.parse(text)) if isinstance(n, ast.FunctionDef | ast.ClassDef)]
                named = [n for n in defined if re.fullmatch(f"_?({banned})", n.name) and not is_property(n)]
                faults += [f"{path.relative_to(ROOT)}:{n.lineno} {n.name}" for n in named]
    assert faults == []
