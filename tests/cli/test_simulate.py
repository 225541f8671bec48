"""mahovik simulate: files, starts, refusals, early ends."""

from __future__ import annotations

import csv
import importlib
import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from cli.run import BENCH8, DEMO3, process, refused, run
from mahovik.errors import StateError
from mahovik.stands import path
from mahovik.use.simulate import run as runs
from mahovik.use.simulate.case import Moment
from mahovik.writing import probe, write_all

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
    assert result.stdout == "run.csv   11 rows, 100 columns\n"
    found = columns("run.csv")
    assert list(found)[:8] == ["t [s]", "x [m]", "y [m]", "z [m]", "qw", "qx", "qy", "qz"]
    assert {"v_x [m/s]", "omega_z [rad/s]", "phi w1 [rad]", "phi_dot w8 [rad/s]", "tau w1 [N m]"} <= set(found)
    assert {"mount_X w1 [N]", "mount_N w8 [N m]"} <= set(found)
    assert found["t [s]"][-1] == 0.01
    assert found["mount_K w3 [N m]"] == pytest.approx(found["tau w3 [N m]"], rel=1e-9, abs=1e-12)


def test_without_a_regime_a_stand_stays_at_rest() -> None:
    run("simulate", BENCH8, "--until", "0.05", "--every", "0.01", "--dt", "0.001", "-o", "run.csv")
    found = columns("run.csv")
    for name in ("v_x [m/s]", "v_z [m/s]", "omega_x [rad/s]", "phi_dot w1 [rad/s]"):
        assert max(map(abs, found[name])) < 1e-12


@pytest.mark.slow
def test_points_are_read_and_scipy_agrees() -> None:
    stand = str(path("auv6"))
    for backend in ("c", "scipy"):
        result = run(
            "simulate", stand, "--until", "0.02", "--every", "0.01", "--regime", regime(), "--backend", backend,
            "-o", f"{backend}.csv",
        )  # fmt: skip
        assert result.exit_code == 0, result.output
    c, scipy = columns("c.csv"), columns("scipy.csv")
    assert {"force_z sonar [m/s2]", "gyro_x sonar [rad/s]"} <= set(c)
    for name, values in c.items():
        assert values == pytest.approx(scipy[name], rel=1e-6, abs=1e-8)


def test_starts_from_a_state_and_from_what_rest_prints() -> None:
    Path("s.json").write_text(json.dumps({"V": [1, 0, 0, 0, 0, 0.5], "phi_dot": [10, 20, 30]}))
    run("simulate", DEMO3, "--until", "0.01", "--start", "s.json", "-o", "run.csv")
    found = columns("run.csv")
    assert found["v_x [m/s]"][0] == 1.0
    assert found["phi_dot w2 [rad/s]"] == [20.0] * 11
    Path("rest.json").write_text(run("rest", BENCH8, "--json").stdout)
    result = run("simulate", BENCH8, "--until", "0.01", "--start", "rest.json", "-o", "run.csv")
    assert result.exit_code == 0, result.output
    assert max(map(abs, columns("run.csv")["v_z [m/s]"])) < 1e-12


def test_times_have_units() -> None:
    """The same file, whether a time is in ms or a plain number in s."""
    for output, until, dt, every in (("s.csv", "0.01", "1e-4", "0.002"), ("ms.csv", "10 ms", "100 us", "2ms")):
        result = run("simulate", DEMO3, "--until", until, "--dt", dt, "--every", every, "-o", output)
        assert result.exit_code == 0, result.output
    assert Path("s.csv").read_text() == Path("ms.csv").read_text()
    assert columns("s.csv")["t [s]"] == [0.0, 0.002, 0.004, 0.006, 0.008, 0.01]


@pytest.mark.slow
def test_motors_that_fall_short_are_told() -> None:
    text = Path(BENCH8).read_text() + "\n[flywheel.motor]\ntorque = 0.001\n"
    Path("weak.toml").write_text(text)
    ramp = "schema = 1\ndefault = { ramp = { to = 100, duration = 0.01 } }\n"
    result = run("simulate", "weak.toml", "--until", "0.01", "--regime", regime(ramp), "-o", "run.csv")
    assert result.exit_code == 0
    assert "motor of w8: cannot give the torque of its law" in result.stdout
    assert min(columns("run.csv")["margin w8 [N m]"]) < 0.0


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--until", "0", "-o", "a.csv"), "--until 0: expected a time above 0"),
        (("--until", "nan", "-o", "a.csv"), '--until nan: expected a time, as "10 ms"'),
        (("--until", "1m", "-o", "a.csv"), '--until 1m: unit "m" does not fit, expected a time (s)'),
        (("--until", "1", "--dt", "1 2", "-o", "a.csv"), "--dt 1 2: expected a time"),
        (("--until", "1", "--dt", "0", "-o", "a.csv"), "--dt 0: expected a time above 0"),
        (("--until", "100", "--dt", "20", "-o", "a.csv"), "--dt 20: expected at most 10 s"),
        (("--until", "1", "-o", "/proc/a.csv"), "/proc/a.csv: cannot be written"),
        (("--until", "1", "--every", "-1", "-o", "a.csv"), "--every -1"),
        (("--until", "1", "-o", "a.xls"), "expected a name that ends in .csv or .parquet"),
        (("--until", "1"), "Missing option '-o'"),
        (("-o", "a.csv"), "Missing option '--until'"),
        (("--until", "1", "-o", "a.csv", "--regime", "none.toml"), "none.toml: no such file"),
        (("--until", "1", "-o", "a.csv", "--start", "none.json"), "none.json: cannot be read"),
        (
            ("--until", "1", "-o", "a.csv", "--start", "s.toml"),
            "--start s.toml: expected a JSON file;",
        ),
        (("--until", "1", "-o", "a.csv", "--order", "3"), "'3' is not one of"),
        (("--until", "1", "-o", "a.csv", "--backend", "matlab"), "'matlab' is not one of"),
    ],
)
def test_usage_errors(arguments: tuple[str, ...], words: str) -> None:
    assert words in refused("simulate", DEMO3, *arguments)
    assert not Path("a.csv").exists()


def test_regime_and_start_errors_are_lines() -> None:
    bad = regime("schema = 1\n[flywheel.w9]\nspeed = 1\n")
    lines = refused("simulate", DEMO3, "--until", "1", "--regime", bad, "-o", "a.csv").splitlines()
    assert len(lines) == 4
    assert all(line.startswith("error: r.toml: ") for line in lines)
    Path("s.json").write_text('{"V": [1]}')
    assert "s.json: V: expected 6 numbers" in refused(
        "simulate", DEMO3, "--until", "1", "--start", "s.json", "-o", "a.csv"
    )


@pytest.mark.parametrize("key", ["wrench", "tau", "V_dot", "phi_ddot", "want"])
def test_what_a_start_does_not_take_is_refused_by_name(key: str) -> None:
    for text in ({key: [0.0] * 6}, {"state": {"V": [0.0] * 6, key: {}}}):
        Path("s.json").write_text(json.dumps(text))
        (line,) = refused("simulate", DEMO3, "--until", "1", "--start", "s.json", "-o", "a.csv").splitlines()
        assert f'"{key}" is not part of a start, expected some of id, position, angles, quaternion, V, phi' in line


@pytest.mark.parametrize("text", ['{"V": [0,0,0,0,0,0], "V": [1,0,0,0,0,0]}', '{"state": {"phi": [0], "phi": [1]}}'])
def test_a_start_with_a_key_twice_is_refused(text: str) -> None:
    Path("s.json").write_text(text)
    assert "appears twice" in refused("simulate", DEMO3, "--until", "1", "--start", "s.json", "-o", "a.csv")


@pytest.mark.parametrize(
    "law", ["speed = 1e300", "speed = 2e5", "hold = true}\nwrench = {carrier=[0, 0, 1e12, 0, 0, 0]"]
)
def test_a_regime_out_of_range_leaves_what_is_there(law: str) -> None:
    Path("a.csv").write_text("mine")
    bad = regime(f"schema = 1\ndefault = {{ {law} }}\n")
    (line,) = refused("simulate", DEMO3, "--until", "1", "--regime", bad, "-o", "a.csv").splitlines()
    assert "is out of range, at most" in line
    assert Path("a.csv").read_text() == "mine"


def test_a_run_without_a_row_leaves_what_is_there(monkeypatch: pytest.MonkeyPatch) -> None:
    def nothing(self: object, mounts: bool) -> Iterator[Moment]:
        raise StateError("at t = 0 s a step ends with RANGE")
        yield

    monkeypatch.setattr("mahovik.use.simulate.by_scipy.SciPyMotion.moments", nothing)
    Path("a.csv").write_text("mine")
    said = refused("simulate", DEMO3, "--until", "1", "--backend", "scipy", "-o", "a.csv")
    assert said == "error: at t = 0 s a step ends with RANGE\n"
    assert Path("a.csv").read_text() == "mine"


def test_a_place_that_cannot_be_written_is_told_before_anything_is_computed(monkeypatch: pytest.MonkeyPatch) -> None:
    def never(*given: object) -> None:
        pytest.fail("computed")

    monkeypatch.setattr("mahovik.use.study.rest.rest", never)
    Path("file").write_text("")
    assert "a part of the path is a file" in refused("simulate", DEMO3, "--until", "1", "-o", "file/x/a.csv")
    assert "/proc/a.csv: cannot be written" in refused("simulate", DEMO3, "--until", "1", "-o", "/proc/a.csv")
    probe(Path("new/folder/a.csv"))
    assert sorted(each.name for each in Path().iterdir()) == ["file"]


@pytest.mark.parametrize("moment", ["import", "options"])
def test_ctrl_c_before_the_command_begins(moment: str, own_folder: Path) -> None:
    """While modules are imported, and while click reads its options."""
    stop = "def stop(*given, **more): raise KeyboardInterrupt\n"
    where = {
        "import": "import builtins; real = builtins.__import__\n"
        "builtins.__import__ = lambda name, *a, **k: stop() if name == 'click' else real(name, *a, **k)\n",
        "options": "import click; click.Group.make_context = stop\n",
    }[moment]
    command = [sys.executable, "-c", f"{stop}{where}from mahovik.__main__ import run\nrun()", "rest", DEMO3]
    done = subprocess.run(command, capture_output=True, text=True, cwd=own_folder, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "error: interrupted; no file is half written\n")


def test_no_equilibrium_asks_for_a_start() -> None:
    said = refused("simulate", str(path("remus6")), "--until", "1", "-o", "a.csv", status=1)
    assert "nothing carries a force" in said
    assert "--start" in said


def test_a_long_step_is_warned_of() -> None:
    fast = regime("schema = 1\ndefault = { speed = 5000 }\n")
    result = run("simulate", DEMO3, "--until", "0.001", "--regime", fast, "-o", "a.csv")
    assert "warning: a flywheel turns 0.5 rad per step" in result.stderr


def test_a_motion_that_leaves_its_ranges_keeps_its_rows() -> None:
    wild = regime("schema = 1\ndefault = { torque = 1e6 }\n")
    result = run("simulate", DEMO3, "--until", "1", "--regime", wild, "-o", "a.csv")
    assert result.exit_code == 1
    assert "RANGE" in result.stderr
    assert "what was computed is kept" in result.stderr
    assert len(columns("a.csv")["t [s]"]) >= 1


def test_parquet_holds_what_csv_does() -> None:
    """To the last bit, names and order as well."""
    from pyarrow import parquet

    for name in ("run.csv", "run.parquet"):
        result = run("simulate", BENCH8, "--until", "0.01", "--regime", regime(), "-o", name, "--mounts")
        assert result.exit_code == 0, result.output
    table = parquet.read_table("run.parquet").to_pydict()
    assert list(table) == list(columns("run.csv"))
    assert table == columns("run.csv")
    assert len(set(table["tau w1 [N m]"])) > 5  # numbers with all their digits, not zeros


def test_parquet_without_pyarrow_names_the_command(monkeypatch: pytest.MonkeyPatch) -> None:
    def missing(name: str) -> object:
        if name.startswith("pyarrow"):
            raise ImportError(name)
        return importlib.import_module(name)

    monkeypatch.setattr(runs, "import_module", missing)
    said = refused("simulate", DEMO3, "--until", "1", "-o", "a.parquet")
    assert 'pip install "mahovik[campaign]"' in said
    assert not Path("a.parquet").exists()


def wait_until(there: Callable[[], bool]) -> None:
    """Returns when it is so; a minute is enough on any machine."""
    for _ in range(6000):
        if there():
            return
        time.sleep(0.01)
    pytest.fail("waited in vain")


def started(command: list[str], folder: Path, env: dict[str, str]) -> subprocess.Popen[str]:
    """A program that an interrupt can end, even where these tests run in the background, which ignores it."""
    restored = ["env", "--default-signal=INT", *command]
    return subprocess.Popen(restored, stderr=subprocess.PIPE, text=True, cwd=folder, env=env)


@pytest.mark.slow
def test_ctrl_c_keeps_what_was_computed(own_folder: Path) -> None:
    command = [sys.executable, "-c", "from mahovik.out.cli import main; main()", "simulate", DEMO3]
    command += ["--until", "2000", "--every", "0.01", "-o", "run.csv"]
    env = {**os.environ, "TMPDIR": str(own_folder)}
    with started(command, own_folder, env) as program:
        wait_until(lambda: any(own_folder.glob("mahovik-*")))  # it compiles there
        wait_until(lambda: not any(own_folder.glob("mahovik-*")))
        time.sleep(1.0)  # loaded: it steps
        program.send_signal(signal.SIGINT)
        assert program.stderr is not None
        said = program.stderr.read()
        assert program.wait(30) == 130, said
    assert "stopped at t = " in said
    assert "what was computed is kept" in said
    assert len(columns("run.csv")["t [s]"]) > 1


def test_ctrl_c_before_the_first_step_writes_nothing(own_folder: Path) -> None:
    compiler = own_folder / "slow-cc"
    compiler.write_text("#!/bin/sh\ntouch began\nexec sleep 60\n")
    compiler.chmod(0o755)
    command = [sys.executable, "-c", "from mahovik.out.cli import main; main()", "simulate", DEMO3]
    command += ["--until", "1", "-o", "run.csv"]
    env = {**os.environ, "TMPDIR": str(own_folder), "CC": str(compiler)}
    with started(command, own_folder, env) as program:
        wait_until((own_folder / "began").exists)
        program.send_signal(signal.SIGINT)
        assert program.stderr is not None
        said = program.stderr.read()
        assert program.wait(30) == 130, said
    assert said == "error: interrupted; no file is half written\n"
    assert sorted(each.name for each in own_folder.iterdir()) == ["began", "slow-cc"]


def test_ctrl_c_while_a_file_is_written_leaves_what_was_there(monkeypatch: pytest.MonkeyPatch) -> None:
    Path("a").write_text("old")
    replace = os.replace
    moved: list[Path] = []

    def stop(source: Path, target: Path) -> None:
        if target.name == "b" and not moved:
            moved.append(target)
            raise KeyboardInterrupt
        replace(source, target)

    monkeypatch.setattr(os, "replace", stop)
    with pytest.raises(KeyboardInterrupt):
        write_all(Path(), {"a": "new", "b": "new"})
    assert Path("a").read_text() == "old"
    assert [each.name for each in Path().iterdir()] == ["a"]


def test_no_compiler_is_one_line() -> None:
    done = process("simulate", DEMO3, "--until", "1", "-o", "a.csv", PATH="", CC="")
    assert done.returncode == 2
    assert done.stderr.startswith("error: no C compiler found")


def test_a_start_that_is_no_json_is_told_with_its_line() -> None:
    Path("s.json").write_text('{\n "V": [0, 0, 0, 0, 0, 0],\n "phi_dot" [1]\n}\n')
    said = refused("simulate", DEMO3, "--until", "1", "--start", "s.json", "-o", "a.csv")
    assert "s.json: not JSON: Expecting ':' delimiter at line 3, column 12" in said


def test_figures_as_json() -> None:
    found = json.loads(run("simulate", DEMO3, "--until", "0.005", "-o", "new/run.csv", "--json").stdout)
    columns = Path("new/run.csv").read_text().splitlines()[0].split(",")
    assert (found["file"], found["rows"], found["columns"]) == ("new/run.csv", 6, columns)
    assert found["t_end"] == pytest.approx(0.005)
    assert found["stopped"] is None
