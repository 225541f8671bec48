"""Folders and logs of `generate --only` and `generate --prefix`, as verify, cost, judge-log and replay take them."""

from __future__ import annotations

import hashlib
import json
import re
import subprocess
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from cli.run import DEMO3, refused, run
from mahovik.core.stand import load
from mahovik.core.toolchain.board import build
from mahovik.core.toolchain.board import run as run_program
from mahovik.core.toolchain.targets import TARGETS
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.harness import verify_c
from mahovik.stands import path
from targets.flight import flight
from toolchain.quick import quick
from toolchain.tools import compile_c, require

SHAKER2 = str(path("shaker2"))
STAND = load(path("shaker2"))


def generated(folder: Path, *options: str) -> Path:
    """The folder of `generate` with these options."""
    assert run("generate", SHAKER2, *options, "-o", str(folder)).exit_code == 0
    return folder


@pytest.fixture(scope="module")
def part(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Two functions of shaker2 under another name."""
    return generated(tmp_path_factory.mktemp("part") / "c", "--only", "forward,torque", "--prefix", "shakerp")


@pytest.fixture(scope="module")
def log(part: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """What its self-test prints."""
    return self_test(part, "shakerp", tmp_path_factory.mktemp("log"))


def self_test(folder: Path, name: str, scratch: Path) -> Path:
    """Builds and runs the self-test of a folder; returns its log."""
    sources = folder / f"{name}.c", folder / f"verification/{name}_selftest.c"
    compile_c(
        require("gcc", "gcc"),
        *sources,
        "-O1",
        "-ffp-contract=off",
        f"-D{name.upper()}_SELFTEST_MAIN",
        "-o",
        scratch / "program",
    )
    printed = subprocess.run([scratch / "program"], capture_output=True, text=True, check=True, timeout=60).stdout
    (scratch / "board.log").write_text(printed)
    return scratch / "board.log"


def heavier(folder: Path) -> str:
    """A stand file of shaker2 with another mass."""
    text, count = re.subn(r"(?m)^mass = ", "mass = 1", Path(SHAKER2).read_text(), count=1)
    assert count == 1
    (folder / "heavier.toml").write_text(text)
    return str(folder / "heavier.toml")


def copied(folder: Path, there: Path, *names: str) -> Path:
    """Files of a folder in a new one."""
    there.mkdir()
    for name in names:
        (there / name).parent.mkdir(exist_ok=True)
        (there / name).write_bytes((folder / name).read_bytes())
    return there


# ---- generate --check ----


def test_a_folder_is_checked_as_it_was_delivered(tmp_path: Path) -> None:
    """Options that are given decide; what made it stands beside it, apart from the manifest."""
    options = ("--only", "forward,torque", "--prefix", "fw", "--real", "float", "--batch")
    folder = generated(tmp_path / "c", *options)
    manifest = json.loads((folder / "manifest.json").read_text())
    chosen = ("stand", "real", "only", "batch")
    assert [manifest[key] for key in chosen] == ["fw", "float", ["forward", "torque"], True]
    provenance = json.loads((folder / "provenance.json").read_text())
    assert provenance["stand_file"] == hashlib.sha256(Path(SHAKER2).read_bytes()).hexdigest()
    assert re.fullmatch("[0-9a-f]{64}", provenance["package"])
    assert provenance["numpy"] == np.__version__
    assert "provenance.json" not in manifest["files"]
    (folder / "provenance.json").unlink()
    check = ("generate", SHAKER2, "-o", str(folder), "--check")
    assert run(*check).exit_code == 0
    assert "its C is float, expected double" in refused(*check, "--real", "double", status=1)
    assert "manifest.json: does not list these files" in refused(*check, "--only", "forward", status=1)


def test_evidence_is_of_what_was_delivered(part: Path, tmp_path: Path) -> None:
    """The C of the evidence has the prefix and the functions of the folder, and is checked by the same options."""
    out = tmp_path / "out"
    result = run("evidence", SHAKER2, "--against", str(part), "-o", str(out), "--only", "delivery,equations,selftest")
    assert result.exit_code == 0, result.output
    assert (out / "c" / "shakerp.c").read_bytes() == (part / "shakerp.c").read_bytes()
    assert (out / "c" / "provenance.json").is_file()


def test_evidence_has_the_functions_for_many_states_of_its_folder(tmp_path: Path) -> None:
    folder = generated(tmp_path / "c", "--only", "forward", "--batch")
    out = tmp_path / "out"
    result = run("evidence", SHAKER2, "--against", str(folder), "-o", str(out), "--only", "delivery")
    assert result.exit_code == 0, result.output
    assert (out / "c" / "shaker2_batch.c").read_bytes() == (folder / "shaker2_batch.c").read_bytes()


@pytest.mark.slow
def test_a_part_runs_on_targets_and_its_branches_are_counted(part: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    result = run("evidence", SHAKER2, "--against", str(part), "-o", str(out), "--only", "branches,targets,fuzz")
    assert result.exit_code == 0, result.output
    verdicts = {e["name"]: e for e in json.loads((out / "evidence.json").read_text())["pieces"]}
    assert {name: verdicts[name]["verdict"] for name in ("branches", "targets")} == dict.fromkeys(
        ("branches", "targets"), "passed"
    )
    assert verdicts["fuzz"]["figure"] == "the harness calls all functions, and this C has some of them"


@pytest.mark.parametrize("words", [("cmake",), ("target", "--target", "m7")])
def test_what_made_a_project_stands_beside_its_manifest(words: tuple[str, ...], tmp_path: Path) -> None:
    kind, *options = words
    assert run("export", kind, SHAKER2, *options, "-o", str(tmp_path / "p"), "--only", "forward").exit_code == 0
    found = json.loads((tmp_path / "p" / "provenance.json").read_text())
    assert found["stand_file"] == hashlib.sha256(Path(SHAKER2).read_bytes()).hexdigest()
    assert "provenance.json" not in json.loads((tmp_path / "p" / "manifest.json").read_text())["files"]


# ---- verify --against ----


def test_verify_judges_the_functions_that_are_there_under_their_name(part: Path) -> None:
    result = run("verify", SHAKER2, "--against", str(part), "--states", "9", "--json")
    assert result.exit_code == 0, result.output
    found = json.loads(result.stdout)
    assert found["stand"] == "shakerp"
    assert found["judged"] == f"C in {part}, only forward, torque"
    verdicts = {(row["want"], row["quantity"]): row["verdict"] for row in found["rows"]}
    assert verdicts["forward", "V_dot"] == verdicts["torque", "tau"] == "ok"
    assert verdicts["", "interpreter = C, bit for bit"] == verdicts["", "bad inputs refused, outputs untouched"] == "ok"
    absent = {want for (want, quantity), verdict in verdicts.items() if verdict == "not compared"}
    assert {"inverse", "step", "quaternion", "prepare"} <= absent
    assert not absent & {"forward", "torque", ""}
    assert {want for want, _ in verdicts} == absent | {"forward", "torque", ""}


def test_a_fault_in_a_part_is_found(part: Path, tmp_path: Path) -> None:
    folder = copied(part, tmp_path / "c", "shakerp.h", "shakerp.c", "manifest.json")
    text = (folder / "shakerp.c").read_text()
    body = re.search(r"\nshakerp_status shakerp_torque\(.*?\n}\n", text, re.DOTALL)
    assert body is not None
    wrong = body[0].replace(" += ", " -= ") if " += " in body[0] else body[0].replace(" + ", " - ")
    assert wrong != body[0]
    (folder / "shakerp.c").write_text(text.replace(body[0], wrong))
    result = run("verify", SHAKER2, "--against", str(folder), "--states", "9")
    assert result.exit_code == 1
    assert "FAILED: tau" in result.stdout


@pytest.mark.parametrize("only", quick(1, ["prepare_mounts,quaternion", "step,mounts", "inverse_fast", "accumulate"]))
def test_functions_that_answer_no_want_are_judged(only: str, tmp_path: Path) -> None:
    """Other functions that a judge calls, such as `mounts`, are run by the interpreter."""
    found = verify_c(STAND, count=9, against=generated(tmp_path / "c", "--only", only))
    assert found.passed
    assert {row.want for row in found.rows if row.verdict == "ok" and row.want} >= set(only.split(","))


@pytest.mark.slow
def test_a_whole_folder_of_another_name_and_type(tmp_path: Path) -> None:
    folder = str(generated(tmp_path / "c", "--prefix", "shakerf", "--real", "float"))
    result = run("verify", SHAKER2, "--against", folder, "--states", "9")
    assert result.exit_code == 0, result.output
    assert "not in the folder" not in result.output
    assert "give --real float" in refused("verify", SHAKER2, "--against", folder, "--real", "double")


def test_a_part_without_manifest_is_known_by_its_header(part: Path, tmp_path: Path) -> None:
    folder = copied(part, tmp_path / "c", "shakerp.h", "shakerp.c")
    backend = CBackend(replace(STAND, name="shakerp"), folder=folder)
    assert backend.wants == ("forward", "torque")
    assert "inverse" in backend.left_out


def test_a_function_that_the_manifest_promises_must_be_there(part: Path, tmp_path: Path) -> None:
    folder = copied(part, tmp_path / "c", "shakerp.h", "shakerp.c", "manifest.json")
    manifest = (folder / "manifest.json").read_text()
    (folder / "manifest.json").write_text(manifest.replace('"torque"', '"momentum"'))
    message = refused("verify", SHAKER2, "--against", str(folder), status=1)
    assert "shakerp.h: declares no function momentum, expected by manifest.json: generate again" in message


def test_rounding_of_a_part_is_measured(part: Path, tmp_path: Path) -> None:
    pytest.importorskip("flint")
    result = run("verify", SHAKER2, "--against", str(part), "--rigorous", "--states", "4")
    assert result.exit_code == 0, result.output
    assert "only forward, torque of shakerp" in result.output
    other = generated(tmp_path / "c", "--only", "accumulate")
    message = refused("verify", SHAKER2, "--against", str(other), "--rigorous", "--states", "4")
    assert "holds accumulate, expected one of matrices, momentum, forward, " in message


def test_c_of_another_stand_is_named(part: Path, tmp_path: Path) -> None:
    for other in (heavier(tmp_path), DEMO3):
        message = refused("verify", other, "--against", str(part), status=1)
        assert re.search(
            r': holds the C of stand "shakerp", physics [0-9a-f]{8}, expected that of "\w+", also', message
        )
        assert message.count("\n") == 1


def test_two_names_in_one_folder_are_one_too_many(part: Path, tmp_path: Path) -> None:
    folder = copied(part, tmp_path / "c", "shakerp.h", "shakerp.c")
    second = generated(tmp_path / "second", "--only", "wrap", "--prefix", "shakerq")
    for name in ("shakerq.h", "shakerq.c"):
        (folder / name).write_bytes((second / name).read_bytes())
    message = refused("verify", SHAKER2, "--against", str(folder), status=1)
    assert 'holds C of this stand under the names "shakerp" and "shakerq": move all but one' in message


# ---- cost ----


@pytest.mark.slow
def test_cost_measures_a_folder_of_another_name(part: Path, tmp_path: Path) -> None:
    require("valgrind", "valgrind")
    folder = str(
        copied(part, tmp_path / "c", *(each.relative_to(part).as_posix() for each in part.rglob("*") if each.is_file()))
    )
    given = ("cost", SHAKER2, "-o", folder, "--targets", "host", "--real", "double")
    measured = run(*given, "--accept")
    assert measured.exit_code == 0, measured.output
    assert "# Cost of shakerp" in measured.output
    figures = json.loads((tmp_path / "c" / "cost.json").read_text())
    assert figures["stand"] == "shakerp"
    assert [f["function"] for f in figures["targets"][0]["functions"]] == ["forward", "torque"]
    given_folder = ("--only", "forward,torque", "--prefix", "shakerp", "-o", folder)
    assert run("generate", SHAKER2, *given_folder, "--check").exit_code == 0


def test_cost_of_another_stand_names_what_it_found(part: Path, tmp_path: Path) -> None:
    message = refused("cost", heavier(tmp_path), "-o", str(part), "--targets", "host")
    assert 'holds the C of stand "shakerp", physics ' in message


# ---- judge-log ----


def test_the_log_of_a_part_under_another_name_is_judged(log: Path) -> None:
    result = run("judge-log", SHAKER2, "--log", str(log), "--only", "torque, forward")
    assert result.exit_code == 0, result.output
    assert "PASS   shakerp double" in result.output
    assert "every function of --only torque,forward there" in result.output
    assert "sweep of 100 states, double, by gcc" in result.output


def test_the_log_of_a_part_gives_no_false_alarm(log: Path) -> None:
    message = refused("judge-log", SHAKER2, "--log", str(log), status=1)
    assert "holds a part of the functions: of C of `generate --only`, give --only forward,torque; else lines" in message
    assert "other bits" not in message
    assert message.count("\n") == 1
    message = refused("judge-log", SHAKER2, "--log", str(log), "--only", "forward", status=1)
    assert "functions that --only does not name: torque: give --only as `generate` had it" in message
    message = refused("judge-log", SHAKER2, "--log", str(log), "--only", "forward,torque,wrap", status=1)
    assert "nothing of: wrap: give --only as `generate` had it" in message
    assert '--only forwart: the C of shakerp has no such function, did you mean "forward"?' in refused(
        "judge-log", SHAKER2, "--log", str(log), "--only", "forwart"
    )
    assert "--only: found no stand file, expected STAND.toml" in refused("judge-log", "--log", str(log), "--only", "x")


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        (r"\ntorque \w{8}\n", "\ntorque 00000000\n", "other bits in the sweep of 100 states: torque (torque: 00000000"),
        (r"torque PASS.*\n", "", "no line PASS or FAIL of: torque"),
        (r"failures 0\n", "", 'no line "failures"'),
        (r"physics \w+", "physics 00000000", "physics 00000000, the stand file has "),
    ],
)
def test_what_is_wrong_in_the_log_of_a_part_is_found(old: str, new: str, words: str, log: Path, tmp_path: Path) -> None:
    text, count = re.subn(old, new, log.read_text(), count=1)
    assert count == 1
    (tmp_path / "spoiled.log").write_text(text)
    given = ("judge-log", SHAKER2, "--log", str(tmp_path / "spoiled.log"), "--only", "forward,torque")
    assert words in refused(*given, status=1)


def test_the_log_of_another_stand_is_refused(log: Path, tmp_path: Path) -> None:
    message = refused("judge-log", heavier(tmp_path), "--log", str(log), status=1)
    assert "stand shakerp, the stand file has shaker2" in message


# ---- replay, and the page of the folder ----


@pytest.mark.slow
def test_a_flight_under_another_name_is_replayed(tmp_path: Path) -> None:
    texts = flight(replace(load(DEMO3), name="other"), "double", 20)
    flown = tmp_path / "flight.log"
    flown.write_text(run_program(TARGETS["host"], build(TARGETS["host"], texts, tmp_path)))
    result = run("replay", DEMO3, "--log", str(flown))
    assert result.exit_code == 0, result.output
    assert "all 20 steps bit for bit: other, double" in result.output


def test_the_commands_of_its_page_work(part: Path, log: Path) -> None:
    """With the stand file that `generate --prefix` was given; `generate` itself needs the option again, it says."""
    page = (part / "README.md").read_text()
    assert "or the one that `generate --prefix shakerp` was given: then\n`generate` needs that option again" in page
    commands = [text.split() for text in re.findall(r"`mahovik (\w[\w-]* STAND\.toml[^`]*)`", page)]
    assert {name for name, *_ in commands} == {"judge-log", "verify", "generate", "cost"}
    for name, _, *options in commands:
        given = [{".": str(part), "LOG": str(log)}.get(each, each) for each in options]
        given += {"generate": ["--prefix", "shakerp"], "verify": ["--states", "4"]}.get(name, [])
        if name != "cost":  # measures processors whose tools need not be here
            result = run(name, SHAKER2, *given)
            assert result.exit_code == 0, (name, given, result.output)
