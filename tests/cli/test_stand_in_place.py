"""A stand file in the place of another file is called by its name; its keys are not listed as unknown."""

from __future__ import annotations

from pathlib import Path

import pytest

from cli.run import BENCH8, DEMO3, refused


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        (("judge", DEMO3, "--fmu", "a.fmu", "--map"), "a map of variables"),
    ],
    ids=lambda value: f"{value[0]} {value[-1]}" if isinstance(value, tuple) else "",
)
def test_one_line_says_that_it_is_a_stand_file(arguments: tuple[str, ...], expected: str) -> None:
    line = f"error: {arguments[-1]} {BENCH8}: this is a stand file, expected {expected}\n"
    assert refused(*arguments, BENCH8) == line
    assert not list(Path.cwd().iterdir())
