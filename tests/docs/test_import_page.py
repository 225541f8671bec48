"""The example of docs/import.md gives what the page shows."""

from __future__ import annotations

from pathlib import Path

import pytest

from cli.run import run
from docs.pages import ROOT, blocks

PAGE = ROOT / "docs" / "import.md"


def test_the_example(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (model,) = (b.text for b in blocks(PAGE) if b.language == "xml")
    (shown,) = (b.text for b in blocks(PAGE) if b.text.startswith("$ mahovik"))
    Path("sat.urdf").write_text(model)
    command, _, printed = shown.partition("\n")
    said = run(*command.removeprefix("$ mahovik ").split()).output
    assert said.startswith(printed)
    (last,) = said.removeprefix(printed).splitlines()
    assert last.startswith("agrees with the original in Pinocchio")


def test_every_option_is_on_the_page() -> None:
    from mahovik.cli.import_model import import_model

    text = PAGE.read_text()
    for command in import_model.commands.values():
        assert f"mahovik import {command.name} " in text
        for parameter in command.params:
            assert any(option in text for option in parameter.opts if option.startswith("-")) or not parameter.opts[
                0
            ].startswith("-")
