"""eval as a process: pipes, conversation, exit statuses; of held carriers too."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from tempfile import gettempdir
from typing import Any

import numpy as np
import pytest

from cli.run import BENCH8, DEMO3, PROGRAM, process, run
from verify.holds import PENDULUM

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


def pendulum_file(folder: Path) -> str:
    path = folder / "pendulum.toml"
    path.write_text(PENDULUM)
    return str(path)


@pytest.fixture
def file(tmp_path: Path) -> str:
    return pendulum_file(tmp_path)


def answers(file: str, *lines: dict[str, Any], backend: str = "numpy", status: int = 0) -> list[dict[str, Any]]:
    stdin = "\n".join(map(json.dumps, lines))
    result = run("eval", file, "--backend", backend, stdin=stdin)
    assert result.exit_code == status, result.output
    return [json.loads(line) for line in result.stdout.splitlines() if line.startswith("{")]


@pytest.mark.parametrize("backend", ["numpy", "casadi", "c"])
def test_a_pendulum_falls_as_it_should(file: str, backend: str) -> None:
    angle, u = 0.3, 1.5
    state = {"angles": [0, angle, 0], "u": [u], "phi_ddot": [40.0]}
    (answer,) = answers(file, {**state, "want": ["forward", "points"], "u_dot": [0.7]}, backend=backend)
    moment = 2.5 * 9.81 * 0.2 * np.sin(angle)  # the mass centre is over the pivot at angle 0
    spin = 0.001
    expected = (moment - spin * 40.0) / (0.02 + 2.5 * 0.2**2 + spin)
    assert answer["u_dot"] == pytest.approx([expected], rel=1e-13)
    assert answer["V_dot"] == pytest.approx([0.2 * expected, 0, 0, 0, expected, 0], rel=1e-13)
    # force of the pivot: mass times the acceleration of the mass centre, less the weight, in E1
    weight = 2.5 * 9.81 * np.array([np.sin(angle), 0, -np.cos(angle)])
    force = 2.5 * np.array([0.2 * expected, 0, -0.2 * u**2]) - weight
    assert answer["reaction"][:3] == pytest.approx(force, rel=1e-13, abs=1e-13)
    assert answer["points"]["tip"]["twist"] == pytest.approx([0.3 * u, 0, 0, 0, u, 0], rel=1e-13)


@pytest.mark.parametrize("backend", ["numpy", "c"])
def test_the_hold_carries_the_carrier_and_what_its_mounts_carry(file: str, backend: str) -> None:
    """For a given motion the reaction is m a - m g of the 2 kg at O1 and the wrench of the mount."""
    angle, u, u_dot = 0.3, 1.5, 0.7
    state = {"angles": [0, angle, 0], "u": [u], "u_dot": [u_dot], "phi": [0.7], "phi_dot": [200.0]}
    (answer,) = answers(file, {**state, "want": ["reaction", "mounts", "torque"]}, backend=backend)
    down = 9.81 * np.array([np.sin(angle), 0.0, -np.cos(angle)])
    alone = 2.0 * (np.array([0.2 * u_dot, 0.0, -0.2 * u**2]) - down)
    (mount,) = np.array(answer["mount_wrench"])
    in_E1 = np.array([mount[2], mount[0], mount[1]])  # its axes are y, z, x of E1
    assert np.array(answer["reaction"][:3]) == pytest.approx(alone + in_E1, rel=1e-12, abs=1e-12)
    assert in_E1 == pytest.approx(0.25 * alone, rel=1e-12, abs=1e-12)
    assert mount[3] == pytest.approx(answer["tau"][0], rel=1e-12)


def test_the_reaction_of_no_motion_is_an_error_line(file: str, tmp_path: Path) -> None:
    """A missing u_dot is not that of the free motion, nor zero; a clamped carrier has none to give."""
    (missing,) = answers(file, {"angles": [0, 0.3, 0], "want": ["reaction"]}, status=1)
    assert missing["error"].startswith(
        'u_dot: missing, but "reaction" is that of a given motion, expected 1 number; ask'
    )
    (still,) = answers(file, {"angles": [0, 0.3, 0], "u_dot": [0.0], "want": ["reaction"]})
    R = still["reaction"]  # along the freedom: what a drive would hold it with
    assert 0.2 * R[0] + R[4] == pytest.approx(-2.5 * 9.81 * 0.2 * np.sin(0.3), rel=1e-12)
    clamped = tmp_path / "clamped.toml"
    clamped.write_text(PENDULUM.replace('freedoms = ["pitch"]\npivot = [0, 0, -0.2]\n', "freedoms = []\n"))
    (answer,) = answers(str(clamped), {"want": ["reaction"]})
    assert answer["reaction"][2] == pytest.approx(2.5 * 9.81)
