"""docs/commands.md is what the commands say of themselves now."""

from __future__ import annotations

import importlib.util
from types import ModuleType

from docs.pages import ROOT


def tool() -> ModuleType:
    spec = importlib.util.spec_from_file_location("commands_page", ROOT / "tools" / "commands_page.py")
    assert spec is not None
    assert spec.loader is not None
    found = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(found)
    return found


def test_the_page_is_current() -> None:
    """`make commands-page` writes it anew."""
    written = tool()
    assert written.PAGE.read_text(encoding="utf-8") == written.text()


def test_every_command_has_a_heading() -> None:
    text = tool().text()
    for name in ("new", "verify", "export", "export target", "simulate"):
        assert f"\n### mahovik {name}\n" in text
