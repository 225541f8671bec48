"""simulate and replay: files, starts from rest, outputs of any name, early ends, logs bit for bit, refusals."""

from __future__ import annotations

import csv
import json
import subprocess
import sys
from pathlib import Path

import pytest

from cli.run import BENCH8, DEMO3, refused, run
from control.following import SERVO
from mahovik.core.motion.programme import save_programme
from mahovik.core.stand import load
from mahovik.core.toolchain.targets import TARGETS, build
from mahovik.core.toolchain.targets import run as run_program
from mahovik.stands import path
from mahovik.writing import probe
from simulate.flights import Recorder
from targets.flight import flight
from toolchain.tools import require
from verify.programme.programmes import shaker

SHAKER2 = str(path("shaker2"))

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
    assert [file.name for file in Path().iterdir()] == ["file"]


@pytest.mark.parametrize("moment", ["import", "options"])
def test_ctrl_c_before_the_command_begins(moment: str, work_folder: Path) -> None:
    """The interrupt comes while modules are imported, and while click reads its options."""
    stop = "def stop(*given, **more): raise KeyboardInterrupt\n"
    where = {
        "import": "import builtins; real = builtins.__import__\n"
        "builtins.__import__ = lambda name, *a, **k: stop() if name == 'click' else real(name, *a, **k)\n",
        "options": "import click; click.Group.make_context = stop\n",
    }[moment]
    command = [sys.executable, "-c", f"{stop}{where}from mahovik.__main__ import run\nrun()", "check", DEMO3]
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


def test_a_followed_programme_is_a_table_of_required_coordinates() -> None:
    """The columns follow the required heave."""
    save_programme(shaker()[2], Path("P.json"))
    Path("S.toml").write_text(SERVO)
    motion = str(Path(SHAKER2).with_name("shaker2_spin.motion.json"))
    files = ("--programme", "P.json", "--motion", motion, "--servo", "S.toml")
    said = run("simulate", SHAKER2, *files, "--periods", "11", "-o", "run.csv")
    assert said.exit_code == 0, said.output
    assert "over the last 10 of 11 periods; mismatch 0%, seed 1" in said.stdout
    followed = columns("run.csv")
    assert len(followed["z [m]"]) == 1101
    assert followed["z [m]"] == pytest.approx(followed["required z [m]"], abs=1e-7)


@pytest.mark.parametrize(
    "arguments",
    [
        ("vibration", SHAKER2, "--at", "carrier", "--speed", "left=0..100rpm", "--steps", "3"),
        ("simulate", DEMO3, "--until", "0.002"),
        ("modes", DEMO3),
        ("report", DEMO3, "--derivation"),
        ("new", "demo3"),
    ],
    ids=lambda case: case[0],
)
def test_a_device_and_a_link_to_one_need_no_ending(arguments: tuple[str, ...]) -> None:
    link = Path("link")
    link.symlink_to("/dev/null")
    for target in ("/dev/null", "link"):
        assert run(*arguments, "-o", target).exit_code == 0
    assert link.is_symlink() and list(Path().iterdir()) == [link]


TURNS = """schema = 1
name = "box"
gravity = [0, 0, -9.81]
[carrier]
mass = "100 kg"
inertia = [3.0, 4.0, 5.0]
buoyancy = { displaced_mass = "100 kg", center = [0, 0, "-50 mm"] }
damping = { linear = [50, 50, 50, 5, 5, 5] }
[[flywheel]]
name = "w"
mass = 1e-9
spin_inertia = 1e-9
transverse_inertia = 1e-9
buoyancy = { displaced_mass = 1e-9 }
"""


@pytest.mark.parametrize(
    "command",
    [
        ("modes",),
        ("simulate", "--until", "0.02", "--every", "0.01", "-o", "a.csv", "--backend", "scipy"),
        ("vibration", "--speed", "w=600rpm", "--at", "carrier"),
        ("report", "-o", "a.html"),
    ],
)
def test_what_starts_from_a_turned_rest_pose_says_so(command: tuple[str, ...]) -> None:
    """The centre of buoyancy is below the centre of mass, so that the box hangs upside down; above it, it does not."""
    line = "warning: starts from rest, turned by 180 deg from E0: see mahovik check"
    name, *options = command
    for text, warned in ((TURNS, True), (TURNS.replace('"-50 mm"', '"50 mm"'), False)):
        Path("box.toml").write_text(text)
        done = run(name, "box.toml", *options)
        assert done.exit_code == 0, done.stderr
        assert done.stderr.splitlines().count(line) == warned


STEPS = 720
"""Beyond the first sensor that fails, in step 700."""


@pytest.fixture(scope="module")
def flown(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The console of a flight of demo3, and the folder of its C."""
    require("gcc", "gcc")
    folder = tmp_path_factory.mktemp("flight")
    texts = flight(load(path("demo3")), "double", STEPS)
    (folder / "flight.log").write_text(run_program(TARGETS["host"], build(TARGETS["host"], texts, folder)))
    return folder / "flight.log"


@pytest.fixture
def binary(flown: Path, tmp_path: Path) -> Path:
    """The same log as bytes, to be damaged."""
    target = tmp_path / "binary.log"
    target.write_bytes(b"".join(bytes.fromhex(line[1:]) for line in flown.read_text().splitlines()))
    return target


def test_columns_of_states_and_a_line_of_a_step(flown: Path) -> None:
    """The columns read back to bits; the line of a step goes through `eval`."""
    run("replay", DEMO3, "--log", str(flown), "-o", "states.csv")
    lines = Path("states.csv").read_text().splitlines()
    assert len(lines) == 722
    assert lines[0].startswith("step,status,position x,position y,position z,attitude w,")
    assert len(lines[-1].split(",")) == len(lines[0].split(","))
    assert lines[701].split(",")[1] == "RANGE"
    said = run("replay", DEMO3, "--log", str(flown), "--step", "5").stdout.splitlines()
    good = next(line for line in said if line.startswith("{"))
    answer = json.loads(run("eval", DEMO3, stdin=good).stdout)
    assert answer["id"] == "step 5" and "V_dot" in answer


@pytest.mark.slow
def test_a_state_that_differs_is_status_1(tmp_path: Path) -> None:
    """Flown by C with one constant in another bit; the folder that flew gives its bits again."""
    flew = Recorder("bench8", "double", tmp_path, edit=("half = 0.5 * h", "half = 0.5000000000000001 * h"))
    flew.fly(6)
    Path("other.log").write_bytes(flew.log)
    said = run("replay", BENCH8, "--log", "other.log")
    assert said.exit_code == 1
    assert "0 steps bit for bit" in said.output
    assert "error: step 0 differs: the state after it has hash" in said.stdout
    assert run("replay", BENCH8, "--log", "other.log", "--against", str(tmp_path)).exit_code == 0


def test_damage_is_status_1_and_a_cut_end_is_not(binary: Path) -> None:
    whole = binary.read_bytes()
    binary.write_bytes(whole[:-5])
    said = run("replay", DEMO3, "--log", str(binary))
    assert said.exit_code == 0
    assert "all 720 steps" in said.output
    assert "note: the log ends inside the record of step 720" in said.stdout
    binary.write_bytes(whole[:30000] + bytes([whole[30000] ^ 1]) + whole[30001:])
    said = run("replay", DEMO3, "--log", str(binary))
    assert said.exit_code == 1
    assert "is damaged: its check does not fit; the log ends without another start" in said.stdout
    assert said.stderr == ""


@pytest.mark.parametrize(
    ("arguments", "words", "status"),
    [
        ((BENCH8,), 'stand "bench8", but the log is from "demo3"', 1),
        ((DEMO3, "--against", "nowhere"), "no such file", 2),
    ],
)
def test_refusals_are_one_line(arguments: tuple[str, ...], words: str, status: int, flown: Path) -> None:
    said = refused("replay", *arguments, "--log", str(flown), status=status)
    assert words in said and len(said.splitlines()) == 1


def test_the_verdict_as_json(flown: Path, binary: Path) -> None:
    verdict = json.loads(run("replay", DEMO3, "--log", str(flown), "--json", "--step", "5").stdout)
    assert (verdict["stand"], verdict["steps_equal"], verdict["steps_refused"], verdict["differs_at"]) == (
        "demo3",
        721,
        1,
        None,
    )
    data = bytearray(binary.read_bytes())
    data[len(data) // 2] ^= 1
    binary.write_bytes(data)
    result = run("replay", DEMO3, "--log", str(binary), "--json")
    assert result.exit_code == 1
    assert json.loads(result.stdout)["damage"]
