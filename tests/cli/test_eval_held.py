"""`mahovik eval` and `generate` of a held carrier, and its error lines."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from cli.run import refused, run

TEXT = """
schema = 1
name = "pendulum"
gravity = [0, 0, -9.81]
[hold]
freedoms = ["pitch"]
pivot = [0, 0, -0.2]
[carrier]
mass = 2
inertia = [0.02, 0.02, 0.01]
[[flywheel]]
name = "w1"
axis = [0, 1, 0]
zero = [0, 0, 1]
mass = 0.5
spin_inertia = 0.001
transverse_inertia = 0.0006
[[point]]
name = "tip"
position = [0, 0, 0.1]
"""
INERTIA = 0.02 + 0.0006 + 2.5 * 0.2**2
"""About the pivot, kg m2, less the flywheel's own about its axis."""


@pytest.fixture
def file(tmp_path: Path) -> str:
    path = tmp_path / "pendulum.toml"
    path.write_text(TEXT)
    return str(path)


def answers(file: str, *lines: dict[str, Any], backend: str = "numpy", status: int = 0) -> list[dict[str, Any]]:
    stdin = "\n".join(map(json.dumps, lines))
    result = run("eval", file, "--backend", backend, stdin=stdin)
    assert result.exit_code == status, result.output
    return [json.loads(line) for line in result.stdout.splitlines() if line.startswith("{")]


@pytest.mark.parametrize("backend", ["numpy", "casadi", "c"])
def test_a_pendulum_falls_as_it_should(file: str, backend: str) -> None:
    angle, u = 0.3, 1.5
    state = {"angles": [0, angle, 0], "u": [u], "phi_ddot": [40.0]}
    (found,) = answers(file, {**state, "want": ["forward", "points"], "u_dot": [0.7]}, backend=backend)
    moment = 2.5 * 9.81 * 0.2 * np.sin(angle)  # the mass centre is over the pivot at angle 0
    spin = 0.001
    expected = (moment - spin * 40.0) / (0.02 + 2.5 * 0.2**2 + spin)
    assert found["u_dot"] == pytest.approx([expected], rel=1e-13)
    assert found["V_dot"] == pytest.approx([0.2 * expected, 0, 0, 0, expected, 0], rel=1e-13)
    # force of the pivot: mass times the acceleration of the mass centre, less the weight, in E1
    weight = 2.5 * 9.81 * np.array([np.sin(angle), 0, -np.cos(angle)])
    force = 2.5 * np.array([0.2 * expected, 0, -0.2 * u**2]) - weight
    assert found["reaction"][:3] == pytest.approx(force, rel=1e-13, abs=1e-13)
    assert found["points"]["tip"]["twist"] == pytest.approx([0.3 * u, 0, 0, 0, u, 0], rel=1e-13)


@pytest.mark.parametrize("backend", ["numpy", "c"])
def test_the_hold_carries_the_carrier_and_what_its_mounts_carry(file: str, backend: str) -> None:
    """For a motion that is given: force on the carrier alone, m a - m g of 2 kg at O1, and that of the mount."""
    angle, u, u_dot = 0.3, 1.5, 0.7
    state = {"angles": [0, angle, 0], "u": [u], "u_dot": [u_dot], "phi": [0.7], "phi_dot": [200.0]}
    (found,) = answers(file, {**state, "want": ["reaction", "mounts", "torque"]}, backend=backend)
    down = 9.81 * np.array([np.sin(angle), 0.0, -np.cos(angle)])
    alone = 2.0 * (np.array([0.2 * u_dot, 0.0, -0.2 * u**2]) - down)
    (mount,) = np.array(found["mount_wrench"])
    in_E1 = np.array([mount[2], mount[0], mount[1]])  # its axes are y, z, x of E1
    assert np.array(found["reaction"][:3]) == pytest.approx(alone + in_E1, rel=1e-12, abs=1e-12)
    assert in_E1 == pytest.approx(0.25 * alone, rel=1e-12, abs=1e-12)
    assert mount[3] == pytest.approx(found["tau"][0], rel=1e-12)


@pytest.mark.parametrize("backend", ["numpy", "casadi", "c"])
def test_the_reaction_of_a_motion_that_is_given(file: str, backend: str) -> None:
    """The motion that `forward` finds has the same reaction; a faster one asks the hold for its inertia."""
    state = {"angles": [0, 0.3, 0], "u": [1.5], "phi": [0.7], "phi_dot": [200.0], "phi_ddot": [40.0]}
    (moved,) = answers(file, {**state, "want": ["forward"]}, backend=backend)
    u_dot = moved["u_dot"][0]
    more = [{**state, "u_dot": [u_dot + extra], "want": ["reaction"]} for extra in (0.0, 2.0)]
    own, faster = (np.array(found["reaction"]) for found in answers(file, *more, backend=backend))
    assert own == pytest.approx(moved["reaction"], rel=1e-12, abs=1e-12)
    inertia = 0.02 + 2.5 * 0.2**2 + 0.001  # about the pivot; the mass centre is above it by 200 mm
    assert (faster - own)[4] + 0.2 * (faster - own)[0] == pytest.approx(2.0 * inertia, rel=1e-12)
    assert (faster - own)[0] == pytest.approx(2.0 * 2.5 * 0.2, rel=1e-12)


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
    clamped.write_text(TEXT.replace('freedoms = ["pitch"]\npivot = [0, 0, -0.2]\n', "freedoms = []\n"))
    (found,) = answers(str(clamped), {"want": ["reaction"]})
    assert found["reaction"][2] == pytest.approx(2.5 * 9.81)


def test_a_free_carrier_and_two_reactions_in_one_want_are_error_lines(file: str, tmp_path: Path) -> None:
    (found,) = answers(file, {"want": ["forward", "reaction"]}, status=1)
    assert found["error"] == 'want: "forward" and "reaction" both give reaction, ask for them in two states'
    free = tmp_path / "free.toml"
    free.write_text(TEXT.replace('[hold]\nfreedoms = ["pitch"]\npivot = [0, 0, -0.2]\n', ""))
    (found,) = answers(str(free), {"want": ["reaction"]}, status=1)
    assert found["error"] == 'want: "reaction" is of held carriers, and the stand has no [hold]: ask for forward'


@pytest.mark.parametrize("backend", ["numpy", "c"])
def test_inverse_turns_the_demand_into_the_flywheel(file: str, backend: str) -> None:
    state = {"angles": [0, 0.3, 0], "u": [0.4], "u_dot": [2.0]}
    (found,) = answers(file, {**state, "want": ["inverse", "torque"]}, backend=backend)
    assert found["rank"] == 1 and found["status"] == "OK" and len(found["sigma"]) == len(found["residual"]) == 1
    back = {**state, "phi_ddot": found["phi_ddot"], "want": ["forward"]}
    assert answers(file, back, backend=backend)[0]["u_dot"] == pytest.approx([2.0], rel=1e-12)


@pytest.mark.parametrize(
    ("given", "reason"),
    [
        ({"V": [0, 0, 0, 0, 1, 0]}, "V: the carrier is held, expected u, 1 number"),
        ({"V_dot": [0, 0, 0, 0, 1, 0]}, "V_dot: the carrier is held, expected u_dot, 1 number"),
        ({"u": [1, 2]}, "u: expected 1 number, found 2"),
        ({"u": [1e6]}, "out of range"),
        ({"u_dot": [float("nan")]}, "u_dot[0]: NaN is not finite"),
        ({"want": ["forward", "coupled"]}, "ask for them in two states"),
    ],
)
@pytest.mark.parametrize("backend", ["numpy", "casadi", "c"])
def test_a_state_that_does_not_fit_is_an_error_line(
    file: str, given: dict[str, Any], reason: str, backend: str
) -> None:
    (found,) = answers(file, {"want": ["forward"], **given}, backend=backend, status=1)
    assert reason in found["error"]


def test_a_project_for_a_board_is_written(file: str, tmp_path: Path) -> None:
    folder = tmp_path / "board"
    assert run("export", "target", file, "--target", "m4", "-o", str(folder)).exit_code == 0
    assert "reaction" in (folder / "verification/pendulum_selftest.c").read_text()
    assert "typedef float" in (folder / "pendulum.h").read_text()


def test_a_free_carrier_has_no_u(tmp_path: Path) -> None:
    free = tmp_path / "free.toml"
    free.write_text(TEXT.replace('[hold]\nfreedoms = ["pitch"]\npivot = [0, 0, -0.2]\n', ""))
    (found,) = answers(str(free), {"u": [1.0], "want": ["forward"]}, status=1)
    assert found["error"] == "u: the stand has no [hold], expected V"


HINGE = TEXT.replace('freedoms = ["pitch"]', "axis = [0, 1, 1]")


def test_lists_say_what_a_freedom_is_that_goes_by_its_place(tmp_path: Path) -> None:
    """`1` of an `axis` is said in words wherever people read it; columns and coordinates keep their names."""
    file, words = tmp_path / "hinge.toml", "1 is turning about (0, 0.707107, 0.707107)"
    friction = "\n[[hold.friction]]\nviscous = 0.1\n"
    file.write_text(HINGE + friction)
    place = str(file)
    assert f"q_{words}" in " ".join(run("modes", place).stdout.split())
    done = run("linearize", place, "-o", str(tmp_path / "m.json"))
    assert done.exit_code == 0 and f"q_{words}" in done.stdout
    assert '"q_1"' in (tmp_path / "m.json").read_text()
    table = tmp_path / "run.csv"
    done = run("simulate", place, "--until", "0.01", "--backend", "scipy", "-o", str(table))
    assert done.exit_code == 0 and f"q {words}" in done.stdout
    assert "q 1 [rad]" in table.read_text().splitlines()[0]
    done = run("response", place, "--speed", "w1=100", "--at", "hold.1")
    assert done.exit_code == 0 and f"hold.{words}" in " ".join(done.stdout.split())
    assert "friction of 1 (turning about (0, 0.707107, 0.707107))" in " ".join(run("check", place).stdout.split())
    file.write_text(HINGE + friction.replace("viscous", 'freedom = "pitch"\nviscous'))
    assert f"{words}" in refused("check", place)


TURN = {"schema": 1, "name": "turn", "type": "periodic", "period": 1.0}


@pytest.mark.parametrize(
    ("text", "cos", "reason"),
    [
        (
            '["pitch"]',
            [0, 0, 0, 0.1, 0, 0],
            "asks for motion along yaw, which [hold] blocks; expected its freedoms",
        ),
        ('["z", "yaw"]', [0, 0.1, 0, 0, 0, 0], "m.json: asks for motion along y, which [hold] blocks"),
        ('["pitch"]', [0.01, 0, 0, 0, 0.1, 0], "m.json: asks for motion along x, which [hold] blocks"),
        ('["yaw"]', [0.1, 0.1], "cos: expected 1 number (yaw), found 2"),
        ("[]", [0, 0, 0, 0.1, 0, 0], "hold: no freedoms: clamped"),
    ],
)
def test_a_plan_of_what_is_blocked_names_the_direction(
    file: str, text: str, cos: list[float], reason: str, tmp_path: Path
) -> None:
    held = TEXT.replace('["pitch"]', text)
    Path(file).write_text(held if text != "[]" else held.replace("pivot = [0, 0, -0.2]\n", ""))
    (tmp_path / "m.json").write_text(json.dumps(TURN | {"harmonics": [{"k": 1, "cos": cos}]}))
    message = refused("plan", file, "--motion", str(tmp_path / "m.json"), "-o", str(tmp_path / "p.json"))
    assert reason in message and len(message.strip().splitlines()) == 1
    assert not (tmp_path / "p.json").exists()


def test_check_says_how_it_moves(file: str) -> None:
    assert "held, 1 freedom, pitch; a closed set" in run("check", file).output
    found = json.loads(run("check", file, "--json").stdout)
    assert found["hold"].startswith("1 freedom, pitch")
