"""`plan --free`: places, mountings, unbalances, inertias move until a motion becomes possible; closed formulas."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import mahovik
from mahovik import Stand, stands
from mahovik.core.motion.motion_file import read_motion
from mahovik.core.stand.numbers import StandNumbers
from mahovik.out.arguments import programme_of
from mahovik.proof.verify.programme.verification import verify_programme
from mahovik.use.numeric.mechanics import Mechanics
from mahovik.use.plan.free import FreeProblem, free_numbers
from mahovik.use.plan.problem import FlywheelMotion, Problem

SHAKER = stands.path("shaker2")
UP: dict[str, Any] = json.loads(SHAKER.with_name("shaker2.motion.json").read_text(encoding="utf-8")) | {
    "winding": "spin"
}
"""0.3 mm along z at 20 Hz."""

CARRIER = {"mass": 6.0, "inertia": [0.05, 0.06, 0.07]}
WHEEL = {"mass": 0.5, "spin_inertia": 0.01, "transverse_inertia": 0.006, "zero": [0, 0, 1]}


def with_wheels(unbalance: dict[str, Any], axes: tuple[int, ...] = (1, 1), **more: Any) -> Stand:
    """Wheels across the y axis, 60 mm to both sides, that turn about +-x."""
    wheels = [
        {
            "name": f"w{k + 1}",
            "position": [0, 0.06 * (1 - 2 * k), 0],
            "axis": [way, 0, 0],
            "unbalance": unbalance,
            **WHEEL,
        }
        for k, way in enumerate(axes)
    ]
    return Stand.from_dict({"schema": 1, "name": "made", "carrier": CARRIER, "flywheel": wheels, **more})


def periodic(row: list[float], **keys: Any) -> dict[str, Any]:
    return {
        "schema": 1,
        "type": "periodic",
        "period": 0.05,
        "harmonics": [{"k": 1, "cos": row}],
        "winding": "spin",
        **keys,
    }


def moved(plan: Any) -> list[tuple[str, str, float, float]]:
    """Path, unit, value before and after of the numbers that moved."""
    return list(zip(*(plan["changes"][name] for name in ("path", "unit", "before", "after")), strict=True))


def judged(stand: Stand, plan: Any, motion: dict[str, Any]) -> None:
    """The literal reference accepts the programme on the stand that results, read anew from its own keys."""
    assert plan.ok and plan["status"] == "OK", plan.messages
    again = Stand.from_dict(plan["stand"])
    assert mahovik.verify(again, programme=plan, motion=motion).ok
    refused = {
        item.quantity
        for item in verify_programme(stand, read_motion(json.dumps(motion), stand), programme_of(plan))
        if item.failed
    }
    assert refused >= {"stand", "residual"}  # on the stand as it was the programme is wrong


def test_two_wheels_out_of_place_move_until_they_shake_along_one_axis() -> None:
    """Places, mountings and unbalances move until +-mu Omega^2 of the pair is the force along z that is needed."""
    stand = mahovik.load(SHAKER).replace({"left.position": [0.03, 0.06, 0.01], "right.position": [-0.02, -0.07, 0.02]})
    bounds = {
        "*t.position": ["-80 mm", "80 mm"],
        "*t.angles": ["-20 deg", "20 deg"],
        "*t.unbalance.static": [0, "3 kg mm"],
    }
    motion = UP | {"free": bounds}
    plan = mahovik.plan(stand, motion=motion, free=list(bounds), seed=2)
    judged(stand, plan, motion)
    Omega = 2 * np.pi * 20
    needed = 3e-4 * abs(7.0 - 1105.398 / Omega**2 + 10j / Omega)
    tables = Mechanics.of(Stand.from_dict(plan["stand"])).tables
    across = tables.unbalance * np.sqrt(1.0 - tables.axis[:, 2] ** 2)
    assert across.sum() == pytest.approx(needed, rel=1e-6)
    ranges = {"position": (0.08, "m"), "angles": (np.radians(20), "rad"), "unbalance": (3e-3, "kg m")}
    assert len(moved(plan)) == 2 * 6
    for path, unit, _, after in moved(plan):
        most, known = next(ranges[key] for key in ranges if key in path)
        assert abs(after) <= most and unit == known


def test_axes_that_stay_parallel_are_no_reason_to_refuse() -> None:
    """Motion and unbalance along both axes are rounding alone."""
    free = {"*t.position": ["-80 mm", "80 mm"], "*t.unbalance.static": [0, "3 kg mm"]}
    motion = UP | {"free": free, "same": [["*t.unbalance.static"]]}
    stand = mahovik.load(SHAKER)
    judged(stand, mahovik.plan(stand, motion=motion, free=list(free)), motion)


def test_products_of_inertia_turn_a_carrier() -> None:
    """Two wheels that turn against each other in free space give J about y its acceleration by 2 U_d Omega^2."""
    stand = with_wheels({"dynamic": 1e-5}, (1, -1))
    motion = periodic([0, 0, 0, 0, 1e-3, 0], free={"w*.unbalance.dynamic": [0, 1e-3], "w*.position": [-0.1, 0.1]})
    plan = mahovik.plan(stand, motion=motion, free=["w*.unbalance.dynamic", "w*.position"])
    judged(stand, plan, motion)
    U = [after for path, _, _, after in moved(plan) if path.endswith("dynamic")]
    J = float(Mechanics.of(Stand.from_dict(plan["stand"])).mean_inertia[4, 4])
    assert sum(U) == pytest.approx(1e-3 * J, rel=2e-3)  # sin of 1 mrad, and what the wheels turn about z


def test_one_wheel_does_on_a_rail_with_the_unbalance_of_the_closed_formula() -> None:
    """The hold takes the force across: mu Omega^2 = |k - m Omega^2 + i d Omega| A."""
    springs = {"stiffness": [0, 0, 20000, 0, 0, 0], "damping": [0, 0, 40, 0, 0, 0]}
    stand = with_wheels({"static": 1e-3}, (1,), gravity=[0, 0, -9.81], hold={"freedoms": ["z"]}, suspension=springs)
    motion = periodic([3e-4], free={"w1.unbalance.static": [0, "3 kg mm"]})
    plan = mahovik.plan(stand, motion=motion, free="w1.unbalance.static")
    judged(stand, plan, motion)
    Omega = 2 * np.pi * 20
    needed = 3e-4 * abs(20000 - 6.5 * Omega**2 + 40j * Omega) / Omega**2
    assert moved(plan)[0][3] == pytest.approx(needed, rel=1e-6) and "at an end" not in str(plan)
    motion["free"]["w1.unbalance.static"][1] = needed * (1.0 + 1e-7)
    assert "move: w1.unbalance.static" in str(mahovik.plan(stand, motion=motion, free="w1.unbalance.static"))


@pytest.mark.slow
def test_eight_wheels_get_the_unbalance_that_the_motion_needs() -> None:
    """A twentieth of this unbalance is too little: the preflight proves that no programme exists."""
    whole = mahovik.load(stands.path("bench8"))
    static = {s.name: s.mass * float(np.hypot(*s.center_of_mass[1:])) for s in whole.flywheels}
    stand = whole.replace({f"{name}.unbalance.static": 0.05 * mu for name, mu in static.items()})
    motion = json.loads(stands.path("bench8").with_name("bench8.motion.json").read_text(encoding="utf-8"))
    motion["free"] = {"w*.unbalance.static": [0, 8e-3]}
    assert mahovik.plan(stand, motion=motion)["reason"] == "FIRST_MOMENT"
    judged(stand, mahovik.plan(stand, motion=motion, free="w*.unbalance.static"), motion)


def test_a_number_of_the_suspension_moves_by_ten_per_cent_of_its_value() -> None:
    """The spring is tuned so that wheels at constant speed give the required amplitude."""
    k = 20000.0
    springs = {"stiffness": [0, 0, k, 0, 0, 0]}
    stand = with_wheels({"static": 1e-3}, (1,), gravity=[0, 0, -9.81], hold={"freedoms": ["z"]}, suspension=springs)
    Omega = 2 * np.pi * 20
    wanted = 1.07 * k
    motion = periodic([1e-3 * Omega**2 / abs(wanted - 6.5 * Omega**2)], bounds={"acceleration": 1e-3})
    plan = mahovik.plan(stand, motion=motion, free="suspension.stiffness[2][2]")
    judged(stand, plan, motion)
    assert moved(plan)[0][3] == pytest.approx(wanted, rel=1e-3)


def test_slopes_are_those_of_differences() -> None:
    """Slopes of residual and bounds by free numbers, waves and bias agree with differences."""
    stand = mahovik.load(SHAKER)
    bounds = {"*t.position": [-0.1, 0.1], "*t.inertia.J12": [-1e-5, 1e-5]}
    limits = {"speed": 126, "acceleration": 10, "torque": 1e-3}
    motion = read_motion(json.dumps(UP | {"free": bounds, "bounds": limits}), stand)
    numbers = StandNumbers(stand, stand.to_dict())
    unknowns = free_numbers(numbers, [*bounds, "carrier.mass"], motion.free)
    assert len(unknowns) == 9
    problem = FreeProblem(stand, numbers, unknowns, Problem.of(stand, motion))
    rng = np.random.default_rng(1)
    y = rng.uniform(*problem.box)
    course = FlywheelMotion(motion.span, np.array([1.0, -1.0]), rng.normal(size=(2, 5)), rng.normal(size=6) * 1e-2)
    grid = problem.start.grid(32, 5)
    J, P, n = problem.slopes(y, course, grid), len(y), course.waves.size

    def rows(x: Any) -> Any:
        return problem.rows(y + x[:P], course.step(x[P:], problem.start.free), grid)

    steps = np.concatenate([problem.size, np.ones(n), np.full(6, 0.1)]) * 1e-5
    for k, h in enumerate(steps[:-6]):  # by the bias, rows of torque are left out: it is small
        e = h * np.eye(len(steps))[k]
        D = (rows(e) - rows(-e)) / (2 * h)
        assert abs(J[:, k] - D).max() <= 1e-4 * abs(D).max() + 1e-9, k


def test_what_moves_together_is_one_unknown() -> None:
    """Vectors element by element, each match of a pattern as one path; bounds are those of all."""
    stand = mahovik.load(SHAKER)
    numbers = StandNumbers(stand, stand.to_dict())
    bounds: dict[str, Any] = {"left.position": [-1, 1], "right.position": ["-10 mm", "20 mm"], "*t.mass": ["400 g", 1]}
    tied = free_numbers(numbers, ["*t.position", "left.mass"], bounds, [["*t.position"], ["left.mass", "right.mass"]])
    assert [(len(unknown.numbers), unknown.low, unknown.high) for unknown in tied] == [(2, -0.01, 0.02)] * 3 + [
        (2, 0.4, 1.0)
    ]
    ten = free_numbers(numbers, ["left.mass"], {})
    assert (ten[0].low, ten[0].high) == pytest.approx((0.45, 0.55))


@pytest.mark.parametrize(
    ("free", "keys", "words"),
    [
        (["left.position[0]"], {}, r"free: left.position\[0\]: its value is 0, .*; expected its bounds"),
        (["lift.mass"], {}, 'lift.mass: shaker2 has no "lift", did you mean "left"'),
        (["left.mass"], {"free": {"left.mass": ["1 m", 2]}}, 'free: left.mass: .*unit "m"'),
        (["left.mass"], {"free": {"left.mass": [2, 1]}}, r"free: left.mass: found \[2, 1\] kg, expected \[low, high\]"),
        (["left.mass"], {"free": {"left.mass": [1]}}, r"free: expected \{path: \[low, high\]"),
        (["left.mass"], {"same": ["left.mass"]}, r"same: expected \[\[path, path"),
        (["*t.mass"], {"same": [["left.mass", "right.position"]]}, "different counts of numbers"),
        (
            ["*t.mass"],
            {"same": [["*t.mass"]], "free": {"left.mass": [1, 2], "right.mass": [3, 4]}},
            "no value is within",
        ),
    ],
)
def test_what_cannot_move_is_refused_in_one_line(free: list[str], keys: dict[str, Any], words: str) -> None:
    with pytest.raises(mahovik.MahovikError, match=words) as refused:
        mahovik.plan(SHAKER, motion=UP | keys, free=free)
    assert str(refused.value).count("\n") == 0


def test_a_motion_beyond_the_bounds_says_how_near_the_search_came_and_what_lacks() -> None:
    motion = UP | {"free": {"*t.unbalance.static": [0, "0.9 kg mm"]}}
    plan = mahovik.plan(SHAKER, motion=motion, free="*t.unbalance.static", time=2)
    assert (plan["status"], plan["reason"], plan["programme"], plan.ok) == ("NO_PROGRAM", "SEARCH", None, False)
    words = next(line for line in plan.messages if "no stand was found" in line)
    assert "widen their bounds" in words
    assert any(line.startswith("the nearest stand: ") for line in plan.messages)
    assert 0.0 < plan["effort"]["best_residual"] < 1.0  # also of starts that are given up


def test_the_stand_that_results_is_the_file_with_other_numbers(tmp_path: Path) -> None:
    """Comments, units and form stay; what is written is the very stand that the programme is for."""
    text = SHAKER.read_text(encoding="utf-8").replace("[0, 0.08, 0]", '["0 mm", "80 mm", 0] # of the left')
    (tmp_path / "old.toml").write_text(text, encoding="utf-8")
    free = {"*t.position": ["-80 mm", "80 mm"], "*t.unbalance.static": [0, "3 kg mm"]}
    motion = UP | {"free": free, "same": [["*t.unbalance.static"]]}
    new = tmp_path / "new.toml"
    plan = mahovik.plan(tmp_path / "old.toml", motion=motion, free=list(free), stand_=new)
    assert mahovik.verify(new, programme=plan, motion=motion).ok
    written = new.read_text(encoding="utf-8")
    assert text.splitlines()[0] in written and ' mm", 0.0' in written and "# of the left" in written
