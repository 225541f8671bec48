"""Hash of the code that a result depends on. Comments, docstrings and layout of Python do not change it."""

from __future__ import annotations

import ast
import hashlib
import io
import tokenize
from collections.abc import Iterable
from functools import cache
from pathlib import Path

from campaign import ROOT

PACKAGE = "generator/mahovik"
COMMON = ("contract", "core", "laws", "stands", "errors.py", "templates")
"""Every campaign depends on these: the equations, the C made of them, the example stands."""

PAGES = (
    *("templates/delivery.md.j2", "templates/derive", "templates/evidence", "templates/report", "templates/uplot/"),
    "generator/mahovik/core/emit/readme.py",
)
"""Beginnings of the paths of what is there to be read only, and changes no figure."""

SUFFIXES = (".py", ".toml", ".json", ".j2", ".c", ".h")
LENGTH = 16


def files_of(parts: Iterable[str]) -> list[Path]:
    """The source files of `parts`, sorted: folders or files of the package, of tools/, or of the repository's root.

    Raises SystemExit: a part that is not there.
    """
    found: set[Path] = set()
    for part in parts:
        place = next((p for p in (ROOT / PACKAGE / part, ROOT / "tools" / part, ROOT / part) if p.exists()), None)
        if place is None:
            raise SystemExit(f"{part}: no such code; expected a folder or file of {PACKAGE}, tools or the root")
        inside = place.rglob("*") if place.is_dir() else [place]
        found |= {path for path in inside if path.suffix in SUFFIXES and not _is_page(path)}
    return sorted(found)


def _is_page(path: Path) -> bool:
    return path.relative_to(ROOT).as_posix().startswith(PAGES)


def code_hash(parts: Iterable[str]) -> str:
    """Hash of the files of `parts` and of COMMON, by name and meaning."""
    total = hashlib.sha256()
    for path in files_of((*COMMON, *parts)):
        total.update(f"{path.relative_to(ROOT).as_posix()} {_digest(path)}\n".encode())
    return total.hexdigest()[:LENGTH]


@cache
def _digest(path: Path) -> str:
    text = path.read_text(encoding="utf-8")
    return hashlib.sha256((meaning(text) if path.suffix == ".py" else text).encode()).hexdigest()


def meaning(source: str) -> str:
    """Python without comments, docstrings, blank lines and spaces at the end of a line."""
    lines = source.splitlines()
    for node in _docstrings(ast.parse(source)):
        last = node.end_lineno or node.lineno
        lines[node.lineno - 1 : last] = [""] * (last - node.lineno + 1)
    if "#" in source:
        # by places alone: what else a token holds differs between versions of Python
        for token in tokenize.generate_tokens(io.StringIO(source).readline):
            if token.type == tokenize.COMMENT:
                row, column = token.start
                lines[row - 1] = lines[row - 1][:column]
    return "\n".join(line.rstrip() for line in lines if line.strip())


def _docstrings(tree: ast.Module) -> Iterable[ast.expr]:
    """Strings that stand alone as a statement: docstrings, and those of attributes."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant) and isinstance(node.value.value, str):
            yield node.value
