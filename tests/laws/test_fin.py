"""Lift and drag of fins: in every derivation and in the C, against published formulas; what is refused."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from laws.vessel import CARRIER, POD
from laws.vessel import RUDDER as RUDDER_TEXT
from mahovik.core.emit.generate import generate_all
from mahovik.core.stand import Stand, dumps, identities, loads
from mahovik.core.stand.random import BARE, Features, random_stand, random_state
from mahovik.errors import StandError
from mahovik.laws.fin.data import Fin, Fins
from mahovik.laws.fin.faults import FAULTS
from mahovik.laws.fin.plan import twist_law
from mahovik.laws.fin.reference import lift_and_drag, lift_coefficient
from mahovik.proof import reference
from mahovik.proof.verify.c_backend import CBackend
from second.agreement import AGREEMENT, differences, expectations, worst_difference

FILE = (
    CARRIER
    + POD
    + """
[[fin]]
name = "hull"
density = "1025 kg/m^3"
area = 0.2
aspect = 0.5
drag = 0.2
speed = "whole"
[[fin]]
name = "stern"
position = [-0.7, 0, 0]
density = 1025
area = "100 cm^2"
lift_slope = 0.7
induced = 1.43
deflection = "10 deg"
incidence = false
"""
    + RUDDER_TEXT
)

RUDDER = Fin(
    "rudder", (-0.7, 0.2, 0.1), (2.0, 0.1, 0.0), (0.1, 0.3, -1.0), 1025.0, 0.02, 3.1, 0.02, 0.15, 0.3, 0.1, "across",
    incidence=True,
)  # fmt: skip
HULL = replace(RUDDER, name="hull", position=(0.1, 0.0, 0.0), span=(0.0, 1.0, 0.0), stall=None, speed="whole")
PLANE = replace(RUDDER, name="plane", incidence=False, stall=None, speed="along", deflection=-0.2)

fins = st.sampled_from([RUDDER, HULL, PLANE, replace(PLANE, stall=0.1), replace(RUDDER, speed="along")])
twists = st.lists(st.floats(-3, 3, allow_subnormal=False), min_size=6, max_size=6).map(np.array)


def finned(seed: int) -> Stand:
    """A random stand whose carrier and instrument have fins."""
    stand = random_stand(np.random.default_rng(seed), 1, Features(instruments=1))
    return replace(
        stand,
        carrier=stand.carrier.with_laws(Fins((RUDDER, HULL))),
        instruments=tuple(p.with_laws(Fins((PLANE, replace(RUDDER, name="tab")))) for p in stand.instruments),
    )


@pytest.mark.slow
def test_derivations_and_C_agree() -> None:
    from mahovik.proof.second import Second

    stand = finned(1)
    backend, second = CBackend(stand), Second(stand)
    for number in range(3):
        state = random_state(stand, np.random.default_rng(number))
        for at in (state, replace(state, V=(0.0,) * 6, phi_dot=(0.0,))):
            assert worst_difference(stand, at, second.evaluate, backend.evaluate) <= AGREEMENT


@pytest.mark.parametrize("key", ["lift_slope", "drag", "induced", "deflection", "stall"])
def test_an_error_of_one_number_is_seen(key: str) -> None:
    stand = finned(2)
    wrong = Fins((replace(RUDDER, **{key: 2.0 * getattr(RUDDER, key)}), HULL))
    changed = replace(stand, carrier=stand.carrier.with_laws(wrong))
    found: list[float] = []
    for number in range(6):  # one with the flow beyond the stall and one below
        state = random_state(stand, np.random.default_rng(number))
        found += differences(lambda s, w: reference.evaluate(changed, s, w), state, expectations(stand, state)).values()
    assert max(found) > 1e-6


def test_rigorous_balls_hold_the_wrench() -> None:
    from rigorous.balls import forward_is_enclosed

    stand = finned(3)
    state = random_state(stand, np.random.default_rng(3))
    forward_is_enclosed(stand, state)


@given(st.floats(0.2, 3), st.floats(-3, 3), st.floats(-3, 3), st.floats(-0.4, 0.4))
def test_body_and_planes_of_a_torpedo_as_published(u: float, v: float, w: float, delta: float) -> None:
    """REMUS 100 in the Marine Systems Simulator: lift and drag of the hull by alpha, forces of planes and rudders."""
    rho, diameter, length = 1026.0, 0.19, 1.6
    area = 0.7 * length * diameter
    aspect = diameter**2 / area
    text = FILE.replace("area = 0.2", f"area = {area!r}").replace("aspect = 0.5", f"aspect = {aspect!r}")
    law = loads(text.replace("1025", "1026")).carrier.law(Fins)
    assert law is not None
    hull = lift_and_drag(law.fins[0], np.array([u, v, w, 0, 0, 0]))
    alpha, square = np.arctan2(w, u), u**2 + v**2 + w**2
    C_L = np.pi * aspect / (1 + np.sqrt(1 + (aspect / 2) ** 2)) * alpha
    lift, drag = (rho / 2 * square * area * C for C in (C_L, 0.2 + C_L**2 / (np.pi * 0.7 * aspect)))
    X, Z = -np.cos(alpha) * drag + np.sin(alpha) * lift, -np.sin(alpha) * drag - np.cos(alpha) * lift
    np.testing.assert_allclose(hull, [X, 0, Z, 0, 0, 0], rtol=1e-13, atol=1e-12)

    slope, small = 0.7, 0.01
    base = Fin("s", (-0.7, 0, 0), (1, 0, 0), (0, 1, 0), rho, small, slope, 0, 1 / slope, None, delta, "across", False)
    X, Z = (-rho / 2 * (u**2 + w**2) * small * slope * x for x in (delta**2, delta))
    np.testing.assert_allclose(lift_and_drag(base, np.array([u, v, w, 0, 0, 0])), [X, 0, Z, 0, 0.7 * Z, 0], atol=1e-12)
    rudder = replace(base, span=(0, 0, -1))
    X, Y = (-rho / 2 * (u**2 + v**2) * small * slope * x for x in (delta**2, delta))
    wrench = lift_and_drag(rudder, np.array([u, v, w, 0, 0, 0]))
    np.testing.assert_allclose(wrench, [X, Y, 0, 0, 0, -0.7 * Y], atol=1e-12)


def test_lift_stalls() -> None:
    stalling = replace(RUDDER, stall=0.25, lift_slope=2.0)
    angles = np.array([-1.6, -0.25, 0.0, 0.2, 0.25, (0.25 + np.pi / 2) / 2, np.pi / 2, 3.0])
    found = [lift_coefficient(stalling, angle) for angle in angles]
    np.testing.assert_allclose(found, [0, -0.5, 0, 0.4, 0.5, 0.25, 0, 0], atol=1e-15)


@given(fins, twists)
def test_planning_has_the_wrench_and_its_slopes(fin: Fin, V: np.ndarray) -> None:
    planned = twist_law(replace(loads(FILE).carrier, laws=(Fins((fin, HULL)),)))
    assert planned is not None
    P = lift_and_drag(fin, V) + lift_and_drag(HULL, V)
    np.testing.assert_allclose(planned.wrench(V[None])[0], P, rtol=1e-9, atol=1e-9)
    if np.linalg.norm(V[:3]) < 0.1:
        return
    step = 1e-7 * np.eye(6)
    slopes = (planned.wrench(V + step) - planned.wrench(V - step)) / 2e-7
    around = np.array([planned.rate((V + s * e)[None])[0] for e in step for s in (1, 0, -1)])
    least, most = around.min(axis=0), around.max(axis=0)  # at a kink between the slopes of both sides
    if np.abs(planned.wrench(V + step) - planned.wrench(V - step)).max() < 1e-3:  # not across the flow from behind
        assert np.all(least - 0.02 <= slopes.T)
        assert np.all(most + 0.02 >= slopes.T)


@given(twists, st.floats(-1.5, 1.5))
def test_a_fin_that_feels_the_flow_drags(V: np.ndarray, deflection: float) -> None:
    """Lift has no power in the flow at the fin, drag takes power."""
    fin = replace(RUDDER, deflection=deflection)
    velocity = V[:3] + np.cross(V[3:], fin.position)
    force = lift_and_drag(fin, V)[:3]
    assert force @ velocity <= 1e-12 * math.hypot(*force) * math.hypot(*velocity)
    lifting = replace(fin, drag=0.0, induced=0.0)
    force = lift_and_drag(lifting, V)[:3]
    assert abs(force @ velocity) <= 1e-12 * math.hypot(*force) * math.hypot(*velocity)


def test_deflection_is_an_input_of_the_C() -> None:
    """The member of the table that a caller sets."""
    stand = loads(FILE)
    files = generate_all(stand).files
    assert "deflection;" in files["vessel.h"] and "may be set at run time" in files["vessel.h"]


def test_file_comes_back_and_other_stands_are_as_before() -> None:
    stand = loads(FILE)
    assert loads(dumps(stand)) == stand
    assert [len(law.fins) for body in stand.bodies if (law := body.law(Fins))] == [2, 1]
    law = stand.carrier.law(Fins)
    assert law is not None
    turned = Fins(tuple(replace(fin, deflection=0.3) for fin in law.fins))
    changed = replace(stand, carrier=stand.carrier.with_laws(turned))
    assert identities(changed).structure == identities(stand).structure
    assert identities(changed).physics != identities(stand).physics
    moved = loads(FILE.replace('mount = "pod"', 'mount = "carrier"'))
    assert identities(moved).structure != identities(stand).structure
    bare = random_stand(np.random.default_rng(1), 2, BARE)
    assert "fin" not in generate_all(bare).files[f"{bare.name}.h"].split()


def test_faults_have_a_kind_of_wrench_to_change() -> None:
    stand = loads(FILE)
    state = random_state(stand, np.random.default_rng(1))
    assert "fins" in {name for body in stand.bodies for name in _kinds(body, np.array(state.V))}
    assert len({fault.name for fault in FAULTS}) == len(FAULTS)


def _kinds(body: object, V: np.ndarray) -> dict[str, np.ndarray]:
    from mahovik.laws.fin.reference import wrenches

    return wrenches(body, np.zeros(3), V)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("span = [0, 0.1, -2]", "span = [-2, 0, 0]", "parallel to chord"),
        ("aspect = 3\n", "", "required without `aspect`"),
        ("lift_slope = 0.7", "lift_slope = 0.7\nefficiency = 0.9", "goes with `aspect`"),
        ("area = 0.01", "area = -0.01", "-0.01 m^2 is not above 0"),
        ('stall = "15 deg"', 'stall = "95 deg"', "expected above 0, at most 1.5"),
        ('speed = "whole"', 'speed = "all"', 'expected "along", "across" or "whole", found "all"'),
        ('mount = "pod"', 'mount = "pad"', 'unknown "pad", did you mean "pod"?'),
        ('name = "rudder"', 'name = "pod"', "taken by an instrument"),
        ('"10 deg"', '"10 mm"', "deflection"),
        ("chord", "cord", ""),
    ],
)
def test_refusals(old: str, new: str, words: str) -> None:
    """Each names the fin and what was found."""
    text = FILE.replace("span = [0, 0.1", "chord = [1, 0, 0]\nspan = [0, 0.1") if old == "chord" else FILE
    with pytest.raises(StandError) as caught:
        loads(text.replace(old, new))
    assert words in str(caught.value)
    assert "fin " in str(caught.value)
