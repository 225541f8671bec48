"""docs/commands.md agrees with the --help texts of the commands."""

from __future__ import annotations

import commands_page


def test_the_page_is_current() -> None:
    """`make commands-page` rewrites it."""
    assert commands_page.PAGE.read_text(encoding="utf-8") == commands_page.text()


def test_every_command_has_a_heading() -> None:
    text = commands_page.text()
    for name in ("new", "verify", "export", "export target", "simulate"):
        assert f"\n### mahovik {name}\n" in text
