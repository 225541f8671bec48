"""Structure and the two identities."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields, is_dataclass, replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings

from mahovik.core.stand import dumps, identities, loads
from mahovik.core.stand.law import Velocity
from mahovik.core.stand.laws import body_laws, carrier_laws
from mahovik.core.stand.model import Stand
from mahovik.core.stand.random import EVERYTHING, random_stand
from mahovik.laws.control.law import Control, ControlDerivative, ControlDerivatives
from mahovik.laws.cross_flow.law import CrossFlow
from mahovik.laws.fading.law import FadingDamping
from mahovik.laws.fin.law import Fin, Fins
from mahovik.laws.friction.law import Friction, Frictions
from mahovik.laws.propeller.law import Propeller, Propellers
from mahovik.laws.stop.law import Stop, Stops
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
