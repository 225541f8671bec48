"""The generator writes the same bytes in every process: no hash seed, folder, locale, time zone or processor counts."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from mahovik import stands as examples

SCRIPT = """
import sys
from mahovik.core.emit.generate import generate
from mahovik.core.stand import load
for text in generate(load(sys.argv[1])).values():
    sys.stdout.buffer.write(text.encode("ascii"))
"""

WORLDS = (
    {"PYTHONHASHSEED": "1", "TZ": "Asia/Tokyo", "LC_ALL": "C", "HOME": "/"},
    {"PYTHONHASHSEED": "4711", "TZ": "America/Lima", "LC_ALL": "tr_TR.UTF-8", "PYTHONUTF8": "0", "USER": "other"},
)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["demo3", "auv6", "bench8"])
def test_two_processes_write_the_same_bytes(name: str, tmp_path: Path) -> None:
    # by relative paths of different lengths: no path may be in the text
    found = []
    for number, world in enumerate(WORLDS):
        folder = tmp_path / ("deep/" * number) / "here"
        folder.mkdir(parents=True)
        file = folder / f"stand{number}.toml"
        file.write_bytes(examples.path(name).read_bytes())
        done = subprocess.run(
            [sys.executable, "-c", SCRIPT, file.name],
            cwd=folder,
            env=os.environ | world,
            capture_output=True,
            check=False,
        )
        assert done.returncode == 0, done.stderr.decode()
        found.append(done.stdout)
    assert found[0] == found[1]
    assert len(found[0]) > 10_000


DESIGN_SCRIPT = """
import sys
from mahovik.core.stand import load
from mahovik.out.export.attitude import attitude_sources
from mahovik.use.control.attitude import LoopOptions
for text in attitude_sources(load(sys.argv[1]), LoopOptions(), "double").files.values():
    sys.stdout.buffer.write(text.encode("ascii"))
"""


@pytest.mark.slow
@pytest.mark.parametrize("name", ["eye4", "sat4"])
def test_designed_loops_have_the_same_bytes_on_every_processor(name: str) -> None:
    """OpenBLAS sums in another order on each kind of processor; what is designed with it is rounded before it is C."""
    found = set()
    for processor in ("Prescott", "Haswell", "SkylakeX"):
        done = subprocess.run(
            [sys.executable, "-c", DESIGN_SCRIPT, examples.path(name)],
            env=os.environ | {"OPENBLAS_CORETYPE": processor},
            capture_output=True,
            check=False,
        )
        assert done.returncode == 0, done.stderr.decode()
        found.add(done.stdout)
    assert len(found) == 1
    assert len(found.pop()) > 10_000
