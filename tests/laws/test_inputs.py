"""Fins, propellers and strips of many states at once, each with inputs and numbers of its own."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

import mahovik
from mahovik.core.stand import dumps, loads, rest_state
from mahovik.proof import reference

FILE = """
schema = 1
name = "vessel"
[carrier]
mass = 30.0
inertia = [0.2, 3.0, 3.0]
[carrier.cross_flow]
density = 1025
x = [-0.7, 0, 0.7]
height = [0.1, 0.19, 0]
breadth = [0, 0.19, 0]
drag_y = 1.1
drag_z = [1.0, 1.1, 1.0]
[[instrument]]
name = "pod"
position = [0.3, 0, 0.2]
[[fin]]
name = "rudder"
mount = "pod"
position = [-0.7, 0, 0.1]
span = [0, 0.1, -2]
density = 1025
area = 0.01
aspect = 3
stall = "15 deg"
[[propeller]]
name = "main"
position = ["-80 cm", 0, 0]
axis = [1, 0.1, 0]
density = 1026
diameter = "14 cm"
thrust = [0.4566, -0.4174]
torque = [0.07, -0.0585]
"""


def test_each_state_has_its_own_inputs() -> None:
    """Tables of Python against the reference of each sample."""
    model = mahovik.build(loads(FILE))
    numbers = {
        "rudder.deflection": [-0.2, 0.0, 0.1],
        "rudder.stall": [0.2, 0.3, 0.4],
        "rudder.span": [[0, 0.1, -1], [0, 0, -1], [0.2, 0, -1]],
        "main.speed": [-50.0, 0.0, 80.0],
        "main.axis": [[1, 0.1, 0], [0, 1, 0.5], [1, 1, 0]],
        "carrier.cross_flow.drag_z": [[1.0, 1.1, 1.0], [0.5, 1.0, 2.0], [0.0, 1.0, 0.0]],
    }
    tables = model.tables(numbers)
    V = (1.0, 0.2, 0.1, 0.0, 0.05, 0.1)
    many = model.forward(model.states_of(np.array([model.state(V=V).array] * 3)), tables=tables)["V_dot"]
    for k in range(3):
        stand = loads(dumps(tables.stand(k)))
        alone = reference.evaluate(stand, replace(rest_state(stand), V=V), ["forward"])["V_dot"]
        np.testing.assert_allclose(many[k], alone, rtol=1e-12, atol=1e-12)
