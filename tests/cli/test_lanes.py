"""--lanes and --fast on the command line: what is asked for, what lies there, what does not go together."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from cli.run import DEMO3, refused, run
from emit.selftests import run_selftest
from emit.stands import stand
from mahovik.core.emit.delivery import delivery
from mahovik.core.emit.reading import read_header
from mahovik.proof.verify.delivery import deliver
from mahovik.proof.verify.harness import verify_c
from mahovik.use.simulate.replay import CMachine
from simulate.flights import Recorder


@pytest.fixture(scope="module")
def folders(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """demo3 with four lanes, and for speed; not to be changed."""
    four, fast = (tmp_path_factory.mktemp(name) / "demo3" for name in ("four", "fast"))
    assert run("generate", DEMO3, "--lanes", "4", "-o", str(four)).exit_code == 0
    assert run("generate", DEMO3, "--fast", "-o", str(fast)).exit_code == 0
    return {"four": four, "fast": fast}


def test_the_manifest_and_the_header_tell_them(folders: dict[str, Path]) -> None:
    told = {name: json.loads((folder / "manifest.json").read_text()) for name, folder in folders.items()}
    assert (told["four"]["lanes"], told["four"].get("fast")) == (4, None)
    assert (told["fast"]["lanes"], told["fast"].get("fast")) == (2, True)
    heads = {name: read_header(folder, "demo3") for name, folder in folders.items()}
    assert [(h.lanes, h.fast, h.real) for h in heads.values() if h] == [(4, False, "double"), (2, True, "double")]


@pytest.mark.slow
def test_drivers_of_frama_c_are_of_one_lane(folders: dict[str, Path]) -> None:
    given = stand("demo3")
    for files in (delivery(given), delivery(given, "float", batch=True)):
        assert {"verification/demo3_eva.c", "verification/demo3_eva.sh"} <= set(files)
        assert files["README.md"].count("_eva.") == 4
    for folder in folders.values():
        assert list(folder.glob("*_eva.*")) == []
        text = (folder / "README.md").read_text()
        assert "_eva" not in text
        assert "Frama-C" not in text
        assert ("demo3_recorder.h" in text) == folder.parent.name.startswith("four")


def test_check_wants_the_same_options(folders: dict[str, Path]) -> None:
    four, fast = str(folders["four"]), str(folders["fast"])
    assert run("generate", DEMO3, "--lanes", "4", "-o", four, "--check").exit_code == 0
    assert run("generate", DEMO3, "--fast", "-o", fast, "--check").exit_code == 0
    said = refused("generate", DEMO3, "-o", four, "--check", status=1)
    assert said == f"error: {four}: its C has lanes 4, expected 1: give --lanes 4, or generate it again\n"
    said = refused("generate", DEMO3, "-o", fast, "--check", status=1)
    assert said == f"error: {fast}: its C is fast, expected not fast: give --fast, or generate it again\n"
    said = refused("generate", DEMO3, "--fast", "-o", four, "--check", status=1)
    assert said == f"error: {four}: its C is not fast, expected fast: leave --fast out, or generate it again\n"


def test_what_cannot_be_asked_for() -> None:
    assert "'3' is not one of '1', '2', '4', '8'" in refused("generate", DEMO3, "--lanes", "3")
    assert refused("verify", DEMO3, "--fast", "--targets", "m7").startswith("error: --fast: its bits are not reprod")
    assert "not with --judges, --with" in refused("verify", DEMO3, "--lanes", "2", "--judges")


def test_a_stand_without_flywheels_has_no_lanes(tmp_path: Path) -> None:
    path = tmp_path / "alone.toml"
    path.write_text(Path(DEMO3).read_text().split("[[flywheel")[0].replace('"demo3"', '"alone"'))
    said = refused("generate", str(path), "--lanes", "2", "-o", str(tmp_path / "out"))
    assert said == "error: --lanes 2: alone has no flywheels: remove it\n"
    assert not (tmp_path / "out").exists()


@pytest.mark.slow
def test_verify_finds_the_lanes_of_a_folder(folders: dict[str, Path]) -> None:
    found = verify_c(stand("demo3"), count=6, against=folders["four"])
    assert found.passed
    assert found.judged == f"C in {folders['four']}, lanes 4"
    assert next(row.verdict for row in found.rows if row.quantity.startswith("interpreter")) == "ok"
    said = refused("verify", DEMO3, "--against", str(folders["four"]), "--lanes", "2")
    assert said.endswith("its C has lanes 4, expected 2: leave --lanes out\n")


@pytest.mark.slow
def test_verify_holds_fast_c_to_the_same_tolerances(folders: dict[str, Path]) -> None:
    found = verify_c(stand("demo3"), count=12, against=folders["fast"])
    assert found.passed
    assert found.tolerance == verify_c(stand("demo3"), count=1).tolerance
    bits = next(row for row in found.rows if row.quantity.startswith("interpreter"))
    assert (bits.verdict, bits.reason) == ("not compared", "fast: its bits are not reproducible")
    assert next(row for row in found.rows if "refus" in row.quantity).verdict == "ok"


def test_cost_and_replay_refuse_fast_c(folders: dict[str, Path], tmp_path: Path) -> None:
    said = refused("cost", DEMO3, "--targets", "host", "-o", str(folders["fast"]))
    assert "holds C of --fast, for the host alone" in said
    flown = Recorder("demo3", "double", tmp_path)
    flown.fly(3)
    (tmp_path / "log").write_bytes(flown.log)
    said = refused("replay", DEMO3, "--log", str(tmp_path / "log"), "--against", str(folders["fast"]))
    assert "its C is for speed (--fast), its bits are not reproducible" in said


@pytest.mark.slow
@pytest.mark.parametrize("backend", ["c", "interpreter"])
def test_replay_finds_the_lanes_that_flew(backend: str, tmp_path: Path) -> None:
    flown = Recorder("demo3", "double", tmp_path, lanes=2)
    flown.fly(10)
    (tmp_path / "log").write_bytes(flown.log)
    result = run("replay", DEMO3, "--log", str(tmp_path / "log"), "--backend", backend)
    assert result.exit_code == 0, result.output
    assert "all 10 steps bit for bit" in result.stdout
    assert CMachine(stand("demo3"), "double", lanes=2).source != CMachine(stand("demo3"), "double").source


@pytest.mark.slow
def test_judge_log_finds_the_lanes_of_the_board(tmp_path: Path) -> None:
    files = delivery(stand("demo3"), "double", 4)
    code = {
        name: text for name, text in files.items() if name in ("demo3.h", "demo3.c", "verification/demo3_selftest.c")
    }
    status, printed = run_selftest(code, "demo3", tmp_path, "gcc", "-O2", "-DDEMO3_SELFTEST_SWEEP=5")
    assert status == 0
    (tmp_path / "board.log").write_text(printed)
    assert run("judge-log", DEMO3, "--log", str(tmp_path / "board.log")).exit_code == 0
    (tmp_path / "board.log").write_text(printed.replace(" lanes 4\n", "\n"))
    assert "other bits in the sweep" in run("judge-log", DEMO3, "--log", str(tmp_path / "board.log")).output


def test_a_folder_may_get_other_lanes(tmp_path: Path) -> None:
    """Written over, as other C of the same stand is; the recorder of before is not left beside C for speed."""
    deliver(tmp_path, stand("demo3"), "double", delivery(stand("demo3")))
    assert (tmp_path / "demo3_recorder.c").is_file()
    assert run("generate", DEMO3, "--fast", "-o", str(tmp_path)).exit_code == 0
    assert not (tmp_path / "demo3_recorder.c").exists()
