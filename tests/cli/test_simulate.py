"""mahovik simulate: files, starts, refusals, early ends."""

from __future__ import annotations

import csv
import json
import subprocess
import sys
from pathlib import Path

import pytest

from cli.run import BENCH8, DEMO3, refused, run
from mahovik.writing import probe

SPIN = 'schema = 1\ndefault = { speed = "600 rpm" }\n'


def regime(text: str = SPIN) -> str:
    Path("r.toml").write_text(text)
    return "r.toml"


def columns(name: str) -> dict[str, list[float]]:
    with Path(name).open(encoding="utf-8") as file:
        rows = list(csv.reader(file))
    return {head: [float(row[i]) for row in rows[1:]] for i, head in enumerate(rows[0])}


def test_columns_with_units() -> None:
    result = run("simulate", BENCH8, "--until", "0.01", "--regime", regime(), "-o", "run.csv", "--mounts")
    assert result.exit_code == 0, result.output
    run_columns = columns("run.csv")
    assert (len(run_columns), len(run_columns["t [s]"])) == (100, 11)
    assert list(run_columns)[:8] == ["t [s]", "x [m]", "y [m]", "z [m]", "qw", "qx", "qy", "qz"]
    assert {"v_x [m/s]", "omega_z [rad/s]", "phi w1 [rad]", "phi_dot w8 [rad/s]", "tau w1 [N m]"} <= set(run_columns)
    assert {"mount_X w1 [N]", "mount_N w8 [N m]"} <= set(run_columns)
    assert run_columns["t [s]"][-1] == 0.01
    assert run_columns["mount_K w3 [N m]"] == pytest.approx(run_columns["tau w3 [N m]"], rel=1e-9, abs=1e-12)


def test_starts_from_a_state() -> None:
    Path("s.json").write_text(json.dumps({"V": [1, 0, 0, 0, 0, 0.5], "phi_dot": [10, 20, 30]}))
    run("simulate", DEMO3, "--until", "0.01", "--start", "s.json", "-o", "run.csv")
    run_columns = columns("run.csv")
    assert run_columns["v_x [m/s]"][0] == 1.0
    assert run_columns["phi_dot w2 [rad/s]"] == [20.0] * 11


def test_times_have_units() -> None:
    """The file is the same whether a time is given in ms or as a plain number in s."""
    for output, until, dt, every in (("s.csv", "0.01", "1e-4", "0.002"), ("ms.csv", "10 ms", "100 us", "2ms")):
        result = run("simulate", DEMO3, "--until", until, "--dt", dt, "--every", every, "-o", output)
        assert result.exit_code == 0, result.output
    assert Path("s.csv").read_text() == Path("ms.csv").read_text()
    assert columns("s.csv")["t [s]"] == [0.0, 0.002, 0.004, 0.006, 0.008, 0.01]


def test_a_place_that_cannot_be_written_is_told_before_anything_is_computed(monkeypatch: pytest.MonkeyPatch) -> None:
    def never(*arguments: object) -> None:
        pytest.fail("computed")

    monkeypatch.setattr("mahovik.use.study.rest.rest", never)
    Path("file").write_text("")
    assert "a part of the path is a file" in refused("simulate", DEMO3, "--until", "1", "-o", "file/x/a.csv")
    assert "/proc/a.csv: cannot be written" in refused("simulate", DEMO3, "--until", "1", "-o", "/proc/a.csv")
    probe(Path("new/folder/a.csv"))
    assert sorted(path.name for path in Path().iterdir()) == ["file"]


@pytest.mark.parametrize("moment", ["import", "options"])
def test_ctrl_c_before_the_command_begins(moment: str, work_folder: Path) -> None:
    """The interrupt comes while modules are imported, and while click reads its options."""
    stop = "def stop(*given, **more): raise KeyboardInterrupt\n"
    where = {
        "import": "import builtins; real = builtins.__import__\n"
        "builtins.__import__ = lambda name, *a, **k: stop() if name == 'click' else real(name, *a, **k)\n",
        "options": "import click; click.Group.make_context = stop\n",
    }[moment]
    command = [sys.executable, "-c", f"{stop}{where}from mahovik.__main__ import run\nrun()", "rest", DEMO3]
    done = subprocess.run(command, capture_output=True, text=True, cwd=work_folder, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "error: interrupted; no file is half written\n")


def test_a_motion_that_leaves_its_ranges_keeps_its_rows() -> None:
    wild = regime("schema = 1\ndefault = { torque = 1e6 }\n")
    result = run("simulate", DEMO3, "--until", "1", "--regime", wild, "-o", "a.csv")
    assert result.exit_code == 1
    assert "RANGE" in result.stdout
    assert "what was computed is kept" in result.stdout
    assert len(columns("a.csv")["t [s]"]) >= 1


def test_parquet_holds_what_csv_does() -> None:
    """Values are equal to the last bit, and names and their order are the same."""
    from pyarrow import parquet

    for name in ("run.csv", "run.parquet"):
        result = run("simulate", BENCH8, "--until", "0.01", "--regime", regime(), "-o", name, "--mounts")
        assert result.exit_code == 0, result.output
    table = parquet.read_table("run.parquet").to_pydict()
    expected = {name.partition(" [")[0]: values for name, values in columns("run.csv").items()}
    assert sorted(table) == sorted(expected)
    assert table == expected
    assert len(set(table["tau w1"])) > 5  # numbers with all their digits, not zeros
