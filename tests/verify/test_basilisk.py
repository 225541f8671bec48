"""Basilisk as a judge: agrees where its wheel is exact, is far off where it is not, and names what it lacks."""

from __future__ import annotations

import importlib.util
import os
import sys
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from mahovik.core.stand import Stand, load
from mahovik.core.stand.random import BARE, random_stand
from mahovik.core.stand.random_state import random_state
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.judges.basilisk_wheel import basilisk_stand, spacecraft_stand, unsupported_features, wheels
from mahovik.proof.verify.judges.compare import QUANTITIES, compare_with_judges, motion_name, verify_judges
from mahovik.proof.verify.judges.rigid import bare_stand
from mahovik.proof.verify.report import Report, conclusion
from mahovik.stands import path

if importlib.util.find_spec("Basilisk") is None:
    if os.environ.get("CI"):
        raise ImportError("no Basilisk: pip install bsk")
    pytest.skip("no Basilisk: pip install bsk", allow_module_level=True)

from mahovik.proof.verify.judges import basilisk_judge, basilisk_rotor
from mahovik.proof.verify.judges.basilisk_judge import BasiliskJudge
from mahovik.proof.verify.judges.basilisk_rotor import BasiliskRotorJudge
from toolchain.quick import quick

FEATURES = replace(BARE, instruments=2)
RAW = {name: bare_stand(load(path(name))) for name in ("bench8", "remus6", "sat4")} | {
    f"random, {N}": random_stand(np.random.default_rng(N), N, FEATURES) for N in (1, 5)
}
ITS = {name: basilisk_stand(stand) for name, stand in RAW.items()}
QUICK, UNTIL = 5, 0.3
"""States of a comparison, the first at rest; s of its motion, about a turn. docs/results.md has more of both."""
SHORT = motion_name(UNTIL)
OFFERED = {*(QUANTITIES[key] for key in ("K", "V_dot", "phi_ddot")), SHORT}


def judged(stand: Stand, *given: Any) -> Report:
    return compare_with_judges(stand, [BasiliskJudge(stand, *given)], count=QUICK, until=UNTIL, backend=compiled(stand))


@cache
def compiled(stand: Stand) -> CBackend:
    """Once for all tests of a stand: what is broken on purpose is the judge."""
    return CBackend(stand)


def worst(report: Report) -> dict[str, float]:
    return {row.quantity: row.value for row in report.rows}


@pytest.mark.parametrize("name", quick(1, ITS))
def test_it_agrees_where_its_wheel_is_exact(name: str) -> None:
    found = judged(ITS[name])
    assert found.passed, conclusion(found)
    assert {row.quantity for row in found.rows} == OFFERED
    assert all(row.value < 1e-14 for row in found.rows if row.quantity != SHORT)
    assert all(abs(wheel.tensor[0, 2]) > 0.0 or wheel.static > 0.0 for wheel in wheels(ITS[name]))


def judged_by_rotors(stand: Stand) -> Report:
    judge = BasiliskRotorJudge(stand)
    return compare_with_judges(stand, [judge], count=QUICK, until=UNTIL, backend=compiled(stand))


@pytest.mark.parametrize("name", quick(1, ["random, 1", "bench8", "sat4"]))
def test_its_spinning_body_is_exact_for_every_flywheel(name: str) -> None:
    """No flywheel is cut: two transverse moments, all products of inertia, any unbalance."""
    stand = spacecraft_stand(RAW[name])
    found = judged_by_rotors(stand)
    assert found.passed, conclusion(found)
    assert {row.quantity for row in found.rows} == OFFERED
    assert all(row.value < 1e-14 for row in found.rows if row.quantity != SHORT)
    assert unsupported_features(stand)


@pytest.mark.parametrize("fault", quick(1, ["center", "product", "place", "axes"]))
def test_a_wrong_rotor_is_caught(fault: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """One number of one rotor that Basilisk is given, in the ninth digit (a product: the sixth); turned axes."""
    right = basilisk_rotor.rotors

    def wrong(stand: Stand) -> Any:
        *others, last = right(stand)
        product = np.zeros((3, 3))
        product[1, 2] = product[2, 1] = 1e-6 * last.inertia[0, 0]
        turn = np.array([[1.0, 0.0, 0.0], [0.0, 1.0, -1e-9], [0.0, 1e-9, 1.0]])
        changes: dict[str, Any] = {
            "center": {"center": last.center * (1.0 + 1e-9)},
            "product": {"inertia": last.inertia + product},
            "place": {"position": last.position * (1.0 + 1e-9)},
            "axes": {"axes": last.axes @ turn},
        }
        return (*others, replace(last, **changes[fault]))

    monkeypatch.setattr(basilisk_rotor, "rotors", wrong)
    assert not judged_by_rotors(spacecraft_stand(RAW["random, 1"])).passed


@pytest.mark.parametrize("fault", quick(1, ["static", "dynamic", "place", "mass"]))
def test_a_wrong_wheel_is_caught(fault: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """One wheel of those that Basilisk is given: the sign of an unbalance, or one number in the ninth digit."""

    def wrong(stand: Stand) -> Any:
        *others, last = wheels(stand)
        products = np.zeros((3, 3))
        products[0, 2] = products[2, 0] = last.tensor[0, 2]
        changes: dict[str, Any] = {
            "static": {"static": -last.static},
            "dynamic": {"tensor": last.tensor - 2.0 * products},
            "place": {"center": last.center * (1.0 + 1e-9)},
            "mass": {"mass": last.mass * (1.0 + 1e-9)},
        }
        return (*others, replace(last, **changes[fault]))

    monkeypatch.setattr(basilisk_judge, "wheels", wrong)
    failed = {row.quantity for row in judged(ITS["random, 1"]).failures}
    assert QUANTITIES["V_dot"] in failed
    assert QUANTITIES["phi_ddot"] in failed or fault in ("place", "mass")


def test_what_it_leaves_out_is_the_torque_of_the_difference_about_the_axis() -> None:
    """On a carrier too heavy to be moved, C - Basilisk is (Jt - Jg) omega_2 omega_3 of its manual, over Js + m d^2."""
    stand = basilisk_stand(RAW["random, 1"], asymmetric=True)
    heavy = replace(
        stand,
        instruments=(),
        flywheels=(replace(stand.flywheels[0], mount="carrier"),),
        carrier=replace(
            stand.carrier,
            mass=1e12,
            center_of_mass=(0.0, 0.0, 0.0),
            inertia=((1e12, 0.0, 0.0), (0.0, 1e12, 0.0), (0.0, 0.0, 1e12)),
        ),
    )
    (wheel,) = wheels(heavy)
    state = replace(random_state(heavy, np.random.default_rng(2)), wrench={})
    turn = np.array(state.phi[0])
    c, s = np.cos(turn), np.sin(turn)
    axes = wheel.axes @ np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])
    omega = axes.T @ np.array(state.V[3:])
    Js, Jt, Jg = np.diag(wheel.tensor)
    expected = (Jt - Jg) * omega[1] * omega[2] / (Js + wheel.static**2 / wheel.mass)
    ours = CBackend(heavy).evaluate(state, ("coupled",))["phi_ddot"][0]
    theirs = BasiliskJudge(heavy, "JitterFullyCoupled", True).evaluate(state)["phi_ddot"][0]
    assert abs(expected) > 1e-3
    assert ours - theirs == pytest.approx(expected, rel=1e-6)  # 1e-10 is what the carrier still moves


def test_without_it_the_others_judge(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delitem(sys.modules, "mahovik.proof.verify.judges.basilisk_judge", raising=False)
    monkeypatch.setitem(sys.modules, "Basilisk", None)
    found = verify_judges(load(path("demo3")), count=2, until=UNTIL)
    assert found.passed, conclusion(found)
    (row,) = [row for row in found.rows if row.judged == "basilisk"]
    assert row.verdict == "not compared"
    assert row.words.endswith("pip install bsk")
