"""Designs: two flywheels for one axis, what binds, Ctrl-C, time, sensitivities, the front."""

from __future__ import annotations

import json
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from design.problems import FREE, freedom, motion_of, shaker
from mahovik.core.stand import loads
from mahovik.core.stand.model import Flywheel
from mahovik.core.stand.write import dumps
from mahovik.errors import DesignError
from mahovik.laws.suspension.data import Suspension
from mahovik.use.design import DesignOptions, Outcome, design_stand
from mahovik.use.design.freedom import Weights
from mahovik.use.design.outcome import as_object, summary
from mahovik.use.design.read import read_freedom
from mahovik.use.design.search import Cost, Point, Search, pareto_points
from mahovik.use.plan.problem import uniform
from mahovik.use.plan.residual import Mechanics, Norm, prescribe, residual


@cache
def one_axis() -> Outcome:
    """The shaker's design, once."""
    return design_stand(shaker(), motion_of, freedom(), DesignOptions(seed=2, starts=20))


@pytest.mark.slow
def test_two_flywheels_for_one_axis() -> None:
    """Exact, verified, inside bounds and limits, with the least unbalance that there is; the file says the same."""
    found = one_axis()
    assert (found.status, found.words) == ("OK", ())
    assert found.residual < 1e-9
    assert found.stand is not None
    assert found.programme is not None
    assert found.programme.report["verified"] is True
    assert loads(dumps(found.stand)) == found.stand
    assert found.totals["after"]["nearest"]["distance"] >= 0.1
    places = np.array([s.position for s in found.stand.flywheels])
    assert abs(places).max() <= 0.08
    # +-mu Omega^2 of each pair is the whole force that moves mass and suspension: nothing is wasted across
    Omega = 2 * np.pi * 20
    needed = 3e-4 * abs(7.0 - 1105.398 / Omega**2 + 10j / Omega)
    assert found.totals["after"]["unbalance"] == pytest.approx(needed, rel=2e-3)


def test_the_object_is_strict_json() -> None:
    """In SI; every free number of every flywheel."""
    told = json.loads(json.dumps(as_object(one_axis()), allow_nan=False))
    assert told["status"] == "OK"
    assert told["verified"] is True
    assert told["totals"]["after"]["unbalance"] == pytest.approx(told["cost"]["unbalance"])
    assert len(told["changes"]) == 2 * 7
    assert told["changes"][0]["unit"] == "m"
    assert summary(one_axis())[0].startswith("flywheels 2, total unbalance 4000 -> ")


def test_sensitivities_are_those_of_stands_that_are_built_so() -> None:
    """1 mm and 1 g mm of error: the residual that the programme then has."""
    found = one_axis()
    built, programme = found.stand, found.programme
    assert built is not None
    assert programme is not None
    motion = motion_of(built)
    t = uniform(motion.span, 256)
    told = {(each.flywheel, each.name): each for each in found.changes}
    assert len(told) == 2 * 7

    def relative(wheel: Flywheel) -> float:
        stand = replace(built, flywheels=(wheel, built.flywheels[1]))
        at = prescribe(Mechanics.of(stand), motion.at(t), np.array(programme.bias))
        angles = programme.at(t)
        own = Norm.of(prescribe(Mechanics.of(built), motion.at(t)), motion.span)
        return own.relative(residual(at, angles.phi, angles.phi_dot, angles.phi_ddot))

    wheel = built.flywheels[0]
    x, y, z = wheel.position
    along, y_c, z_c = wheel.center_of_mass
    longer = 1.0 + 1e-6 / (wheel.mass * float(np.hypot(y_c, z_c)))
    moved = relative(replace(wheel, position=(x, y + 1e-3, z)))
    heavier = relative(replace(wheel, center_of_mass=(along, longer * y_c, longer * z_c)))
    assert told["left", "y"].sensitivity == pytest.approx(moved, rel=0.05)
    assert told["left", "unbalance"].sensitivity == pytest.approx(heavier, rel=0.05)


def test_what_binds_is_named() -> None:
    """Unbalances that are all too large for rest of the force; nothing is written of a design that is none."""
    text = 'schema = 1\nspeed = [-1, 1]\nharmonics = 0\n[[free]]\nunbalance = { min = "1.2 kg mm", max = "2 kg mm" }\n'
    stand = shaker()
    good = replace(
        stand,
        flywheels=tuple(
            replace(w, position=p) for w, p in zip(stand.flywheels, ((0, 0.08, 0), (0, -0.08, 0)), strict=True)
        ),
    )
    found = design_stand(good, motion_of, read_freedom(text, good), DesignOptions(starts=4))
    assert found.status == "NO_DESIGN"
    assert found.stand is None
    assert found.residual > 1e-2
    assert "does not prove" in found.words[0]
    assert found.words[1].startswith("bounds of unbalance bind")


def test_a_motion_that_no_design_can_do_is_refused() -> None:
    """Too little unbalance for the amplitude; a weight that nothing carries."""
    little = freedom(**{'"3 kg mm"': '"0.9 kg mm"'})
    with pytest.raises(DesignError, match=r"no design does this: along z it needs a first moment"):
        design_stand(shaker(), motion_of, little)
    with pytest.raises(DesignError, match=r"no design does this: a mean force of 68\.67 N along z"):
        design_stand(shaker().without_laws(Suspension), motion_of, freedom())


def test_interrupted_before_anything_was_found() -> None:
    """The status says so, and there is no design."""

    def tell(state: Search) -> None:
        raise KeyboardInterrupt

    text = FREE.replace("harmonics = 1", "harmonics = 0\nnumber = [1, 2]")
    found = design_stand(shaker(), motion_of, freedom(text), DesignOptions(), tell)
    assert found.interrupted
    assert (found.status, found.stand) == ("NO_DESIGN", None)
    assert "1 starts, interrupted" in found.words[0]


@pytest.mark.slow
def test_the_fewest_flywheels_are_tried_first() -> None:
    """Ctrl-C after the first of two flywheels gives it; one alone cannot."""
    tried: list[int] = []

    def tell(state: Search) -> None:
        tried[:] = state.tried
        if state.found:
            raise KeyboardInterrupt

    text = FREE.replace("harmonics = 1", "harmonics = 0\nnumber = [1, 2]").replace("angles", "# angles")
    found = design_stand(shaker(), motion_of, freedom(text), DesignOptions(starts=4), tell)
    assert tried == [1, 2]
    assert found.interrupted
    assert found.status == "OK"
    assert found.stand is not None
    assert len(found.stand.flywheels) == 2


def test_time_cuts_and_says_so() -> None:
    """Nothing was found yet."""
    found = design_stand(shaker(), motion_of, freedom(), DesignOptions(seconds=1e-3))
    assert found.status == "NO_DESIGN"
    assert found.effort["cut_by_time"]
    assert "cut by time" in found.words[0]


@pytest.mark.slow
def test_the_same_seed_gives_the_same_design() -> None:
    """To the last bit, and another seed another start."""
    again = design_stand(shaker(), motion_of, freedom(), DesignOptions(seed=2, starts=20))
    assert again.stand == one_axis().stand
    other = design_stand(shaker(), motion_of, freedom(), DesignOptions(seed=3, starts=20))
    assert other.stand != again.stand


def test_designs_that_others_beat_are_no_front() -> None:
    """Kept: less torque for more unbalance."""
    points = [Point(Weights(), Cost(u, t, 0.0), 0.0) for u, t in ((1, 5), (2, 6), (3, 4), (3, 4), (2, 5), (9, 1))]
    assert [(p.cost.unbalance, p.cost.torque) for p in pareto_points(points)] == [(1, 5), (3, 4), (9, 1)]
