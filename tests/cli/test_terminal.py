"""Colours, and the width of terminals: what the environment asks for, on terminals and in pipes."""

from __future__ import annotations

import re
from typing import Any

import pytest

from cli.run import AUV6, DEMO3
from cli.terminal import TerminalOutput, on_terminal
from mahovik.stands import path
from toolchain.quick import quick

SAT4 = str(path("sat4"))
TABLES = {
    "check": ("check", AUV6),
    "modes": ("modes", SAT4),
    "judge": ("judge", DEMO3, "--with", "cat", "--states", "2"),
}


def words(seen: TerminalOutput) -> str:
    """All that is said, whatever the width: without blanks and lines of boxes."""
    return re.sub(r"[\s─-]", "", "\n".join(seen.lines))


@pytest.mark.parametrize("columns", quick(1, [40, 80]))
@pytest.mark.parametrize("arguments", TABLES.values(), ids=TABLES)
def test_no_line_is_longer_than_the_terminal(arguments: tuple[str, ...], columns: int) -> None:
    seen = on_terminal(*arguments, columns=columns, piped=False)
    complaints = [line for line in seen.lines if line.startswith(("error:", "warning:"))]
    assert all(len(line.rstrip()) <= columns for line in seen.lines if line not in complaints)


def test_a_narrow_terminal_folds_and_never_cuts() -> None:
    narrow, wide = (on_terminal("check", DEMO3, columns=columns) for columns in (40, 200))
    assert "…" not in narrow.screen
    assert sorted(words(narrow)) == sorted(words(wide))


@pytest.mark.parametrize(
    ("env", "coloured"),
    quick(
        2,
        [
            ({}, True),
            ({"NO_COLOR": "1", "FORCE_COLOR": "1"}, False),
            ({"NO_COLOR": "1"}, False),
            ({"TERM": "dumb"}, False),
        ],
    ),
)
def test_colours_on_a_terminal(env: dict[str, Any], coloured: bool) -> None:
    """The warning of auv6 is yellow."""
    seen = on_terminal("check", AUV6, **env)
    assert "warning:" in seen.screen
    assert seen.colours == coloured
