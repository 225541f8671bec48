"""eval as a process: pipes, conversation, exit statuses."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from tempfile import gettempdir
from typing import Any

import pytest

from cli.run import BENCH8, DEMO3, PROGRAM, process, run

GOOD = '{"id": 1, "want": ["forward"]}\n'


def lines(text: str) -> list[dict[str, Any]]:
    return [json.loads(line, parse_constant=pytest.fail) for line in text.splitlines()]


@pytest.mark.parametrize("backend", ["c", "numpy"])
def test_good_states_are_status_0_and_a_bad_one_is_1(backend: str) -> None:
    result = run("eval", DEMO3, "--backend", backend, stdin=GOOD)
    assert result.exit_code == 0
    assert set(lines(result.stdout)[0]) == {"id", "V_dot"}
    mixed = run("eval", DEMO3, "--backend", backend, stdin=GOOD + "\nnope\n" + GOOD.replace("1", "2"))
    assert mixed.exit_code == 1
    assert [line["id"] for line in lines(mixed.stdout)] == [1, None, 2]
    assert "1 of the states cannot be evaluated" in mixed.stderr


def rigid_body(folder: Path) -> str:
    """A stand without flywheels: its C has nothing to invert."""
    path = folder / "brick.toml"
    path.write_text('schema = 1\nname = "brick"\n[carrier]\nmass = 2.0\ninertia = [0.1, 0.2, 0.25]\n')
    return str(path)


def test_a_stand_without_flywheels_has_every_want(tmp_path: Path) -> None:
    state = '{"id": 5, "V_dot": [1, 0, 0, 0, 0, 0], "want": ["inverse"]}\n{"want": ["forward"]}\n'
    result = run("eval", rigid_body(tmp_path), stdin=state)
    assert result.exit_code == 0
    first, second = lines(result.stdout)
    assert (first["id"], first["phi_ddot"], first["status"]) == (5, [], "UNREACHABLE")
    assert "V_dot" in second


def test_no_compiler_is_one_line_that_says_what_to_install() -> None:
    done = process("eval", DEMO3, stdin=GOOD, PATH="", CC="")
    assert done.returncode == 2
    assert done.stdout == ""
    assert done.stderr.startswith("error: no C compiler found")
    assert len(done.stderr.splitlines()) == 1


def test_a_conversation_is_answered_line_by_line() -> None:
    command = [sys.executable, "-c", PROGRAM, "eval", DEMO3, "--backend", "numpy"]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, bufsize=1) as program:
        assert program.stdin is not None
        assert program.stdout is not None
        for number in range(3):
            program.stdin.write(json.dumps({"id": number, "want": ["momentum"]}) + "\n")
            program.stdin.flush()
            assert json.loads(program.stdout.readline())["id"] == number
        program.stdin.close()
        assert program.wait(30) == 0


@pytest.mark.parametrize("command", [("check", BENCH8), ("check", BENCH8, "--json"), ("eval", "--help"), ("--help",)])
def test_a_closed_reader_is_no_failed_check(command: tuple[str, ...]) -> None:
    """The status is 141, as of a program that SIGPIPE ends; 1 would say that a check failed."""
    reader, writer = os.pipe()
    os.close(reader)
    done = subprocess.run(
        [sys.executable, "-m", "mahovik", *command], stdout=writer, stderr=subprocess.PIPE, check=False, timeout=60
    )
    os.close(writer)
    assert (done.returncode, done.stderr) == (141, b"")


def test_a_full_disk_is_said_with_where_it_may_be() -> None:
    """Neither standard output nor a temporary file has a name."""
    with open("/dev/full", "wb") as full:
        command = [sys.executable, "-m", "mahovik", "check", DEMO3]
        done = subprocess.run(command, stdout=full, stderr=subprocess.PIPE, text=True, check=False, timeout=60)
    assert done.returncode == 2 and done.stderr.endswith(f"{gettempdir()}: No space left on device\n")
