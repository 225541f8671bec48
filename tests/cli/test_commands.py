"""new, check, derive, and the group itself."""

from __future__ import annotations

import inspect
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
from cli.run import BENCH8, process, refused, run
from mahovik import stands
from mahovik.core.stand import load
from mahovik.out.command_line import make_command, read_docstring
from mahovik.out.commands import COMMANDS


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
