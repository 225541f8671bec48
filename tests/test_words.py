"""Plain English, as far as a program can see it: openings of docstrings, and phrases that nobody uses elsewhere."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).resolve().parents[1]

PENDING: tuple[str, ...] = (
    "generator/mahovik/core/derive/",
    "tests/",
    "tools/",
    "templates/",
    "docs/",
)
"""Beginnings of paths that are not held to the rules yet. Strike out a folder once it passes; add none."""

OPENINGS = (
    r"Of\b",
    r"By\b",
    r"As\b",
    r"It;",
    r"So many\b",
    r"Whose\b",
    r"Which\b",
    r"Than\b",
    r"And\b",
    r"Those\b",
    r"In turn\b",
    r"(What|All that|Where|Who)\b.* (has|have|is|are|does|do) not\b(?! \w+ed\b)",
    r"How .* (is|are) (called|named|said|told|spelt)\b",
    r"(At|In|On|To|For|From|With|Without|Whether|Per) ?\w*\.$",
)
"""Ways in which a docstring must not begin: it says what the thing is or does, with a subject or a verb."""

PHRASES = (
    r"(?<!who )(?<!which )\b(has|have|had) not\b(?! (yet|been|only|changed|to)\b)(?! \w+(ed|en|un|ad|et)\b)",
    r"\b(is|are|was|were|be) told\b",
    r"\b(goes|go|knows|know|acts|lies|takes|gives|makes|holds|says|fits|comes|stands|needs|sees|reads|moves) not\b",
    r"\beach (second|third|fourth|fifth|sixth|eighth|tenth)\b",
    r"\bthat (are|is) there\b",
    r"\bof the clock\b",
    r"\bby heart\b",
    r"\bby Ctrl-C\b",
    r"\bsays? of (it|them)sel(f|ves)\b",
    r"\bso many (as|from|of)\b",
    r"\b(is|are|was|were) (not )?meant by\b",
    r"\bas soon as it is through\b",
    r"\bWho else\b",
    r"\bof our own\b",
    r"\bnames what is\b",
    r"\b(thereof|therein|wherein|whereof|anew|naught|nought|ere|whence|thence|hither|thither)\b",
)
"""Phrases of nobody's English but a poet's; the usual words say the same."""

SOURCES = sorted(
    path
    for pattern in ("generator/**/*.py", "tests/**/*.py", "tools/**/*.py", "templates/**/*.*", "docs/**/*.md")
    for path in REPOSITORY.glob(pattern)
    if path != Path(__file__) and "old_release" not in path.parts
)


def name_of(path: Path) -> str:
    """Path of a file from the root of the repository."""
    return path.relative_to(REPOSITORY).as_posix()


def docstrings(text: str) -> Iterator[tuple[int, str]]:
    """Line and text of every docstring: of modules, classes, functions, and of values (a string after the value)."""
    bodies = (getattr(node, "body", None) for node in ast.walk(ast.parse(text)))
    for statement in (each for body in bodies if isinstance(body, list) for each in body):
        value = statement.value if isinstance(statement, ast.Expr) else None
        if isinstance(value, ast.Constant) and isinstance(value.value, str):
            yield value.lineno, value.value


def faults(path: Path) -> list[str]:
    """Breaches of the rules in one file: line, and the words."""
    text = path.read_text()
    found = []
    if path.suffix == ".py":
        for line, docstring in docstrings(text):
            first = docstring.strip().partition("\n")[0]
            found += [f"{line}: opens with {first!r}" for rule in OPENINGS if re.match(rule, first)]
    for line, words in enumerate(text.splitlines(), 1):
        found += [f"{line}: {hit.group()!r}" for rule in PHRASES for hit in re.finditer(rule, words, re.IGNORECASE)]
    return found


@pytest.mark.parametrize("path", [p for p in SOURCES if not name_of(p).startswith(PENDING)], ids=name_of)
def test_plain_english(path: Path) -> None:
    assert faults(path) == []


def test_nothing_pending_is_already_plain() -> None:
    """A folder that passes is struck out of the list of those that wait."""
    for beginning in PENDING:
        waiting = [path for path in SOURCES if name_of(path).startswith(beginning)]
        assert any(faults(path) for path in waiting), f"{beginning} can be struck out of PENDING"
