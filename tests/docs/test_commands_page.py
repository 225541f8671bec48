"""docs/commands.md is what the commands say of themselves now."""

from __future__ import annotations

from docs.pages import tool


def test_the_page_is_current() -> None:
    """`make commands-page` writes it anew."""
    written = tool("commands_page")
    assert written.PAGE.read_text(encoding="utf-8") == written.text()


def test_every_command_has_a_heading() -> None:
    text = tool("commands_page").text()
    for name in ("new", "verify", "export", "export target", "simulate"):
        assert f"\n### mahovik {name}\n" in text
