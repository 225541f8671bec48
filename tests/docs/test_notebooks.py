"""The gallery of notebooks: without results of anybody's machine, listed on its page, and running to the end."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from docs.pages import ROOT, links

FOLDER = ROOT / "docs" / "notebooks"
NOTEBOOKS = sorted(FOLDER.glob("*.ipynb"))

notebooks = pytest.mark.parametrize("file", NOTEBOOKS, ids=lambda file: file.stem)


def read(file: Path) -> dict[str, Any]:
    found: dict[str, Any] = json.loads(file.read_text(encoding="utf-8"))
    return found


def test_the_gallery_lists_every_notebook() -> None:
    linked = [target for target in links(ROOT / "docs" / "python" / "gallery.md") if "notebooks/" in target]
    assert linked and sorted(linked) == sorted(set(linked))
    assert sorted(target.rpartition("/")[2] for target in linked) == [file.name for file in NOTEBOOKS]


@pytest.mark.slow
@notebooks
def test_a_notebook_runs(file: Path, tmp_path: Path) -> None:
    """The cells run in order in a Python of their own, warn of nothing, and draw a picture."""
    require_picture = "from matplotlib import pyplot; assert pyplot.get_fignums(), 'no picture'"
    code = ["".join(cell["source"]) for cell in read(file)["cells"] if cell["cell_type"] == "code"]
    (tmp_path / "cells.py").write_text("\n".join([*code, require_picture]) + "\n", encoding="utf-8")
    place = {**os.environ, "MPLBACKEND": "Agg"}
    command = [sys.executable, "cells.py"]
    done = subprocess.run(command, cwd=tmp_path, env=place, capture_output=True, text=True, check=False, timeout=300)
    assert done.returncode == 0, done.stderr
    assert "Warning" not in done.stderr
