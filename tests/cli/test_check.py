"""`mahovik check`: its figures, in units that fit, and the numbers of the file as they are written."""

from __future__ import annotations

import json
import math
import re
from pathlib import Path

import pytest

from cli.run import run
from mahovik import stands
from mahovik.core.toolchain.targets import TARGETS

SAT4 = str(stands.path("sat4"))


def table(text: str, head: str) -> dict[str, list[str]]:
    """Rows of the table whose head begins so, by their first cell; cells are two spaces or more apart."""
    lines = iter(text.splitlines())
    next(line for line in lines if line.startswith(f" {head}"))
    next(lines)
    rows = {}
    for line in lines:
        if not line.strip():
            break
        first, *cells = re.split(r" {2,}", line.strip())
        rows[first] = cells
    return rows


def test_all_of_it_is_in_json() -> None:
    document = json.loads(run("check", SAT4, "--json").stdout)
    assert document["total_mass"] == pytest.approx(60.0)
    assert sum(moment["inertia"] for moment in document["principal"]) == pytest.approx(
        sum(document["inertia"][i][i] for i in range(3))
    )
    row = document["unbalance"][1] | document["effects"][1]
    assert (row["static_at"], row["dynamic_at"]) == pytest.approx((math.radians(70), math.radians(-20)))
    assert row["grade"] == "G 0.4" and row["eccentric_velocity"] == pytest.approx(0.3927e-3, rel=1e-4)
    assert document["torque"]["each"] == [0.2] * 4
    assert document["momentum"]["direction"] == pytest.approx(48 / math.sqrt(6), rel=1e-4)
    first = {"key": "unbalance.static", "value": "0.15 g cm", "SI": "1.5e-06 kg m", "of": "rw1, rw2, rw3, rw4"}
    assert first in document["written"]
    assert {"key": "position", "value": "[0, 40, 260] mm", "SI": "[0, 0.04, 0.26] m", "of": "acc1"} in document[
        "written"
    ]
    assert "position" not in document["rest"]["state"] and len(document["rest"]["free"]) == 6


CART = """schema = 1
name = "cart"
gravity = [0, 0, -9.81]
[carrier]
mass = 2
inertia = [0.02, 0.02, 0.02]
[hold]
freedoms = ["x", "yaw"]
pivot = ["3 mm", 0, 0]
angles = [0, "10 deg", 0]
position = [0, 0, 0.5]
[[hold.friction]]
freedom = "x"
viscous = "0.5 N s/m"
coulomb = 1.2
[[hold.stop]]
freedom = "yaw"
at = "60 deg"
stiffness = "2 N m/deg"
[[hold.stop]]
freedom = "yaw"
at = "-60 deg"
stiffness = 40
"""


def test_the_place_of_a_hold_its_friction_and_stops_are_shown_and_in_json(work_folder: Path) -> None:
    (work_folder / "cart.toml").write_text(CART, encoding="utf-8")
    lines = [re.split(r" {2,}", line.strip()) for line in run("check", "cart.toml").stdout.splitlines()]
    for expected in (
        ["hold", "pivot in E1", "0.003", "0", "0", "m"],
        ["hold", "home angles, ship", "0", "10", "0", "deg"],
        ["friction of x", "coulomb", "1.2", "N"],
        ["stop of yaw, above", "stiffness", "114.592", "N m/rad"],
        ["stop of yaw, below", "stiffness", "40", "N m/rad"],
        ["stiffness", "2 N m/deg", "114.592 N m/rad", "hold.stop[0]"],
    ):
        assert expected in lines
    document = json.loads(run("check", "cart.toml", "--json").stdout)
    assert {"by": "friction of x", "number": "coulomb", "value": "1.2", "unit": "N"} in document["hold"]
    assert json.loads(run("check", SAT4, "--json").stdout)["hold"] == []


def test_a_machine_without_anything_is_told_what_to_install(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.delenv("CC", raising=False)
    result = run("check", "--tools", "--json")
    assert result.exit_code == 1
    tools = {tool["what"]: tool for tool in json.loads(result.output)["tools"]}
    assert tools["C compiler"] == {
        "what": "C compiler", "serves": "verify, simulate", "found": "", "install": "apt-get install gcc libc6-dev",
    }  # fmt: skip
    assert tools["qemu-system-arm"]["install"] == f"apt-get install {' '.join(TARGETS['m7'].packages)}"
    assert not any(tool["found"] for tool in tools.values() if not tool["what"].startswith("extra"))
