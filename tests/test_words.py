"""Names say what they hold: a function is a verb, or a noun for what it returns; a local, the quantity that it has."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]

EVERYWHERE = (
    "across|after|afloat|along|among|apart|around|away|before|beneath|beside|between|beyond|both|by|drawn|"
    "gone|heaviness|held|helpers?|kept|known|left|manager|meant|misc|near|off|on|over|said|seen|stuff|taken|told|"
    "turned|utils?|ways|weighed|wishes|within|without"
)
PACKAGE_AND_TOOLS = EVERYWHERE + "|broken|chosen|heard|hidden|lost|made|met|shown|worn|written"
FOLDERS = {"generator": PACKAGE_AND_TOOLS, "tools": PACKAGE_AND_TOOLS, "tests": EVERYWHERE, "bench": EVERYWHERE}
"""Names that no function or class of a folder has."""

SAY_NOTHING = {"each", "found", "given", "here", "others", "own", "tell", "whose"}
"""Names that no local, parameter or field has, and words that no defined name has. `given` of Hypothesis is imported,
not bound; a test may be named by a sentence."""

CONTRACTS = {
    "core/lower/": {"found", "given", "own"},  # names of the emitted C, whose text stays as it is
    "core/routines/": {"each", "given"},  # the same
    "core/stand/capacity.py": {"each"},  # a key of `check --json`
    "out/export/programme.py": {"given"},  # a key of the exported JSON
    "use/balance/pieces.py": {"each"},  # a key of a file of pieces
}
"""Such names that files of the package have nevertheless."""

C_NAMES = ("core/lower/", "core/derive/")
"""Functions here are named like those of the emitted C, or like a formula after an operation."""


def is_property(node: ast.AST) -> bool:
    """A property is read like an attribute, so that it may be called by an adjective."""
    return any(ast.unparse(decorator).endswith("property") for decorator in getattr(node, "decorator_list", ()))


def names_that_say_nothing(text: str) -> Iterator[tuple[int, str, set[str]]]:
    """Line, name, and words that say nothing of each binding in a text that has some."""
    for node in ast.walk(ast.parse(text)):
        match node:
            case ast.Name(id=name, ctx=ast.Store()) | ast.arg(arg=name) if name in SAY_NOTHING:
                yield node.lineno, name, {name}
            case ast.FunctionDef(name=name) | ast.ClassDef(name=name) if not name.startswith("test_"):
                if words := SAY_NOTHING & {*name.lower().split("_")}:
                    yield node.lineno, name, words


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


def test_names_say_what_they_hold() -> None:
    faults = []
    for folder in FOLDERS:
        for path in sorted((ROOT / folder).rglob("*.py")):
            allowed = set().union(*(names for place, names in CONTRACTS.items() if f"mahovik/{place}" in str(path)))
            for line, name, words in names_that_say_nothing(path.read_text(encoding="utf-8")):
                if words - allowed:
                    faults.append(f"{path.relative_to(ROOT)}:{line} {name}")
    assert faults == []
