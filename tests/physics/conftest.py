"""A failing property shows the smallest stand it was shrunk to, as a stand file."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from mahovik.core.stand import Stand, State, dumps
from mahovik.proof.verify.states import Request, state_line

Shown = Callable[[Stand, State], None]


@pytest.fixture(scope="session")
def shown(tmp_path_factory: pytest.TempPathFactory) -> Shown:
    """Writes a stand and its state into files, and has hypothesis print path and text with a failure."""
    folder = tmp_path_factory.mktemp("smallest")

    def show(stand: Stand, state: State) -> None:
        from hypothesis import note

        file, text = folder / "stand.toml", dumps(stand)
        file.write_text(text, encoding="utf-8")
        line = state_line(Request("smallest", state, ("matrices",)))
        (folder / "state.jsonl").write_text(line + "\n", encoding="utf-8")
        note(f"stand file {file}, state beside it:\n{text}\n{line}")

    return show
