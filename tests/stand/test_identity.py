"""Structure and the two identities; random stands and states are valid and cover what they should."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import fields, is_dataclass, replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from numpy.typing import NDArray

from mahovik.contract.quantities import BOUNDS, QUANTITIES, limits_of
from mahovik.core.stand import dumps, identities, loads, rest_state
from mahovik.core.stand.law import Velocity
from mahovik.core.stand.laws import body_laws, carrier_laws
from mahovik.core.stand.model import Sequence, Stand, State
from mahovik.core.stand.random import EVERYTHING, EXTREMES, random_stand
from mahovik.laws.control.law import Control, ControlDerivative, ControlDerivatives
from mahovik.laws.cross_flow.law import CrossFlow
from mahovik.laws.fading.law import FadingDamping
from mahovik.laws.fin.law import Fin, Fins
from mahovik.laws.friction.law import Friction, Frictions
from mahovik.laws.propeller.law import Propeller, Propellers
from mahovik.laws.stop.law import Stop, Stops
from mahovik.proof.verify.draw import LEAST_EXPONENT, draw
from strategies import stands

TEXT = """schema = 1
name = "a"   # comment
gravity = [0, 0, -9.81]
[carrier]
mass = 2
inertia = [1.0, 1, 1]
[[flywheel]]
name = "w"
mass = "500 g"
angles = ["90 deg", 0]
inertia = [0.002, 0.001, 0.001]
"""
RESPELLED = """# another comment\r
schema = 1\r
gravity = ["0 mm/s^2", -0.0, "-981 cm/s^2"]\r
name = "a"\r
flywheel = [{ inertia = { value = [2000, 1000, 1000], unit = "kg mm^2" }, angles = [1.5707963267948966, 0, 0],\
 name = "w", mass = 0.5 }]\r
[carrier]\r
inertia = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]\r
inertia_about = "center_of_mass"\r
mass = 2.000\r
"""


def test_spelling_changes_neither_identity() -> None:
    assert identities(loads(TEXT)) == identities(loads(RESPELLED))


def with_one_other(value: Any, place: str) -> Iterator[tuple[str, Any]]:
    """Data with each of its numbers changed in turn, and the place of the number."""
    if isinstance(value, float):
        yield place, 0.5 + 2.0 * value
    elif is_dataclass(value):
        for field in fields(value):
            for where, other in with_one_other(
                getattr(value, field.name), f"{place} {type(value).__name__}.{field.name}"
            ):
                yield where, replace(value, **{field.name: other})  # type: ignore[type-var]
    elif isinstance(value, tuple):
        for k, item in enumerate(value):
            for where, other in with_one_other(item, f"{place}[{k}]"):
                yield where, (*value[:k], other, *value[k + 1 :])


@pytest.mark.slow
def test_every_number_of_a_stand_changes_its_physics() -> None:
    """Masses, places, motors, and the data of all laws, of bodies and of the carrier: none is left out."""
    drag = CrossFlow(1.0, (0.0, 1.0), (1.0, 2.0), (3.0, 4.0), (1.5, 1.25), (2.5, 2.25), 2, together=False)
    stand = random_stand(np.random.default_rng(1), 3, EVERYTHING)
    fin = Fin("a", (1.5, 2.0, 2.5), (3.0, 3.5, 4.0), (4.5, 5.0, 5.5), 6.0, 6.5, 7.0, 7.5, 8.0, 8.5, 9.0, "across", True)
    ahead, around = (7.0, 7.5, 8.0), (8.5, 9.0, 9.5)
    propeller = Propeller("b", (1, 2, 3), (4, 5, 6), 6.5, 7.0, ahead, around, 10.0, 0.5, 0.75, whole=True, left=False)
    along = Frictions((Friction(0, "x", 1.0, 2.0, 3.0, 4.0, 5.0),)), Stops((Stop(0, "x", 6.0, True, 7.0, 8.0),))
    stand = stand.with_laws(*along)
    fading = FadingDamping(tuple(tuple(6.0 * i + j + 1 for j in range(6)) for i in range(6)), 2.0)  # type: ignore[arg-type]
    steering = ControlDerivatives((ControlDerivative(0, (Velocity(0, False), Control("b", "race", False)), 2.5),), 0.25)
    laws = (drag, Fins((fin,)), Propellers((propeller,)), fading, steering)
    stand = replace(stand, carrier=stand.carrier.with_laws(*laws))
    hashes = {"as it is": identities(stand).physics}
    for place, other in with_one_other(stand, ""):
        hashes[place] = identities(other).physics
    assert all(any(f" {law.__name__}." in place for place in hashes) for law in (*carrier_laws(), *body_laws()))
    places: dict[str, str] = {}
    same = [(place, places[digest]) for place, digest in hashes.items() if places.setdefault(digest, place) != place]
    assert same == []


def test_names_kinds_and_order_change_both() -> None:
    ours = identities(loads(TEXT))
    for change in (
        TEXT.replace('"a"', '"b"'),
        TEXT.replace('"w"', '"w2"'),
        TEXT.replace("schema = 1", 'schema = 1\nangles = "euler"'),
        TEXT.replace("schema = 1", "schema = 1\nstream = [0, 0, 0]"),
        TEXT.replace("schema = 1", 'schema = 1\nphase_input = "sincos"'),
        TEXT.replace("[0, 0, -9.81]", "[0, 0, 0]"),
        TEXT.replace("mass = 2", "mass = 2\nwrench_input = true"),
        TEXT.replace("mass = 2", "mass = 2\nadded_mass = [1, 1, 1, 0, 0, 0]"),
        TEXT + '[[point]]\nname = "p"\n',
    ):
        theirs = identities(loads(change))
        assert ours.structure != theirs.structure
        assert ours.physics != theirs.physics


@settings(max_examples=30, deadline=None)
@given(stands(max_flywheels=4))
def test_writing_and_reading_back_is_the_same_stand(stand: Stand) -> None:
    again = loads(dumps(stand))
    assert stand == again
    assert identities(stand) == identities(again)


Array = NDArray[np.float64]


NORMAL = ("position", "V", "phi_dot", "phi_ddot", "V_dot", "tau")
"""Inputs that are normal numbers of the spread that the contract gives."""


@cache
def stand(angles: Sequence = "ship") -> Stand:
    """Two flywheels, wrenches on some bodies, no suspension: no state is near a branch."""
    laws = {**EVERYTHING.laws, "suspension": 0}
    example = random_stand(np.random.default_rng(4), 2, replace(EVERYTHING, angles=angles, laws=laws))
    assert 0 < sum(body.wrench_input for body in example.bodies) < len(example.bodies)
    return example


def check_normal(values: Array, spread: Array) -> None:
    """Columns are independent, centred, and of this spread, beyond chance (5 sigma)."""
    assert np.all(spread > 0)
    assert np.all(np.abs(values.mean(axis=0)) < 5 * spread / math.sqrt(len(values)))
    assert np.all(np.abs(values.std(axis=0) / spread - 1) < 5 / math.sqrt(2 * len(values)))
    likeness = np.corrcoef(values.T) - np.eye(values.shape[1])
    assert np.all(np.abs(likeness) < 5 / math.sqrt(len(values)))


def spread_of(symbol: str, count: int) -> Array:
    row = QUANTITIES[symbol]
    assert 0 < max(row.deviation) <= row.ordinary
    return np.array(np.repeat(row.deviation, count // len(row.deviation)), dtype=np.float64)


def at_limits(state: State, symbol: str) -> bool:
    return bool(np.all(np.abs(getattr(state, symbol)) == limits_of(symbol)))


IS_OF_KIND: dict[str, Callable[[State, float, float], bool]] = {
    "rest": lambda x, phase, tiny: x == rest_state(stand()),
    "quarter_phases": lambda x, phase, tiny: all(abs(math.sin(2 * phi)) < 1e-5 for phi in x.phi),
    "huge_phases": lambda x, phase, tiny: all(0.5 * phase <= abs(phi) <= phase for phi in x.phi),
    "fast": lambda x, phase, tiny: (
        all(0.3 <= abs(speed) / BOUNDS["MAX_SPEED"].value <= 1.0 for speed in x.phi_dot) and max(map(abs, x.V)) > 30
    ),
    "half_turn": lambda x, phase, tiny: x.quaternion is not None and x.quaternion[0] == 0.0,
    "near_singular": lambda x, phase, tiny: x.angles is not None and 1e-5 <= abs(math.cos(x.angles[1])) <= 1e-2,
    "tiny": lambda x, phase, tiny: all(0 < abs(a) < tiny for a in (*x.position, *x.V, *x.phi, *x.phi_dot)),
    "limits": lambda x, phase, tiny: (
        all(at_limits(x, symbol) for symbol in NORMAL) and {abs(phi) for phi in x.phi} == {phase}
    ),
}
"""Tests of the kinds, with the largest phase and a number above all tiny ones."""


@pytest.mark.parametrize("real", ["double", "float"])
def test_verify_draws_ordinary_and_extreme_states(real: str) -> None:
    states = draw(stand(), 1, 121, real)
    kinds = Counter(name.split()[0] for name, _ in states)
    expected = {"rest": 1, "random": 80}
    expected |= {kind: 6 if number < 5 else 5 for number, kind in enumerate(EXTREMES[1:])}
    assert kinds == expected
    phase, tiny = limits_of("phi", real)[0], 10.0 ** (LEAST_EXPONENT[real] / 31 + 4)
    for name, state in states:
        kind = name.split()[0]
        if kind in IS_OF_KIND:
            assert IS_OF_KIND[kind](state, phase, tiny), name
        else:
            assert not any(is_of_it(state, phase, 1e-6) for is_of_it in IS_OF_KIND.values()), name
        bodies = [body.name for body in stand().bodies if body.wrench_input and kind != "rest"]
        assert list(state.wrench) == bodies, name
        assert all(all(wrench) for wrench in state.wrench.values())
    ordinary = [state for name, state in states if name.startswith("random")]
    for symbol in NORMAL:
        values = np.array([getattr(state, symbol) for state in ordinary])
        check_normal(values, spread_of(symbol, values.shape[1]))
