"""Right C passes, whatever the stand: three ways agree on general stands, free and held, of none to 64 flywheels."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from random_stands import WHAT_MATTERS, random_stands

from mahovik import stands
from mahovik.contract.limits import LIMITS
from mahovik.core.stand import Stand, load, loads
from mahovik.core.stand.model import rest_state
from mahovik.core.stand.random import Features, random_stand
from mahovik.laws.control.law import ControlDerivatives
from mahovik.laws.cross_flow.law import CrossFlow
from mahovik.laws.fading.law import FadingDamping
from mahovik.laws.fin.law import Fins
from mahovik.laws.propeller.law import Propellers
from mahovik.proof.second import Second
from mahovik.proof.verify.backends import NumpyBackend
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.check import Report, conclusion
from mahovik.proof.verify.draw import draw
from mahovik.proof.verify.harness import judge, verify_c
from mahovik.proof.verify.judges import verify_judges
from mahovik.proof.verify.scales import Scales
from toolchain.quick import quick
from verify.build import everything
from verify.holds import DRY, WET, random_held_stand

STATES = 13
"""At rest, four of the extreme kinds, ordinary ones with and without run-time wrenches."""

NET = Path(__file__).parents[1] / "net" / "stands"
HELD = sorted((Path(__file__).parents[2] / "docs" / "held").glob("*.toml"))
RANDOM = [*random_stands(WHAT_MATTERS)]
LATER_LAWS = (CrossFlow, Fins, Propellers, FadingDamping, ControlDerivatives)

WHEEL = """
[[flywheel]]
name = "{name}"
mass = "{mass}"
angles = {angles}
spin_inertia = "{spin}"
transverse_inertia = "{across}"
unbalance = {{ static = "{static}", static_at = "40 deg", dynamic = "{dynamic}" }}
motor = {{ torque = "0.5 mN m", speed = "8000 rpm" }}
"""
PICO = {"mass": "5 g", "spin": "0.9 g cm^2", "across": "0.5 g cm^2", "static": "0.1 g mm", "dynamic": "0 g mm^2"}
NANO = {"mass": "20 g", "spin": "12 g cm^2", "across": "7 g cm^2", "static": "0.2 g mm", "dynamic": "1 g mm^2"}


def small_wheels(carrier: str, count: int, wheel: dict[str, str]) -> Stand:
    """Wheels that are small for the drawn torques on a carrier of this mass."""
    head = f'schema = 1\nname = "small"\ncarrier = {{ mass = "{carrier}", inertia = [0.0022, 0.0022, 0.0021] }}\n'
    angles = ("[0, 0]", "[1.5707963, 0]", "[0, -1.5707963]")
    return loads(head + "".join(WHEEL.format(name=f"w{i}", angles=angles[i], **wheel) for i in range(count)))


def of_bench8(count: int) -> Stand:
    """bench8 with so many of its first flywheel."""
    bench = load(stands.path("bench8"))
    first = bench.flywheels[0]
    wheels = tuple(replace(first, name=f"w{k}", position=(0.01 * k, 0.2, -0.1)) for k in range(count))
    return replace(bench, flywheels=wheels)


def flowing() -> Stand:
    """A stand with every law of a fluid."""
    stand = random_stand(np.random.default_rng(3), 2, Features(instruments=1, flow=True, stream=True, points=1))
    assert all(stand.carrier.law(law) is not None for law in LATER_LAWS)
    return stand


UNREACHED = """
schema = 1
name = "held"
gravity = [0, 0, -9.81]
carrier = {{ mass = 0.3, inertia = [6e-4, 6e-4, 2e-5] }}
hold = {{ {hold} }}
[[flywheel]]
name = "wheel"
position = [0, 0, 0.12]
axis = [0, 1, 0]
zero = [0, 0, 1]
mass = 0.25
spin_inertia = 4e-4
transverse_inertia = 2.2e-4
"""
SLOW_STREAM = """
schema = 1
name = "held"
stream = [{stream}, 0, 0]
carrier = {{ mass = 30, inertia = [1, 1, 1], damping = {{ linear = [5, 5, 5, 1, 1, 1] }} }}
hold = {{ freedoms = {freedoms} }}
"""
VANISHING_REACH = """
schema = 1
name = "held"
carrier = { mass = 12, inertia = [0.2, 0.2, 0.2] }
hold = { freedoms = ["x"] }
[[flywheel]]
name = "wheel"
axis = [0, 0, 1]
zero = [1, 0, 0]
mass = 2
spin_inertia = 4e-3
transverse_inertia = 2.5e-3
unbalance = { static = "72 g mm" }
"""
"""A stand whose only singular value is the sine of the phase times a number, so small that its square underflows."""

PUSHED = """
schema = 1
name = "pushed"
carrier = { mass = 24, inertia = [0.3, 1.6, 1.6] }
[[flywheel]]
name = "wheel"
axis = [0, 0, 1]
zero = [1, 0, 0]
mass = 1.2
spin_inertia = 4e-3
transverse_inertia = 2.4e-3
wrench_input = true
"""
"""A run-time wrench on a flywheel, and nothing whose moment about its axis changes with the motion."""

Case = tuple[Callable[[], Stand], str]

QUICK: dict[str, Case] = {
    "one flywheel": (lambda: RANDOM[1], "double"),
    "hinge, of given sines": (lambda: replace(random_held_stand("hinge", 3, DRY, 1), phase_input="sincos"), "double"),
    "a push on a flywheel": (lambda: loads(PUSHED), "double"),
    "plane in a fast stream": (lambda: loads(SLOW_STREAM.format(stream=-20, freedoms=["x", "z", "pitch"])), "float"),
}
SLOW: dict[str, Case] = {
    "no flywheel": (lambda: RANDOM[0], "double"),
    **{f"{len(stand.flywheels)} flywheels": (partial(replace, stand), "double") for stand in RANDOM[2:]},
    **{name: (partial(load, stands.path(name)), "double") for name in stands.names()},
    **{path.stem: (partial(load, path), "double") for path in HELD},
    "everything": (lambda: everything("euler"), "double"),
    "everything, float": (lambda: everything("euler"), "float"),
    "random, float": (lambda: RANDOM[3], "float"),
    "flowing": (flowing, "double"),
    "64 equal flywheels": (lambda: of_bench8(64), "double"),
    "pico": (lambda: small_wheels("1.3 kg", 1, PICO), "double"),
    "nano": (lambda: small_wheels("4 kg", 3, NANO), "double"),
    "ball joint": (lambda: random_held_stand("ball joint", 3, DRY, 3), "double"),
    "clamped": (lambda: random_held_stand("clamped", 9, WET, 4), "double"),
    "knife edge": (lambda: random_held_stand("knife edge", 9, WET, 4), "double"),
    "all but one": (lambda: random_held_stand("all but one", 9, DRY, 4), "double"),
    "hinge, float": (lambda: random_held_stand("hinge", 9, WET, 4), "float"),
    "clamped, unreached": (lambda: loads(UNREACHED.format(hold="freedoms = []")), "double"),
    "plane, unreached": (lambda: loads(UNREACHED.format(hold="freedoms = ['x', 'y', 'yaw']")), "double"),
    "clamped in a stream": (lambda: loads(SLOW_STREAM.format(stream=-2, freedoms="[]")), "double"),
    "slide with stops, no flywheel": (lambda: load(NET / "random44.toml"), "double"),
    "damping with a kink": (lambda: load(NET / "random01.toml"), "double"),
    "vanishing reach": (lambda: loads(VANISHING_REACH), "double"),
}
CASES = QUICK | SLOW


@pytest.mark.parametrize("name", quick(len(QUICK), CASES))
def test_right_c_passes(name: str) -> None:
    stand, real = CASES[name][0](), CASES[name][1]
    report = verify_c(stand, seed=1, count=STATES, real=real)
    assert report.passed, conclusion(report)
    assert compared(report, stand) <= {(row.judged, row.quantity) for row in report.rows if row.verdict == "ok"}


def compared(report: Report, stand: Stand) -> set[tuple[str, str]]:
    """Rows that a stand must have, the second derivation beside reference and C in those of motions."""
    held = stand.hold is not None
    expected = {("forward", "V_dot"), ("coupled", "V_dot"), ("momentum", "energy")}
    three = {(row.judged, row.quantity) for row in report.rows if row.second is not None}
    assert three >= expected
    assert (("torque", "tau") in three) == bool(stand.flywheels)
    assert (("points", "points") in three) == bool(stand.points or stand.instruments)
    if held and stand.hold is not None and stand.hold.freedoms:
        expected |= {("forward", "u_dot")}
    if stand.flywheels and not held:
        expected |= {("inverse", "phi_ddot"), ("inverse", "residual")}
    return expected | {("", "interpreter = C, bit for bit"), ("", "bad inputs refused")}


@pytest.mark.slow
@pytest.mark.parametrize("file", HELD, ids=lambda file: file.stem)
def test_joints_of_others_agree_with_the_held_stands_of_the_docs(file: Path) -> None:
    """Pinocchio is silent about the clamped force table alone: it has no joint without freedoms."""
    report = verify_judges(load(file), count=6)
    assert report.passed
    silent = {row.judged for row in report.rows if row.verdict == "not compared"}
    assert silent == ({"pinocchio"} if file.stem == "force_table" else set())


def test_exciters_of_the_shaker_cancel_across_the_rail() -> None:
    """Two masses m at radius r press on the rail with 2 m r phi'^2 sin phi in phase, and with nothing in antiphase."""
    stand = load(next(file for file in HELD if file.stem == "linear_shaker"))
    speed, phase = 50.0, 0.7
    state = replace(rest_state(stand), phi=(phase, phase), phi_dot=(speed, speed))
    across, one_way = (
        abs(NumpyBackend(stand).evaluate(replace(state, phi=phi), ["forward"])["reaction"][1])
        for phi in ((phase, phase), (phase, -phase))
    )
    assert across < 1e-12 * one_way
    assert math.isclose(one_way, 2 * 0.16 * speed**2 * math.sin(phase), rel_tol=1e-12)


def test_the_second_derivation_keeps_its_digits_at_the_highest_speeds() -> None:
    """phi'^2 is 1e10 there, and no term of a pendulum with a balanced wheel has it."""
    stand = load(next(file for file in HELD if file.stem == "pendulum"))
    fast = [(name, state) for name, state in draw(stand, 1, 200) if "fast" in name]
    rows = judge(stand, NumpyBackend(stand), fast, ("forward", "coupled"), second=Second(stand))
    assert fast
    assert [row for row in rows if not (row.second or 0.0) < 1e-13] == []


def slow_in_a_stream() -> Stand:
    """A body with little added mass, in a fast stream."""
    stand = load(NET / "random14.toml")
    added: Any = (1e-5 * np.eye(6)).tolist()
    return replace(stand, carrier=replace(stand.carrier, added_mass=added))


@pytest.mark.parametrize("stand", [load(NET / "random14.toml"), slow_in_a_stream()], ids=["dry", "added mass"])
def test_slow_bodies_in_a_stream_lose_no_digits_and_no_status(stand: Stand) -> None:
    backend = CBackend(stand, "float")
    slow = [(name, state) for name, state in draw(stand, 2, 20, "float") if "tiny" in name]
    rows = judge(stand, backend, slow, ("momentum", "inverse"), LIMITS["float"], scales=Scales(stand, "float"))
    assert slow
    assert [row for row in rows if row.verdict != "ok"] == []


WEAK = """
schema = 1
name = "weak"
carrier = { mass = 6, inertia = [0.08, 0.5, 0.45] }
hold = { freedoms = ["roll", "y"] }
[[flywheel]]
name = "w1"
mass = 0.4
inertia = [0.0011, 0.0008, 0.0007]
[[flywheel]]
name = "w2"
mass = 0.25
axis = [0.2, 0.1, 1.0]
zero = [1, 0, 0]
position = [0.03, 0.02, 0.04]
spin_inertia = 0.0006
transverse_inertia = [0.0004, 0.0005]
unbalance = { static = 2e-5 }
"""


def test_what_flywheels_hardly_reach_leaves_the_rounding_of_what_they_reach_well() -> None:
    """Along y an unbalance of 20 g mm acts, about x whole flywheels: the solver rounds by the norm of both."""
    stand = loads(WEAK)
    states = draw(stand, 1, 40, "float")
    rows = judge(stand, CBackend(stand, "float"), states, ("inverse",), LIMITS["float"], scales=Scales(stand, "float"))
    assert [row for row in rows if row.verdict != "ok"] == []


@pytest.mark.parametrize("hold", ['"x"', '"x", "roll"'])
def test_an_answer_that_float_does_not_have_may_be_refused(hold: str) -> None:
    """At a phase of 2e-38 the only singular value is subnormal, and phi_ddot 1e44."""
    stand = loads(VANISHING_REACH.replace('"x"', hold))
    states = draw(stand, 2, 40, "float")
    rows = judge(stand, CBackend(stand, "float"), states, ("inverse",), LIMITS["float"])
    assert [row for row in rows if row.verdict != "ok"] == []
    unused = [(name, replace(state, phi=(2e-44,))) for name, state in states if name == "tiny 18"]
    rows = judge(stand, CBackend(stand, "float"), unused, ("inverse",), LIMITS["float"])
    assert {row.words for row in rows} == {"rounding decides a word of the answer"}


@pytest.mark.parametrize(("real", "phi"), [("double", 1e-195), ("float", 1e-30)])
def test_a_reach_whose_square_underflows_is_used(real: str, phi: float) -> None:
    """Along x, (8) of a stand at rest is m x'' = mu sin(phi) phi''."""
    stand = loads(VANISHING_REACH)
    state = replace(rest_state(stand), phi=(phi,), V_dot=(1.0, 0.0, 0.0, 0.0, 0.0, 0.0), u_dot=(1.0,))
    answer = CBackend(stand, real).evaluate(state, ("inverse",))
    assert (answer["rank"], answer["status"]) == (1, "EXCESSIVE")
    assert answer["phi_ddot"] == pytest.approx([14.0 / (72e-6 * phi)], rel=1e-5)
