"""docs/other-programs.md names every option of import."""

from __future__ import annotations

from docs.pages import ROOT

PAGE = ROOT / "docs" / "other-programs.md"


def test_every_option_is_on_the_page() -> None:
    from mahovik.out.cli.import_model import import_model

    text = PAGE.read_text()
    for command in import_model.commands.values():
        assert f"mahovik import {command.name} " in text
        for parameter in command.params:
            assert any(option in text for option in parameter.opts if option.startswith("-")) or not parameter.opts[
                0
            ].startswith("-")
