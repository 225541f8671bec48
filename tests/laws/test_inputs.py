"""Inputs of fins and propellers: many states at once, each with its own; what is refused; their names in the header."""

from __future__ import annotations

import copy
import math
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

import mahovik
from laws.stands import CARRIER, FADING, FINS, POD, PROPELLERS, STRIPS, bearing
from mahovik.core.emit.generate import generate_all
from mahovik.core.lower.fmu_variables import laws
from mahovik.core.stand import dumps, loads, rest_state
from mahovik.core.stand.files import parse_toml
from mahovik.core.stand.numbers import StandNumbers
from mahovik.out.api.stands import Stand
from mahovik.proof import reference
from mahovik.proof.verify.c_backend import CBackend

FILE = CARRIER + STRIPS + FADING + POD + FINS + PROPELLERS


def test_each_state_has_its_own_inputs() -> None:
    """A state of a table in Python has the answer of the reference with the inputs of that state."""
    model = mahovik.build(loads(FILE))
    numbers = {
        "rudder.deflection": [-0.2, 0.0, 0.1],
        "rudder.stall": [0.2, 0.3, 0.4],
        "rudder.span": [[0, 0.1, -1], [0, 0, -1], [0.2, 0, -1]],
        "main.speed": [-50.0, 0.0, 80.0],
        "main.axis": [[1, 0.1, 0], [0, 1, 0.5], [1, 1, 0]],
        "carrier.fading_damping.rate": [3.0, 0.5, 0.7],
        "carrier.cross_flow.drag_z": [[1.0, 1.1, 1.0], [0.5, 1.0, 2.0], [0.0, 1.0, 0.0]],
    }
    tables = model.tables(numbers)
    V = (1.0, 0.2, 0.1, 0.0, 0.05, 0.1)
    many = model.forward(model.states_of(np.array([model.state(V=V).array] * 3)), tables=tables)["V_dot"]
    for k in range(3):
        stand = loads(dumps(tables.stand(k)))
        alone = reference.evaluate(stand, replace(rest_state(stand), V=V), ["forward"])["V_dot"]
        np.testing.assert_allclose(many[k], alone, rtol=1e-12, atol=1e-12)


@cache
def backend() -> CBackend:
    """C of the vessel, and the same program in the interpreter."""
    return CBackend(loads(FILE))


def with_input(array: str, member: str, value: float) -> dict[str, Any]:
    """The default table as plain data, with one input changed."""
    table: dict[str, Any] = copy.deepcopy(backend().table())
    table[array][0][member] = value
    return table


USERS = ("forward", "matrices", "coupled_jacobian", "forward_jacobian", "step", "inverse", "reaction")
"""Functions with the wrench of (7), those of them that a stand without flywheels has."""


@pytest.mark.parametrize(("array", "member", "most"), [("fin", "deflection", 1.5), ("propeller", "speed", 1e5)])
@pytest.mark.parametrize("who", ["C", "interpreter"])
def test_an_input_that_is_no_number_is_refused(who: str, array: str, member: str, most: float) -> None:
    """Every function that needs the wrench refuses it; at the end of its range it is accepted."""
    c = backend()
    judged = c if who == "C" else c.interpreter
    state = rest_state(loads(FILE))
    inputs = c.arguments(replace(state, V=(1.0, 0.2, 0.1, 0.0, 0.05, 0.1))) | {"dt": 1e-6, "order": 4}
    known = {f.name: f for f in c.program.functions if f.public}
    asked = [name for name in USERS if name in known]
    assert {"forward", "matrices", "forward_jacobian", "step"} <= set(asked)
    values = {math.nan: -1, math.inf: -1, -math.inf: -1, most * 1.01: -2, -most * 1.01: -2, most: 0, -most: 0}
    for name in asked:
        for value, status in values.items():
            actual, _ = judged.call(name, inputs | {"table": with_input(array, member, value)})
            assert min(actual, 0) == status, (name, value)


def test_momentum_asks_no_fin() -> None:
    """Functions that do not depend on the wrench accept any value of its inputs."""
    c = backend()
    inputs = c.arguments(rest_state(loads(FILE))) | {"table": with_input("fin", "deflection", math.nan)}
    assert c.call("momentum", inputs)[0] == 0


def test_the_header_numbers_fins_and_propellers() -> None:
    """Their numbers follow the order of the table, body by body."""
    text = generate_all(loads(FILE)).files["vessel.h"]
    assert "enum { VESSEL_FIN_HULL, VESSEL_FIN_STERN, VESSEL_FIN_RUDDER, VESSEL_FINS = 3 };" in text
    assert "enum { VESSEL_PROPELLER_MAIN, VESSEL_PROPELLER_BOW, VESSEL_PROPELLERS = 2 };" in text
    assert "vessel_fin fin[VESSEL_FINS];" in text and "may be set at run time" in text


def test_simulators_see_numbers_with_units_and_campaigns_vary_them() -> None:
    stand = bearing("control")
    generated = generate_all(stand)
    parameters = {m.name: m for m in laws(stand, generated.layout, generated.values)}
    assert parameters["control_derivative[1]"].unit.name == "N.s2/(m.rad2)"
    assert "X += value u r rudder.deflection" in parameters["control_derivative[1]"].description
    assert parameters["carrier.control_derivatives.race"].value == 2e-4
    file = Stand.from_dict(parse_toml(FILE))
    numbers = StandNumbers(file, file.to_dict())
    (number,) = numbers.find("main.diameter")
    assert number.value == 0.14
    assert [thrust.path for thrust in numbers.find("bow.thrust")] == [f"bow.thrust[{k}]" for k in range(3)]
