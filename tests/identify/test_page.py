"""docs/identification.md: its example gives what is shown."""

from __future__ import annotations

import doctest

import pytest

from docs.pages import ROOT


@pytest.mark.slow
def test_the_example_gives_what_is_shown() -> None:
    failed, tried = doctest.testfile(str(ROOT / "docs" / "identification.md"), module_relative=False)
    assert failed == 0 and tried >= 10
