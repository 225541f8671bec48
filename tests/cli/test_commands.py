"""new, check, plan of a slew, modes, verify --rigorous, derivations, and the group itself."""

from __future__ import annotations

import inspect
import json
import os
import resource
import subprocess
import sys
from importlib import import_module
from itertools import chain
from pathlib import Path

import click
import pytest

import mahovik
from cli.run import BENCH8, DEMO3, process, refused, run
from mahovik import stands
from mahovik.contract.evaluation import STATE, text_lines
from mahovik.contract.functions import ALL_WANTS, wants_of, wants_of_carrier
from mahovik.core.motion.programme import load_programme
from mahovik.core.stand import load
from mahovik.out.command_line import make_command, read_docstring
from mahovik.out.commands import COMMANDS
from mahovik.stands import path
from mahovik.stands import path as stand_path


def test_help_fits_on_a_screen() -> None:
    lines = run("--help").output.splitlines()
    assert len(lines) <= 40
    assert all(len(line) <= 80 for line in lines)
    for command in chain.from_iterable(COMMANDS.values()):
        assert sum(line.startswith(f"  {command} ") and not line.endswith("...") for line in lines) == 1, command


@pytest.mark.parametrize("name", [*chain.from_iterable(COMMANDS.values())])
def test_a_command_says_what_each_of_its_arguments_is(name: str) -> None:
    """The function has an entry for each argument, and the help shows it; no option has two names."""
    function = getattr(import_module(f"mahovik.out.commands.{name}"), name)
    assert getattr(mahovik, name) is function
    words, entries = read_docstring(function)
    hidden = {"progress", "states"} if name == "eval" else {"progress"}
    assert set(inspect.signature(function).parameters) - hidden <= entries.keys()
    assert entries.keys() <= inspect.signature(function).parameters.keys()
    assert words and all(words[-1] == "." for words in entries.values())
    made = make_command(name)
    assert all(getattr(one, "help", "") for one in made.params if isinstance(one, click.Option))


@pytest.mark.parametrize("command", ["eval", "judge"])
def test_help_of_judged_programs_has_their_contract(command: str) -> None:
    """Every key of a state with unit, frame and default, and every want with the keys of its answer."""
    contract = text_lines("A state", "Wants")
    shown = [line.strip() for line in run(command, "--help").output.splitlines()]
    assert len(contract) <= 40
    assert {line.strip() for line in contract} <= {*shown}
    assert {*STATE, *ALL_WANTS} <= {line.split(" ")[0] for line in shown}


def test_help_answers_at_once() -> None:
    def seconds() -> float:
        """Processor time, since other processes may share the machine."""
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        process("--help")
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime

    assert min(seconds() for _ in range(5)) < 0.25  # 0.07 on an idle machine


def test_new_copies_a_stand_with_its_motions(tmp_path: Path) -> None:
    for name in stands.names():
        result = run("new", name, "-o", str(tmp_path))
        assert result.exit_code == 0
        assert len(result.output.split(", ")) == 1 + len(stands.motions(name)) + len(stands.servo_and_regime(name))
        assert load(tmp_path / f"{name}.toml") == load(stands.path(name))
        for motion in stands.motions(name):
            assert (tmp_path / motion.name).read_text() == motion.read_text()


def test_new_names_the_stand_after_its_file(tmp_path: Path) -> None:
    assert run("new", "bench8", "-o", str(tmp_path / "mine.toml")).stderr == ""
    assert load(tmp_path / "mine.toml").name == "mine"
    said = run("new", "bench8", "-o", str(tmp_path / "my-stand.toml"))
    assert said.exit_code == 0 and load(tmp_path / "my-stand.toml").name == "bench8"
    assert said.output.splitlines()[-1].startswith(
        'the stand is still named bench8, since "my-stand" is not a C identifier'
    )
    assert said.output.endswith("give another by --name NAME\n")
    assert run("new", "bench8", "--name", "other", "-o", str(tmp_path / "third.toml")).stderr == ""
    assert load(tmp_path / "third.toml").name == "other"


def test_new_overwrites_nothing(tmp_path: Path) -> None:
    (tmp_path / "bench8.motion.json").write_text("mine")
    assert "exists already, nothing was written" in refused("new", "bench8", "-o", str(tmp_path))
    assert [p.name for p in tmp_path.iterdir()] == ["bench8.motion.json"]
    assert (tmp_path / "bench8.motion.json").read_text() == "mine"


def test_new_lists_and_refuses_unknown_names() -> None:
    listed = run("new", "--list")
    assert [line.split()[0] for line in listed.output.splitlines()[4:] if line] == list(stands.names())
    assert "unbalance within its data-sheet limits does to an accelerometer." in listed.output
    assert 'no example stand "bench9"' in refused("new", "bench9")
    assert "which example?" in refused("new")


def test_tables_are_not_cut_when_piped() -> None:
    done = process("check", BENCH8, COLUMNS="40", TERM="dumb")
    assert done.returncode == 0
    assert "…" not in done.stdout
    assert max(map(len, done.stdout.splitlines())) > 100
    assert "\x1b" not in done.stdout


@pytest.mark.parametrize(("asked", "used"), [(None, "1"), ("3", "3")])
def test_linear_algebra_has_one_thread_unless_told_otherwise(asked: str | None, used: str) -> None:
    program = (
        "import os, sys; sys.argv = ['mahovik', '--version']; from mahovik.__main__ import run\n"
        "try: run()\n"
        "except SystemExit: print([os.environ[f'{of}_NUM_THREADS'] for of in ('OMP', 'OPENBLAS', 'MKL')])"
    )
    environment = {name: value for name, value in os.environ.items() if not name.endswith("_NUM_THREADS")}
    environment |= {} if asked is None else {f"{of}_NUM_THREADS": asked for of in ("OMP", "OPENBLAS", "MKL")}
    done = subprocess.run([sys.executable, "-c", program], env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines()[-1] == str([used] * 3)


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        ("mahovik veri", ["plain,verify"]),
        ("mahovik generate --rea", ["plain,--real"]),
        ("mahovik generate --real ", ["plain,double", "plain,float"]),
    ],
)
def test_what_a_shell_completes(words: str, expected: list[str]) -> None:
    """Completion is driven by the variables that the bash script sets."""
    last = str(words.count(" "))
    done = process(_MAHOVIK_COMPLETE="bash_complete", COMP_WORDS=words, COMP_CWORD=last)
    assert done.stdout.splitlines() == expected, done.stderr


@pytest.mark.slow
def test_a_slew_goes_through_the_same_commands(tmp_path: Path) -> None:
    """A slew is planned, verified and exported; one that is out of reach is refused in one line."""
    motion, programme = tmp_path / "turn.json", tmp_path / "p.json"
    keys = {"schema": 1, "type": "slew", "name": "turn", "task": "pointing", "end": {"angles": [0.3, 0, 0]}}
    motion.write_text(json.dumps(keys | {"duration": 6}), encoding="utf-8")
    sat4 = str(stand_path("sat4"))
    told = run("plan", sat4, "--motion", str(motion), "-o", str(programme))
    assert told.exit_code == 0 and "duration: 6 s" in told.stdout and "status: OK\n" in told.stdout
    assert load_programme(programme).carrier is not None
    judged = run("verify", sat4, str(programme), "--motion", str(motion), "--json")
    names = {row["quantity"] for row in json.loads(judged.stdout)["rows"] if row["verdict"] == "ok"}
    assert judged.exit_code == 0 and names >= {"slew start", "slew end", "slew path", "slew rest", "motor torque"}
    motion.write_text(json.dumps(keys | {"duration": 1}), encoding="utf-8")
    short = run("plan", sat4, "--motion", str(motion), "-o", str(tmp_path / "q.json"))
    assert short.exit_code == 1 and "BOUND_REACH" in short.stdout and not (tmp_path / "q.json").exists()


def test_json_in_float() -> None:
    result = run("verify", DEMO3, "--rigorous", "--states", "3", "--real", "float", "--json")
    assert result.exit_code == 0
    report = json.loads(result.stdout)
    assert (report["passed"], report["count"], report["subject"]) == (True, 3, "float C")
    assert {row["judged"] for row in report["rows"]} == set(wants_of("rigorous")) & set(wants_of_carrier(held=False))
    forward = next(row for row in report["rows"] if row["judged"] == "forward")
    assert (forward["quantity"], forward["verdict"]) == ("V_dot", "ok")
    assert 0 < forward["value"] < forward["limit"] == 1e-5


def test_without_python_flint_one_line_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "flint", None)
    monkeypatch.delitem(sys.modules, "mahovik.proof.verify.rigorous", raising=False)
    said = refused("verify", DEMO3, "--rigorous")
    assert said == 'error: flint is not installed: pip install "mahovik[rigorous]"\n'


SHAKER2 = str(path("shaker2"))
FREE = ("--flywheels", "free")


def test_about_a_state(tmp_path: Path) -> None:
    state = tmp_path / "state.json"
    state.write_text(json.dumps({"V": [1, 0, 0, 0, 0, 0.1], "phi_dot": [10, 0], "phi_ddot": [5, 0]}), encoding="utf-8")
    target = tmp_path / "model.json"
    assert run("modes", SHAKER2, *FREE, "--start", str(state), "--at", "carrier", "-o", str(target)).exit_code == 0
    model = json.loads(target.read_text(encoding="utf-8"))
    assert model["state"]["phi_ddot"] == [5.0, 0.0]
    assert model["state"]["tau"][0] != 0.0
    assert model["A"][0][1] == 0.1  # -<omega>
    assert model["points"] == ["carrier"]
    rest = tmp_path / "rest.json"
    rest.write_text(json.dumps(json.loads(run("check", SHAKER2, "--json").stdout)["rest"]["state"]), encoding="utf-8")
    assert run("modes", SHAKER2, "--start", str(rest), "-o", str(target)).exit_code == 0
    model = json.loads(target.read_text(encoding="utf-8"))
    assert len(model["states"]) == 12
    assert model["points"] == ["carrier"]  # shaker2 has no points


def test_an_unstable_pose_is_named(tmp_path: Path) -> None:
    """The pose with the unbalance up is called unstable, that with the unbalance down is not."""
    state = tmp_path / "state.json"
    for angle, unstable in ((90, True), (270, False)):
        phases = [part for name in ("left", "right") for part in ("--phase", f"{name}={angle} deg")]
        pose = json.loads(run("check", SHAKER2, "--json", *phases).stdout)["rest"]["state"]
        state.write_text(json.dumps(pose), encoding="utf-8")
        said = run("modes", SHAKER2, "--flywheels", "free", "--start", str(state)).stdout
        assert ("warning: unstable" in said) == unstable
