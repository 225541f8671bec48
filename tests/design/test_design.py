"""Designs of free and held carriers: numbers of a stand as unknowns, closed formulas, sensitivities, refusals."""

from __future__ import annotations

import json
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from mahovik import stands
from mahovik.core.motion.motion_file import load_motion, read_motion
from mahovik.core.motion.required import Bounds, RequiredMotion
from mahovik.core.stand import load, loads
from mahovik.core.stand.model import Flywheel, Stand
from mahovik.core.stand.random import EVERYTHING, random_stand
from mahovik.core.stand.write import dumps
from mahovik.errors import DesignError, MahovikError
from mahovik.laws.suspension.law import Suspension
from mahovik.use.design import DesignOptions, Outcome, design_stand, freedom_of_keys
from mahovik.use.design.freedom import WIDTH, Freedom, Limits, Mask, Tie, Weights
from mahovik.use.design.outcome import as_object, summary
from mahovik.use.design.read import read_freedom
from mahovik.use.design.search import Cost, Point, Search, pareto_points
from mahovik.use.design.space import Space, flywheel_numbers
from mahovik.use.design.task import Design, Task, Weighing
from mahovik.use.numeric import Mechanics, Norm, mount_axes, prescribe, residual
from mahovik.use.plan.problem import Periodic, uniform
from plan.problems import required

FREE = """
schema = 1
speed = [-1, 1]
harmonics = 1
quality = 1e-9
[[free]]
position = { min = ["-80 mm", "-80 mm", "-80 mm"], max = ["80 mm", "80 mm", "80 mm"] }
angles = { min = ["-20 deg", "-20 deg"], max = ["20 deg", "20 deg"] }
unbalance = { min = 0, max = "3 kg mm" }
[limits]
distance = "100 mm"
"""


def shaker() -> Stand:
    """shaker2 with its flywheels out of place."""
    stand = load(stands.path("shaker2"))
    places = ((0.03, 0.06, 0.01), (-0.02, -0.07, 0.02))
    wheels = tuple(replace(w, position=p) for w, p in zip(stand.flywheels, places, strict=True))
    return replace(stand, flywheels=wheels)


def motion_of(stand: Stand) -> RequiredMotion:
    """0.3 mm along z at 20 Hz."""
    return load_motion(stands.path("shaker2").with_name("shaker2.motion.json"), stand)


def freedom(text: str = FREE, **changes: str) -> Freedom:
    """Free numbers of the shaker, with words of FREE changed."""
    for old, new in changes.items():
        text = text.replace(old, new)
    return read_freedom(text, shaker())


def all_free(stand: Stand, **more: Any) -> Freedom:
    """Everything of every flywheel, within wide bounds."""
    now = np.array([flywheel_numbers(s) for s in stand.flywheels])
    span = np.array([0.3] * 3 + [np.inf] * 2 + [1.0, np.inf, 1.0, 0.5])
    least, most = now - span, now + span
    least[:, 5:] = np.maximum(least[:, 5:], [0.0, -np.inf, 1e-2, 0.5])
    free: Mask = np.ones((len(now), WIDTH), dtype=bool)
    return replace(Freedom(least, most, free), **more)


@pytest.mark.parametrize("seed", range(2))
def test_the_stand_as_it_is_has_a_place_among_the_designs(seed: int) -> None:
    """Angles or axes, on carrier or instrument, inertia about any point: the same tables."""
    stand = random_stand(np.random.default_rng(seed), 3, EVERYTHING)
    space = Space.of(stand, all_free(stand))
    assert space.P == 3 * WIDTH
    built = space.stand_of(space.start)
    for ours, original in zip(built.flywheels, stand.flywheels, strict=True):
        assert abs(mount_axes(ours) - mount_axes(original)).max() <= 1e-14
    rebuilt, known = Mechanics.of(built).tables, Mechanics.of(stand).tables
    assert abs(rebuilt.Theta - known.Theta).max() <= 1e-13 * abs(known.Theta).max()
    assert abs(rebuilt.weight - known.weight).max() <= 1e-13 * abs(known.weight).max()


def test_ties_make_flywheels_alike() -> None:
    """Mirrored through each plane; equal in mass; a third that hangs on the second."""
    stand = random_stand(np.random.default_rng(8), 3)
    for axis, name in enumerate("xyz"):
        ties = (Tie((0, 1), ("unbalance", "mass"), name), Tie((1, 2), ("mass",), None))
        loose = all_free(stand, ties=ties)
        loose.least[:], loose.most[:] = loose.least.min(axis=0), loose.most.max(axis=0)
        loose.least[:, :3], loose.most[:, :3] = -0.3, 0.3
        space = Space.of(stand, loose)
        assert space.P == 3 * WIDTH - 5 - 3
        first, second, third = space.stand_of(space.random(np.random.default_rng(axis))).flywheels
        mirror = np.where(np.arange(3) == axis, -1.0, 1.0)
        assert np.allclose(second.position, mirror * first.position, atol=1e-15)
        assert np.allclose(mount_axes(second)[:, 0], mirror * mount_axes(first)[:, 0], atol=1e-15)
        assert first.mass == pytest.approx(second.mass) == pytest.approx(third.mass)


def test_rows_have_the_derivatives_of_differences() -> None:
    """Residual, limits of the whole, bounds of the motion, cost: by every unknown."""
    stand = random_stand(np.random.default_rng(21), 2, EVERYTHING)
    bounds = Bounds(speed=(30.0,) * 2, torque=(1e-3,) * 2, acceleration=(1.0,) * 2, angle=(0.01,) * 2)
    motion = required(2, bounds=bounds)
    mass = sum(s.mass for s in stand.flywheels)
    ties = (Tie((0, 1), ("unbalance",), None),)
    free = all_free(stand, limits=Limits(10.0, 0.1 * mass, 1e-4), ties=ties)
    task = Task.of(stand, motion, free)
    rng = np.random.default_rng(1)
    course = Periodic(motion.span, np.array([1.0, -1.0]), rng.normal(size=(2, 3)), np.zeros(6))
    design = Design(task.space.random(rng), course)
    weighing = Weighing(1.0, 0.7, 0.3)
    J, z = task.jacobian(design, weighing), task.pack(design)
    for k in range(len(z) - int(task.start.free.sum())):  # by the bias, rows of torque are left out: it is small
        e = 1e-6 * np.eye(len(z))[k]
        around = [task.rows(task.unpack(z + sign * e, course), weighing) for sign in (1.0, -1.0)]
        D = (around[0] - around[1]) / 2e-6
        rounding = 1e-9 * abs(around[0]).max()  # of differences of the largest rows, divided by the step
        assert abs(J[:, k] - D).max() <= 2e-5 * max(abs(D).max(), 1e-3) + rounding, k


@cache
def one_axis() -> Outcome:
    """The shaker's design, once."""
    return design_stand(shaker(), motion_of, freedom(), DesignOptions(seed=2, starts=20))


@pytest.mark.slow
def test_two_flywheels_for_one_axis() -> None:
    """Exact, verified, inside bounds and limits, with the least unbalance that there is; the file says the same."""
    design = one_axis()
    assert (design.status, design.words) == ("OK", ())
    assert design.residual < 1e-9
    assert design.stand is not None
    assert design.programme is not None
    assert design.programme.report["verified"] is True
    assert loads(dumps(design.stand)) == design.stand
    assert design.totals["after"]["nearest"]["distance"] >= 0.1
    places = np.array([s.position for s in design.stand.flywheels])
    assert abs(places).max() <= 0.08
    # +-mu Omega^2 of each pair is the whole force that moves mass and suspension: nothing is wasted across
    Omega = 2 * np.pi * 20
    needed = 3e-4 * abs(7.0 - 1105.398 / Omega**2 + 10j / Omega)
    assert design.totals["after"]["unbalance"] == pytest.approx(needed, rel=2e-3)


def test_sensitivities_are_those_of_stands_that_are_built_so() -> None:
    """1 mm and 1 g mm of error: the residual that the programme then has."""
    design = one_axis()
    built, programme = design.stand, design.programme
    assert built is not None
    assert programme is not None
    motion = motion_of(built)
    t = uniform(motion.span, 256)
    changes = {(change.flywheel, change.name): change for change in design.changes}
    assert len(changes) == 2 * 7

    def relative(wheel: Flywheel) -> float:
        stand = replace(built, flywheels=(wheel, built.flywheels[1]))
        at = prescribe(Mechanics.of(stand), motion.at(t), np.array(programme.bias))
        angles = programme.at(t)
        norm = Norm.of(prescribe(Mechanics.of(built), motion.at(t)), motion.span)
        return norm.relative(residual(at, angles.phi, angles.phi_dot, angles.phi_ddot))

    wheel = built.flywheels[0]
    x, y, z = wheel.position
    along, y_c, z_c = wheel.center_of_mass
    longer = 1.0 + 1e-6 / (wheel.mass * float(np.hypot(y_c, z_c)))
    moved = relative(replace(wheel, position=(x, y + 1e-3, z)))
    heavier = relative(replace(wheel, center_of_mass=(along, longer * y_c, longer * z_c)))
    assert changes["left", "y"].sensitivity == pytest.approx(moved, rel=0.05)
    assert changes["left", "unbalance"].sensitivity == pytest.approx(heavier, rel=0.05)


def test_the_object_is_strict_json() -> None:
    """In SI; every free number of every flywheel."""
    document = json.loads(json.dumps(as_object(one_axis()), allow_nan=False))
    assert (document["status"], document["verified"], len(document["changes"])) == ("OK", True, 2 * 7)
    assert document["totals"]["after"]["unbalance"] == pytest.approx(document["cost"]["unbalance"])
    assert document["changes"][0]["unit"] == "m"
    assert summary(one_axis())[0].startswith("flywheels 2, total unbalance 4000 -> ")


def test_designs_that_others_beat_are_no_front() -> None:
    """Kept: less torque for more unbalance."""
    points = [Point(Weights(), Cost(u, t, 0.0), 0.0) for u, t in ((1, 5), (2, 6), (3, 4), (3, 4), (2, 5), (9, 1))]
    assert [(p.cost.unbalance, p.cost.torque) for p in pareto_points(points)] == [(1, 5), (3, 4), (9, 1)]


def test_interrupted_before_anything_was_found() -> None:
    """The status says so, and there is no design."""

    def interrupt(_: Search) -> None:
        raise KeyboardInterrupt

    text = FREE.replace("harmonics = 1", "harmonics = 0\nnumber = [1, 2]")
    design = design_stand(shaker(), motion_of, freedom(text), DesignOptions(), interrupt)
    assert design.interrupted and (design.status, design.stand) == ("NO_DESIGN", None)
    assert "1 starts, interrupted" in design.words[0]
    assert json.loads(json.dumps(as_object(design), allow_nan=False))["status"] == "NO_DESIGN"


def test_a_motion_that_no_design_can_do_is_refused() -> None:
    """Too little unbalance for the amplitude; a weight that nothing carries."""
    little = freedom(**{'"3 kg mm"': '"0.9 kg mm"'})
    with pytest.raises(DesignError, match=r"no design does this: along z it needs a first moment"):
        design_stand(shaker(), motion_of, little)
    with pytest.raises(DesignError, match=r"no design does this: a mean force of 68\.67 N along z"):
        design_stand(shaker().without_laws(Suspension), motion_of, freedom())


RAIL = """
schema = 1
name = "rail"
gravity = [0, 0, -9.81]
[carrier]
mass = 6.0
inertia = [0.05, 0.06, 0.07]
[hold]
freedoms = ["z"]
[suspension]
stiffness = [0, 0, 20000, 0, 0, 0]
damping = [0, 0, 40, 0, 0, 0]
"""
WHEEL = """
[[flywheel]]
name = "{name}"
position = ["10 mm", "{y} mm", "20 mm"]
axis = [1, 0, 0]
zero = [0, 0, 1]
mass = 0.5
spin_inertia = 0.01
transverse_inertia = 0.006
unbalance = {{ static = "{unbalance} kg mm" }}
"""
KEYS = (
    'schema = 1\nspeed = [-1, 1]\nharmonics = 1\n{number}\n[[free]]\nunbalance = {{ min = 0, max = "{most} kg mm" }}\n'
)


def rail(text: str = RAIL, unbalance: float = 1.0) -> Stand:
    """A shaker on a rail with two exciters across it."""
    wheels = "".join(WHEEL.format(name=name, y=y, unbalance=unbalance) for name, y in (("left", 60), ("right", -60)))
    return loads(text + wheels)


def held_motion(stand: Stand, rows: dict[str, list[float]], **keys: Any) -> RequiredMotion:
    document = {"schema": 1, "type": "periodic", "period": 0.05, "harmonics": [{"k": 1, **rows}], "winding": "any"}
    return read_motion(json.dumps(document | keys), stand, "m.json")


def up_and_down(stand: Stand) -> RequiredMotion:
    """0.3 mm along the rail at 20 Hz."""
    return held_motion(stand, {"cos": [3e-4]})


@pytest.mark.slow
def test_one_flywheel_is_enough_for_one_freedom() -> None:
    """The hold takes the force across the rail, so one wheel does, at constant speed, with the unbalance of the closed
    formula: mu Omega^2 = |k - m Omega^2 + i d Omega| A.
    """
    stand = rail()
    freedom = read_freedom(KEYS.format(number="number = [1, 2]", most=3), stand)
    design = design_stand(stand, up_and_down, freedom, DesignOptions(starts=4))
    assert (design.status, design.words) == ("OK", ())
    assert design.stand is not None and design.programme is not None
    assert [wheel.name for wheel in design.stand.flywheels] == ["left"]
    assert design.programme.report["verified"] is True and design.programme.coordinates == ("z",)
    Omega = 2 * np.pi * 20
    needed = 3e-4 * abs(20000 - 6.5 * Omega**2 + 40j * Omega) / Omega**2
    assert design.totals["after"]["unbalance"] == pytest.approx(needed, rel=1e-6)
    assert design.programme.report["harmonics"] == 0
    assert loads(dumps(design.stand)) == design.stand


@pytest.mark.parametrize(
    ("hold", "rows"),
    [
        ('freedoms = ["x", "z", "pitch"]', {"cos": [3e-4, 1e-4, 0.01], "sin": [1e-4, 0.0, 0.02]}),
        ('freedoms = ["roll", "pitch", "yaw"]\npivot = [0, 0, 0.1]', {"cos": [0.01, 0.02, 0.0]}),
    ],
)
def test_held_rows_have_the_derivatives_of_differences(hold: str, rows: dict[str, list[float]]) -> None:
    """Derivatives by the numbers of the stand, the angles of the programme, and the free mean pose."""
    stand = rail(RAIL.replace('freedoms = ["z"]', hold))
    required = held_motion(stand, rows, free_mean=[True] * len(next(iter(rows.values()))))
    task = Task.of(stand, required, freedom_of_keys("position,angles,unbalance,mass", stand))
    rng = np.random.default_rng(7)
    course = Periodic(required.span, np.array([1.0, -1.0]), rng.normal(size=(2, 3)), np.zeros(task.start.rows_count))
    design = Design(task.space.random(rng), course)
    J, z = task.jacobian(design, Weighing()), task.pack(design)
    assert task.rows(design, Weighing()).shape == (len(J),) and J.shape[1] == len(z)
    for k, e in enumerate(1e-6 * np.eye(len(z))):
        around = [task.rows(task.unpack(z + sign * e, course), Weighing()) for sign in (1.0, -1.0)]
        D = (around[0] - around[1]) / 2e-6
        rounding = 1e-9 * abs(around[0]).max()
        assert abs(J[:, k] - D).max() <= 2e-5 * max(abs(D).max(), 1e-3) + rounding, k


@pytest.mark.parametrize(
    ("text", "most", "words"),
    [
        (RAIL, 0.7, r"along z it needs a first moment of \+-.* from the flywheels; their largest total unb"),
        (RAIL.partition("[suspension]")[0], 3.0, "a force along z of .* N has no support in the mean"),
        (RAIL.replace('["z"]', "[]"), 3.0, "no freedoms: clamped, the carrier makes no motion that could be planned"),
        (
            RAIL.replace('freedoms = ["z"]', "basis = [[1, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 1]]"),
            3.0,
            "no coordinates of a motion to be planned",
        ),
    ],
)
def test_what_no_design_can_do_is_refused(text: str, most: float, words: str) -> None:
    stand = rail(text)
    freedom = read_freedom(KEYS.format(number="", most=most), stand)
    with pytest.raises(MahovikError, match=words) as refused:
        design_stand(stand, up_and_down, freedom)
    assert str(refused.value).count("\n") == 0
    assert isinstance(refused.value, DesignError) == (stand.hold is not None and len(stand.hold.freedoms) == 1)


def test_what_binds_along_the_rail_is_named() -> None:
    stand = rail()
    text = (
        KEYS.format(number="", most=3).replace("min = 0", 'min = "2 kg mm"').replace("harmonics = 1", "harmonics = 0")
    )
    stand = replace(stand, flywheels=stand.flywheels[:1])
    design = design_stand(stand, up_and_down, read_freedom(text, stand), DesignOptions(starts=2))
    assert design.status == "NO_DESIGN" and design.words[1].startswith("bounds of unbalance bind")
