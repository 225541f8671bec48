"""The generator writes the same bytes in every process: no hash seed, folder, locale, time zone or processor counts."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from mahovik import stands as examples

DELIVERY = """
import sys
from mahovik.contract.functions import ALL
from mahovik.core.emit.delivery import ADDITIONS, delivery
from mahovik.core.stand import load
for text in delivery(load(sys.argv[1]), "double", ALL, tuple(ADDITIONS)).values():
    sys.stdout.buffer.write(text.encode("ascii"))
"""
LOOP = """
import sys
from mahovik.core.stand import load
from mahovik.out.export.project import attitude_sources
from mahovik.use.control.attitude import LoopOptions
for text in attitude_sources(load(sys.argv[1]), LoopOptions(), "double").files.values():
    sys.stdout.buffer.write(text.encode("ascii"))
"""
WORLDS = (
    {"PYTHONHASHSEED": "1", "TZ": "Asia/Tokyo", "LC_ALL": "C", "HOME": "/", "OPENBLAS_CORETYPE": "Prescott"},
    {"PYTHONHASHSEED": "4711", "LC_ALL": "tr_TR.UTF-8", "PYTHONUTF8": "0", "OPENBLAS_CORETYPE": "SkylakeX"},
)
"""OpenBLAS sums in another order on each kind of processor; what is designed with it is rounded before it is C."""


@pytest.mark.slow
@pytest.mark.parametrize(("script", "name"), [(DELIVERY, "demo3"), (DELIVERY, "auv6"), (LOOP, "eye4"), (LOOP, "sat4")])
def test_two_processes_write_the_same_bytes(script: str, name: str, tmp_path: Path) -> None:
    """The stand file is named by relative paths of different lengths: no path may be in the text."""
    texts = []
    for number, world in enumerate(WORLDS):
        folder = tmp_path / ("deep/" * number) / "here"
        folder.mkdir(parents=True)
        file = folder / f"stand{number}.toml"
        file.write_bytes(examples.path(name).read_bytes())
        command = [sys.executable, "-c", script, file.name]
        done = subprocess.run(command, cwd=folder, env=os.environ | world, capture_output=True, check=False)
        assert done.returncode == 0, done.stderr.decode()
        texts.append(done.stdout)
    assert texts[0] == texts[1]
    assert len(texts[0]) > 10_000
