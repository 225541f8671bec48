"""`mahovik campaign`: commands over one small campaign, from the file to the page."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import pytest

from cli.run import refused, run

FILE = """
schema = 1
stand = "shaker2"
samples = 12
shard = 5

[vary]
"carrier.mass" = { tolerance = "1 kg" }

[over]
regime = { default = { speed = "600 rpm" } }
until = "10 ms"
dt = "1 ms"

[[quantity]]
name = "shake"
what = "rms acceleration"
at = "carrier"
"""


@pytest.fixture(scope="module")
def out(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder whose shards are computed by commands, one after the other."""
    folder = tmp_path_factory.mktemp("campaign")
    (folder / "c.toml").write_text(FILE)
    place = folder / "out"
    assert run("campaign", "run", str(folder / "c.toml"), "-o", str(place), "--prepare").output == "3\n"
    assert run("campaign", "status", str(place)).exit_code == 1
    said = run("campaign", "shard", str(place), "2", "0-1").output
    assert [line.partition(",")[0] for line in said.splitlines()] == [
        "shard 2: 2 samples",
        "shard 0: 5 samples",
        "shard 1: 5 samples",
    ]
    return place


def test_status(out: Path) -> None:
    said = run("campaign", "status", str(out))
    assert said.output == "c: 12 of 12 samples in 3 of 3 shards, 0 without quantities\n"
    state = json.loads(run("campaign", "status", str(out), "--json").output)
    assert state["complete"] and state["rows"] == state["samples"] == 12 and state["missing"] == []


def test_merge_and_report(out: Path) -> None:
    assert run("campaign", "merge", str(out), "-o", "all.parquet").output == "all.parquet\n"
    said = run("campaign", "report", str(out), "-o", "page.html", "--worst", "1").output.splitlines()
    assert said[0] == "page.html" and len(said) == 2
    assert run("check", said[1]).exit_code == 0
    assert "-o page.txt: expected a name that ends in .html" in refused(
        "campaign", "report", str(out), "-o", "page.txt"
    )


def test_without_pyarrow_nothing_is_begun(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A line with the command that installs it, and no folder."""
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    (tmp_path / "c.toml").write_text(FILE)
    said = run("campaign", "run", str(tmp_path / "c.toml"), "-o", str(tmp_path / "out"))
    assert said.exit_code == 2
    assert said.stderr == 'error: campaigns need pyarrow: pip install "mahovik[campaign]"\n'
    assert not (tmp_path / "out").exists()
