"""new, check, derive, and the group itself."""

from __future__ import annotations

import json
import math
import os
import resource
import subprocess
import sys
from pathlib import Path

import pytest

from cli.run import AUV6, BENCH8, DEMO3, process, refused, run
from mahovik import __version__, stands
from mahovik.core.stand import identities, load
from mahovik.out.cli import main

COMMANDS = ("new", "check", "derive", "generate", "verify", "eval")


def test_help_names_every_command_and_the_exit_statuses() -> None:
    result = run("--help")
    assert result.exit_code == 0
    assert all(f"\n  {command} " in result.output for command in COMMANDS)
    assert "Exit status: 0 good" in result.output
    for command in COMMANDS:
        assert run(command, "--help").exit_code == 0


def test_help_fits_on_a_screen() -> None:
    lines = run("--help").output.splitlines()
    assert len(lines) <= 40
    assert all(len(line) <= 80 for line in lines)
    for command in main.commands:
        assert sum(line.startswith(f"  {command} ") and not line.endswith("...") for line in lines) == 1, command


def test_help_imports_nothing_heavy() -> None:
    done = process("--help", PYTHONPROFILEIMPORTTIME="1")
    assert done.returncode == 0
    for heavy in ("numpy", "sympy", "pydantic", "rich", "cffi", "jinja2"):
        assert f"| {heavy}\n" not in done.stderr
        assert f" {heavy}\n" not in done.stderr


def test_help_answers_at_once() -> None:
    def seconds() -> float:
        """Processor time, since other processes may share the machine."""
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        process("--help")
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime

    assert min(seconds() for _ in range(5)) < 0.25  # 0.07 on an idle machine


def test_version() -> None:
    assert run("--version").output == f"mahovik, version {__version__}\n"


@pytest.mark.parametrize(
    ("word", "hint"),
    [("chek", 'did you mean "check"?'), ("evaluate", 'did you mean "eval"?'), ("qqq", "expected one of")],
)
def test_a_misspelt_command(word: str, hint: str) -> None:
    assert f'no such command "{word}"' in refused(word)
    assert hint in refused(word)


def test_a_misspelt_option() -> None:
    assert "--sped" in refused("check", DEMO3, "--sped", "1")


@pytest.mark.parametrize(
    ("given", "words"),
    [
        (("--nothing",), "--nothing"),
        (("--versoin",), "No such option '--versoin', did you mean '--version'?; see main --help"),
        (("modes",), "Missing argument 'STAND.toml'; see main modes --help"),
        (("modes", DEMO3, "--flywheels", "maybe"), "'maybe' is not one of 'locked', 'free'; see main modes --help"),
        (("export", "servo", DEMO3), "Missing option '--programme'; see main export servo --help"),
        (("export", "sevro", DEMO3), 'no such command "sevro", did you mean "servo"?; see main export --help'),
    ],
)
def test_wrong_usage_is_one_line(given: tuple[str, ...], words: str) -> None:
    said = refused(*given)
    assert said.startswith("error: ")
    assert words in said
    assert said.count("\n") == 1


def test_no_command_is_a_usage_error() -> None:
    assert run().exit_code == 2


def test_new_copies_a_stand_with_its_motions(tmp_path: Path) -> None:
    for name in stands.names():
        result = run("new", name, "-o", str(tmp_path))
        assert result.exit_code == 0
        assert len(result.output.splitlines()) == 1 + len(stands.motions(name)) + len(stands.servos(name))
        assert load(tmp_path / f"{name}.toml") == load(stands.path(name))
        for motion in stands.motions(name):
            assert (tmp_path / motion.name).read_text() == motion.read_text()


def test_new_under_another_name(tmp_path: Path) -> None:
    assert run("new", "bench8", "-o", str(tmp_path / "deep" / "mine.toml")).exit_code == 0
    assert sorted(p.name for p in (tmp_path / "deep").iterdir()) == [
        "mine.motion.json",
        "mine.servo.toml",
        "mine.toml",
    ]


def test_new_names_the_stand_after_its_file(tmp_path: Path) -> None:
    assert run("new", "bench8", "-o", str(tmp_path / "mine.toml")).stderr == ""
    assert load(tmp_path / "mine.toml").name == "mine"
    said = run("new", "bench8", "-o", str(tmp_path / "my-stand.toml"))
    assert said.exit_code == 0 and load(tmp_path / "my-stand.toml").name == "bench8"
    assert said.stderr.startswith('note: the stand is still named bench8, since "my-stand" is not a C identifier')
    assert said.stderr.endswith("give another by --name\n")
    assert run("new", "bench8", "--name", "other", "-o", str(tmp_path / "third.toml")).stderr == ""
    assert load(tmp_path / "third.toml").name == "other"


def test_new_overwrites_nothing(tmp_path: Path) -> None:
    (tmp_path / "bench8.motion.json").write_text("mine")
    assert "exists already, nothing was written" in refused("new", "bench8", "-o", str(tmp_path))
    assert [p.name for p in tmp_path.iterdir()] == ["bench8.motion.json"]
    assert (tmp_path / "bench8.motion.json").read_text() == "mine"


@pytest.mark.parametrize("name", stands.names())
def test_new_names_the_stand(name: str, tmp_path: Path) -> None:
    assert run("new", name, "--name", "mine", "-o", f"{tmp_path}/").exit_code == 0
    assert load(tmp_path / "mine.toml").name == "mine"
    assert "--name: " in refused("new", name, "--name", "no name", "-o", f"{tmp_path}/")


def test_new_lists_and_refuses_unknown_names() -> None:
    listed = run("new", "--list")
    assert [line.split()[0] for line in listed.output.splitlines()] == list(stands.names())
    assert all(line.endswith(".") for line in listed.output.splitlines())
    assert "unbalance within its data-sheet limits does to an accelerometer." in listed.output
    assert 'no example stand "bench9"' in refused("new", "bench9")
    assert "which example?" in refused("new")


def test_check_prints_figures() -> None:
    text = run("check", BENCH8).output
    names = identities(load(BENCH8))
    assert f"structure {names.structure}, physics {names.physics}" in text
    for words in ("carrier", "w8", "18.39", "static, g mm", "dynamic, g mm2", "reach of force: 3783.7 N"):
        assert words in text
    assert "warning" not in text


def test_check_warns_where_the_singularity_is_a_heading() -> None:
    assert "warning:" in run("check", AUV6).output
    assert "it is a heading" in run("check", AUV6).output


def test_check_as_json() -> None:
    found = json.loads(run("check", AUV6, "--json").output)
    assert found["mass"] == pytest.approx(50.0)
    assert found["unbalance"][0]["speed"] == pytest.approx(100 * math.pi)
    assert found["warnings"]


@pytest.mark.parametrize(("text", "speed"), [("6000 rpm", 200 * math.pi), ("12.5", 12.5), ("-1 rad/s", 1.0)])
def test_check_at_a_speed(text: str, speed: float) -> None:
    found = json.loads(run("check", BENCH8, "--json", "--speed", text).output)
    assert [row["speed"] for row in found["unbalance"]] == pytest.approx([speed] * 8)


@pytest.mark.parametrize("text", ["fast", "3000 mm", "nan", "inf", "1e300 rpm", ""])
def test_check_at_a_speed_that_is_none(text: str) -> None:
    assert refused("check", BENCH8, "--speed", text).startswith("error: --speed: ")


def test_tables_are_not_cut_when_piped() -> None:
    done = process("check", BENCH8, COLUMNS="40", TERM="dumb")
    assert done.returncode == 0
    assert "…" not in done.stdout
    assert max(map(len, done.stdout.splitlines())) > 100
    assert "\x1b" not in done.stdout


def test_derive_refuses_other_kinds_of_file() -> None:
    assert "expected a name that ends in .html or .tex" in refused("derive", DEMO3, "-o", "x.pdf")


@pytest.mark.parametrize(
    "command", [("check",), ("derive",), ("generate",), ("verify",), ("eval", "--backend", "numpy")]
)
@pytest.mark.parametrize(
    ("content", "words"),
    [
        (None, "no such file"),
        (b"", "required, but missing"),
        (b"[[[", "not TOML"),
        (b"\xff\xfe", "not UTF-8"),
        (b"schema = 1\nname = 'a b'\n", "is not a C identifier"),
    ],
)
def test_a_bad_stand_file(command: tuple[str, ...], content: bytes | None, words: str, tmp_path: Path) -> None:
    file = tmp_path / "bad.toml"
    if content is not None:
        file.write_bytes(content)
    said = refused(*command, str(file))
    assert words in said
    assert all(line.startswith("error: ") for line in said.splitlines())


def test_a_folder_is_no_stand_file(tmp_path: Path) -> None:
    assert "is a directory" in refused("check", str(tmp_path))


def test_every_problem_of_a_stand_is_one_line(tmp_path: Path) -> None:
    text = Path(DEMO3).read_text().replace("mass =", "mas =")
    (tmp_path / "bad.toml").write_text(text)
    lines = refused("check", str(tmp_path / "bad.toml")).splitlines()
    assert len(lines) >= 4
    assert all(line.startswith("error: bad.toml: ") for line in lines)


@pytest.mark.parametrize(("given", "used"), [(None, "1"), ("3", "3")])
def test_linear_algebra_has_one_thread_unless_told_otherwise(given: str | None, used: str) -> None:
    program = (
        "import os, sys; sys.argv = ['mahovik', '--version']; from mahovik.__main__ import run\n"
        "try: run()\n"
        "except SystemExit: print([os.environ[f'{of}_NUM_THREADS'] for of in ('OMP', 'OPENBLAS', 'MKL')])"
    )
    environment = {name: value for name, value in os.environ.items() if not name.endswith("_NUM_THREADS")}
    environment |= {} if given is None else {f"{of}_NUM_THREADS": given for of in ("OMP", "OPENBLAS", "MKL")}
    done = subprocess.run([sys.executable, "-c", program], env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines()[-1] == str([used] * 3)
