"""A new law is a folder of four files and a row: here one that goes again with its process."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from mahovik.core.stand import loads
from mahovik.errors import StandError

TESTS = Path(__file__).parents[1]


def test_a_law_is_added_by_its_folder_and_a_row_and_goes_with_them() -> None:
    """It is read, written, drawn, measured with errors, in the C, and judged by both derivations."""
    assert len(list(TESTS.glob("laws/added/tug/[a-z]*.py"))) == 4
    command = [sys.executable, "-m", "laws.with_tug"]
    run = subprocess.run(
        command, capture_output=True, text=True, check=False, timeout=300, env=os.environ | {"PYTHONPATH": str(TESTS)}
    )
    assert (run.stdout.split(), run.stderr) == (["judged"], "")
    with pytest.raises(StandError, match='unknown key "tug"'):
        loads('schema = 1\nname = "a"\n[carrier]\nmass = 1\ninertia = [1, 1, 1]\ntug = { force = [1, 0, 0] }\n')
