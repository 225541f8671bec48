"""What docs/campaigns.md shows for clusters: arrays in processes of their own, and Snakemake."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from docs.pages import ROOT, blocks
from mahovik.out.campaign.dataset import status

PAGE = ROOT / "docs" / "campaigns.md"
FILES = {block.file: block.text for block in blocks(PAGE) if block.file}


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A campaign whose folder is prepared, and the files of the page."""
    for name, text in FILES.items():
        (tmp_path / name).write_text(text)
    small = FILES["tolerances.toml"].replace("samples = 2000", "samples = 60\nshard = 6")
    (tmp_path / "tolerances.toml").write_text(small)
    (tmp_path / "bin").mkdir()
    command = tmp_path / "bin" / "mahovik"
    command.write_text(f'#!/bin/sh\nexec {sys.executable} -m mahovik "$@"\n')
    command.chmod(0o755)
    assert run(tmp_path, "mahovik campaign run tolerances.toml -o out --prepare") == "10\n"
    return tmp_path


def run(folder: Path, script: str, **env: str) -> str:
    """Output of a shell script that must succeed."""
    path = f"{folder / 'bin'}{os.pathsep}{os.environ['PATH']}"
    done = subprocess.run(
        ["sh", "-c", script],
        cwd=folder,
        env={**os.environ, "PATH": path, **env},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.mark.slow
def test_a_slurm_array(folder: Path) -> None:
    """One job of the array, as Slurm starts it."""
    said = run(folder, "sh slurm.sh", SLURM_ARRAY_TASK_ID="0")
    assert said.count("6 samples, 0 without quantities") == 10
    assert status(folder / "out").complete
    assert "60 of 60 samples in 10 of 10 shards" in run(folder, "mahovik campaign status out")
