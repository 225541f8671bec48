"""What every law of a stand must keep: three derivations and C agree, balls, slopes of planning, files, refusals."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from laws import stands
from laws.stands import CARRIER, CONTROL, FADES, HULL, KEY, MAIN, PRODUCTS, RUDDER, SLENDER, TEXTS, bearing
from mahovik.core.emit.generate import generate_all
from mahovik.core.lower.law_arrays import LawArrays, TwistLaws
from mahovik.core.stand import dumps, identities, loads
from mahovik.core.stand.model import Carrier
from mahovik.core.stand.random import BARE, random_stand, random_state
from mahovik.core.stand.summary import summarize
from mahovik.errors import StandError
from mahovik.laws.control.law import ControlDerivatives
from mahovik.laws.control.reference import control_derivatives
from mahovik.laws.cross_flow.reference import cross_flow_drag
from mahovik.laws.damping.law import Damping
from mahovik.laws.fading.reference import fading_damping
from mahovik.laws.fin.law import Fins
from mahovik.laws.fin.reference import lift_and_drag
from mahovik.laws.propeller.law import Propellers
from mahovik.laws.propeller.reference import thrust_and_torque
from mahovik.laws.torquer.law import Torquers
from mahovik.proof import reference
from mahovik.proof.diagnose.diagnosis import Diagnoser
from mahovik.proof.second import Second
from mahovik.proof.verify.backends import NumpyBackend
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.states import Request
from rigorous.balls import forward_is_enclosed
from second.agreement import AGREEMENT, differences, expectations, worst_difference

Array = NDArray[np.float64]


@pytest.mark.parametrize("law", ["all", *(pytest.param(law, marks=pytest.mark.slow) for law in TEXTS)])
def test_derivations_and_C_agree(law: str) -> None:
    """They agree at rest in the water too, where lengths have no slope."""
    stand = bearing(law)
    backend, second = CBackend(stand), Second(stand)
    for number in range(3):
        state = random_state(stand, np.random.default_rng(number))
        for at in (state, replace(state, V=(0.0,) * 6, phi_dot=(0.0, 0.0))):
            assert worst_difference(stand, at, second.evaluate, backend.evaluate) <= AGREEMENT


@pytest.mark.slow
def test_float_agrees_to_its_digits() -> None:
    """States are also beyond the speed at which the exponential of fading damping is zero by definition."""
    stand = bearing("fading")
    backend = CBackend(stand, "float")
    state = random_state(stand, np.random.default_rng(1))
    for at in (state, replace(state, V=(800.0, *state.V[1:]))):
        assert max(differences(backend.evaluate, at, expectations(stand, at)).values()) <= 1e-4


@pytest.mark.parametrize("law", TEXTS)
def test_rigorous_balls_hold_the_wrench(law: str) -> None:
    stand = bearing(law, 3)
    state = random_state(stand, np.random.default_rng(3))
    for at in (state, replace(state, V=(0.0,) * 6)):
        forward_is_enclosed(stand, at)


@pytest.mark.parametrize("law", TEXTS)
def test_a_stand_without_it_moves_in_another_way(law: str) -> None:
    """Without the law the stand moves otherwise: the comparisons above can fail."""
    stand = bearing(law)
    bare = stand.without_laws(Torquers)
    bare = replace(bare, carrier=replace(bare.carrier, laws=()))
    state = random_state(stand, np.random.default_rng(2))
    changes = differences(lambda s, w: reference.evaluate(bare, s, w), state, expectations(stand, state))
    assert max(changes.values()) > 1e-6


def arrays_of(body: Carrier) -> TwistLaws:
    """The laws of a carrier on arrays."""
    laws = LawArrays(replace(loads(CARRIER), carrier=body)).bodies[0]
    assert laws is not None
    return laws


BODY = loads(CARRIER).carrier
STEERED = loads(CONTROL).carrier


def steered(V: Array) -> Array:
    """Control derivatives, and the fins and propellers that they name."""
    control, fins, propellers = STEERED.law(ControlDerivatives), STEERED.law(Fins), STEERED.law(Propellers)
    assert control is not None and fins is not None and propellers is not None
    parts = [lift_and_drag(fin, V) for fin in fins.fins] + [thrust_and_torque(p, V) for p in propellers.propellers]
    return np.asarray(control_derivatives(STEERED, control, V) + sum(parts))


PLANNED: dict[str, tuple[TwistLaws, Callable[[Array], Array], float]] = {
    "control": (arrays_of(STEERED), steered, 1e-3),
    "fading": (arrays_of(BODY.with_laws(FADES)), lambda V: fading_damping(FADES, V), 1e-4),
    "strips": (arrays_of(BODY.with_laws(SLENDER)), lambda V: cross_flow_drag(SLENDER, V), 0.02),
    "together": (
        arrays_of(BODY.with_laws(replace(SLENDER, together=True))),
        lambda V: cross_flow_drag(replace(SLENDER, together=True), V),
        0.02,
    ),
    "propellers": (
        arrays_of(BODY.with_laws(Propellers((MAIN, stands.STILL)))),
        lambda V: thrust_and_torque(MAIN, V) + thrust_and_torque(stands.STILL, V),
        1e-3,
    ),
    "whole": (
        arrays_of(BODY.with_laws(Propellers((stands.WHOLE,)))),
        lambda V: thrust_and_torque(stands.WHOLE, V),
        1e-3,
    ),
}
"""Laws that depend on the twist alone: planning, wrench, and how far slopes may be from differences."""

twists = st.lists(st.floats(-3, 3, allow_subnormal=False), min_size=6, max_size=6).map(np.array)


@pytest.mark.parametrize("law", PLANNED)
@given(V=twists)
def test_planning_has_the_wrench_and_its_slopes(law: str, V: Array) -> None:
    planned, wrench, near = PLANNED[law]
    np.testing.assert_allclose(planned.wrench(V[None])[0], wrench(V), rtol=1e-9, atol=1e-9)
    if np.min(np.abs(V[:2])) < 0.02:
        return  # a magnitude has no slope at zero, and lengths bend there
    step = 1e-6 * np.eye(6)
    slopes = (planned.wrench(V + step) - planned.wrench(V - step)) / 2e-6
    np.testing.assert_allclose(planned.rate(V[None])[0], slopes.T, rtol=1e-4, atol=near)


fins = st.sampled_from([RUDDER, HULL, stands.PLANE, replace(stands.PLANE, stall=0.1), replace(RUDDER, speed="along")])


@given(fins, twists)
def test_planning_has_the_slopes_of_fins(fin: Any, V: Array) -> None:
    """At a kink between those of both sides, and not across the flow from behind."""
    planned = arrays_of(BODY.with_laws(Fins((fin, HULL))))
    P = lift_and_drag(fin, V) + lift_and_drag(HULL, V)
    np.testing.assert_allclose(planned.wrench(V[None])[0], P, rtol=1e-9, atol=1e-9)
    step = 1e-7 * np.eye(6)
    change = planned.wrench(V + step) - planned.wrench(V - step)
    if np.linalg.norm(V[:3]) < 0.1 or np.abs(change).max() >= 1e-3:
        return
    around = np.array([planned.rate((V + s * e)[None])[0] for e in step for s in (1, 0, -1)])
    slopes = change.T / 2e-7
    assert np.all(around.min(axis=0) - 0.02 <= slopes)
    assert np.all(around.max(axis=0) + 0.02 >= slopes)


OTHER_NUMBERS = {
    "control": ("-3.1", "2.0"),
    "fading": ("3 s/m", "2 s/m"),
    "strips": ("drag_y = 1.1", "drag_y = 2"),
    "fins": ('"10 deg"', '"20 deg"'),
    "propellers": ("1500 rpm", "1400 rpm"),
    "torquers": ("[2.0, 0, 0]", "[9.0, 0, 0]"),
    "products": ("-31.2", "-31"),
}
OTHER_STRUCTURE = {
    "strips": ("drag_y = 1.1", "drag_y = 1.1\npoints = 3"),
    "fins": ('mount = "pod"\n', ""),
    "torquers": ('mount = "boom"\n', ""),
    "products": (KEY, ""),
}


@pytest.mark.parametrize("law", TEXTS)
def test_file_comes_back_and_numbers_are_no_structure(law: str) -> None:
    stand = loads(TEXTS[law])
    assert loads(dumps(stand)) == stand
    assert dumps(loads(dumps(bearing(law)))) == dumps(bearing(law))
    other = loads(TEXTS[law].replace(*OTHER_NUMBERS[law]))
    assert identities(other).structure == identities(stand).structure
    assert identities(other).physics != identities(stand).physics
    if law in OTHER_STRUCTURE:
        moved = loads(TEXTS[law].replace(*OTHER_STRUCTURE[law]))
        assert identities(moved).structure != identities(stand).structure


def test_stands_without_laws_have_none_of_them_in_the_C() -> None:
    files = generate_all(random_stand(np.random.default_rng(1), 2, BARE)).files
    for word in ("control", "fading", "strip", "fin", "propeller", "magnetic", "_exp"):
        assert not [
            name for name, text in files.items() if word in text.replace("(", " ").replace("_exp ", "_exp").split()
        ]


PLACES = {
    "control": "",
    "fading": "fading_damping",
    "strips": "cross_flow",
    "fins": "fin ",
    "propellers": "propeller ",
    "torquers": "",
    "products": "damping",
}
"""What each refusal of a law names."""

REFUSED = [
    ("control", '"rudder.deflection"]', '"rudde.deflection"]', 'no "rudde.deflection" on this body, which has rudder.'),
    ("control", '"rudder.deflection"]', '"rudder.angle"]', 'with or without bars, found "rudder.angle"'),
    ("control", '"rudder.deflection"]', '"rudder.speed"]', 'no "rudder.speed" on this body'),
    ("control", '["u", "r", "rudder.deflection"]', "[]", "expected one to four factors"),
    ("control", '["w", "w", "w"]', '["w", "w", "w", "w", "w"]', "expected one to four factors"),
    ("control", '"2.5 N s^3/m^3"', '"2.5 N s^2/m^2"', "does not fit, expected"),
    ("control", "race = 2e-4", "", "race: required where a term has PROPELLER.race"),
    ("control", "race = 2e-4", "race = -1", "race: "),
    ("control", 'wrench = "X"', 'wrench = "x"', "expected one of X Y Z K M N"),
    ("control", 'name = "main"', 'name = "main"\nmount = "pod"', "on this body, which has rudder.deflection"),
    ("fading", '"3 s/m"', "0", "is not above 0"),
    ("fading", '"3 s/m"', "-3", "is not above 0"),
    ("fading", '"3 s/m"', '"3 m/s"', "expected a rate over speed"),
    ("fading", '"3 s/m"', "inf", "finite"),
    ("fading", 'rate = "3 s/m"', "", "missing"),
    ("fading", '["2 N s/m", 20, 20, 0.1, 3, 3]', "[2, 20, 20]", "expected six rows of six numbers, or a diagonal"),
    ("fading", "rate", "rat", 'unknown key "rat"'),
    ("torquers", 'mount = "boom"', 'mount = "bom"', 'torquer "my", mount: unknown "bom", did you mean "boom"?'),
    ("torquers", 'name = "my"', 'name = "boom"', 'torquer "boom", name: taken by an instrument'),
    ("torquers", "[2.0, 0, 0]", "[2.0, 0, inf]", 'torquer "mx", dipole[2]'),
    ("torquers", "[2.0, 0, 0]", '["2 T", 0, 0]', 'torquer "mx", dipole[0]'),
    ("torquers", '"20 uT"', '"20 A m^2"', "magnetic_field[0]"),
    ("torquers", "dipole = [2.0, 0, 0]", "dipol = [2.0, 0, 0]", 'torquer "mx": unknown key "dipol"'),
    ("torquers", "magnetic_field", "magnetic_feld", 'unknown key "magnetic_feld"'),
    ("strips", "0, 0.7]", "0.7, 0.7]", "expected stations that rise"),
    ("strips", "[0, 19, 0]", "[0, 19]", "expected 3 numbers, one for each station of `x`, found 2"),
    ("strips", "[0, 0.19, 0]", "[0, -0.19, 0]", "is negative"),
    ("strips", "drag_y = 1.1", "drag_y = -1.1", "is negative"),
    ("strips", "drag_y = 1.1", "drag_y = 1.1\npoints = 0", "expected 1 to 16 points between two stations, found 0"),
    ("strips", "drag_y = 1.1", "drag_y = 1.1\ntogether = 1", "expected true or false"),
    ("strips", "1025 kg/m^3", "1025 kg", "density"),
    ("strips", "density", "densty", 'unknown key "densty"'),
    ("fins", "span = [0, 0.1, -2]", "span = [-2, 0, 0]", "parallel to chord"),
    ("fins", "aspect = 3\n", "", "required without `aspect`"),
    ("fins", "lift_slope = 0.7", "lift_slope = 0.7\nefficiency = 0.9", "goes with `aspect`"),
    ("fins", "area = 0.01", "area = -0.01", "-0.01 m^2 is not above 0"),
    ("fins", 'stall = "15 deg"', 'stall = "95 deg"', "expected above 0, at most 1.5"),
    ("fins", 'speed = "whole"', 'speed = "all"', 'expected "along", "across" or "whole", found "all"'),
    ("fins", 'mount = "pod"', 'mount = "pad"', 'unknown "pad", did you mean "pod"?'),
    ("fins", 'name = "rudder"', 'name = "pod"', "taken by an instrument"),
    ("fins", '"10 deg"', '"10 mm"', "deflection"),
    ("propellers", "[0.4566, -0.4174]", "[0.4566]", "expected [k0, k1] or [k0, k1, k2]"),
    ("propellers", '"14 cm"', '"0 cm"', "is not above 0"),
    ("propellers", "wake = 0.056", "wake = 1.5", "is above 1"),
    ("propellers", '"1500 rpm"', '"1500 mm"', "an angular speed"),
    ("propellers", 'mount = "pod"', 'mount = "pad"', 'unknown "pad", did you mean "pod"?'),
    ("propellers", 'name = "bow"', 'name = "main"', "taken by a propeller"),
    ("propellers", "deduction", "deductoin", 'unknown key "deductoin"'),
    ("propellers", "axis = [0, 2, 0]", "axis = [0, 0, 0]", "has no direction"),
    ("products", KEY, 'derivatives = "with products"', 'expected "with added-mass products" or "without added-mass'),
    ("products", KEY, "derivatives = true", 'expected "with'),
    ("products", "added_mass = [1, 30, 31, 0.1, 4, 5]", "", "the carrier has no added mass, expected `added_mass`"),
    ("control", "main.race", "main.speed", "does not fit"),
]


@pytest.mark.parametrize(("law", "old", "new", "words"), REFUSED)
def test_refusals(law: str, old: str, new: str, words: str) -> None:
    """Each names the place and what was found."""
    with pytest.raises(StandError) as caught:
        loads(TEXTS[law].replace(old, new))
    assert words in str(caught.value)
    assert PLACES[law] in str(caught.value)


def test_refusals_of_whole_tables() -> None:
    terms = 'control_derivatives = { terms = [{ wrench = "X", of = ["screw.speed"], value = 1 }] }\n'
    with pytest.raises(StandError, match="which has no fin and no propeller"):
        loads(CARRIER + terms)
    without_race = CONTROL.replace("main.race", "main.speed").replace('"2.5 N s^3/m^3"', "2.5")
    with pytest.raises(StandError, match=r"no term has PROPELLER\.race"):
        loads(without_race)
    with pytest.raises(StandError, match="for the carrier only"):
        loads(PRODUCTS + f'[[instrument]]\nname = "fin"\nadded_mass = [1, 1, 1, 1, 1, 1]\ndamping = {{ {KEY} }}\n')
    with pytest.raises(StandError, match="is above 100000"):
        loads(TEXTS["propellers"].replace("1500 rpm", "1e6 rad/s"))


@pytest.mark.parametrize(("unit", "tesla"), [("T", 1.0), ("mT", 1e-3), ("uT", 1e-6), ("nT", 1e-9)])
def test_units_of_a_magnetic_field(unit: str, tesla: float) -> None:
    stand = loads(TEXTS["torquers"].replace('["20 uT", 0, "-40 uT"]', f'["3 {unit}", 0, 0]'))
    (law,) = stand.laws
    assert law.magnetic_field == pytest.approx((3 * tesla, 0.0, 0.0), rel=1e-15)  # type: ignore[attr-defined]


TESTS = Path(__file__).parents[1]


def test_a_law_is_added_by_its_folder_and_a_row_and_goes_with_them() -> None:
    """It is read, written, drawn, measured with errors, in the C, and judged by both derivations."""
    assert len(list(TESTS.glob("laws/added/tug/[a-z]*.py"))) == 4
    command = [sys.executable, "-m", "laws.with_tug"]
    run = subprocess.run(
        command, capture_output=True, text=True, check=False, timeout=300, env=os.environ | {"PYTHONPATH": str(TESTS)}
    )
    assert (run.stdout.split(), run.stderr) == (["judged"], "")
    with pytest.raises(StandError, match='unknown key "tug"'):
        loads('schema = 1\nname = "a"\n[carrier]\nmass = 1\ninertia = [1, 1, 1]\ntug = { force = [1, 0, 0] }\n')


def warnings(text: str) -> list[str]:
    return [line for line in summarize(loads(text)).warnings if "added-mass products" in line]


def test_products_that_count_twice_are_warned_of() -> None:
    """X_udot = -1, Y_vdot = -30, Z_wdot = -31 make X_wq = Z_wdot and N_uv = Y_vdot - X_udot = -29."""
    plain = PRODUCTS.replace(KEY, "")
    (line,) = warnings(plain)
    assert "damping.terms X w q = -31.2 (and 1 more)" in line
    assert warnings(PRODUCTS) == []
    assert warnings(plain.replace("-31.2", "31.2").replace("-29.0", "-20.0")) == []
    assert warnings(plain.replace("-31.2", "-35").replace("-29.0", "-20.0")) == []
    assert warnings(plain.replace('["w", "q"]', '["w", "|q|"]').replace("-29.0", "-20.0")) == []


def test_derivatives_that_contain_no_product_are_warned_of() -> None:
    """The key takes out what no term puts in."""
    carrier = CARRIER + "added_mass = [1, 30, 30, 0, 4, 4]\n"
    damping = '[carrier.damping]\nderivatives = "with added-mass products"\nterms = [{}]\n'
    away = damping.format('{ wrench = "X", of = ["u", "|u|"], value = -2 }')
    assert "no derivative stands where added mass has a product" in warnings(carrier + away)[0]
    there = damping.format('{ wrench = "X", of = ["v", "r"], value = 25 }')
    assert warnings(carrier + there) == []


def test_a_program_that_counts_them_twice_is_named() -> None:
    stand = replace(bearing("products", 6), flywheels=())
    damping = stand.carrier.law(Damping)
    assert damping is not None
    law = replace(damping, contains_products=False)
    program = NumpyBackend(replace(stand, carrier=stand.carrier.with_laws(law)))

    def answer(request: Request) -> Mapping[str, Any]:
        return program.evaluate(request.state, request.want)

    (cause,) = Diagnoser(stand, wants=("forward",)).diagnose(answer).causes
    assert cause.name == "products of added mass counted twice, in the derivatives and beside them"


def test_products_with_a_viscous_part_are_warned_of_where_they_are_several() -> None:
    """One of them alone may be near by chance. Of NPS AUV II most are 4 to 25 % apart."""
    text = (Path(__file__).parents[2] / "docs" / "vehicles" / "nps_auv2.toml").read_text(encoding="utf-8")
    text = text.replace(f"{KEY}\n", "").replace('wrench = "K", of = ["v", "w"]', 'wrench = "K", of = ["v", "|w|"]')
    (line,) = warnings(text)
    assert "damping.terms X w q = -14888 (and 6 more) is near the product of added mass -17865" in line
    damping = CARRIER + "added_mass = [1, 30, 30, 0, 4, 4]\n[carrier.damping]\nterms = [\n{}]\n"
    one, other = (
        '{ wrench = "X", of = ["w", "q"], value = -25 },\n',
        '{ wrench = "Y", of = ["w", "p"], value = 26 },\n',
    )
    assert warnings(damping.format(one)) == warnings(damping.format(other)) == []
    (line,) = warnings(damping.format(one + other))
    assert "X w q = -25 (and 1 more) is near the product of added mass -30" in line
