"""Run-time wrenches: a function takes them where its results depend on them, and not where they do not."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from emit.compiled import bits
from mahovik.core.emit.generate import generate_all
from mahovik.core.stand.hold import FREEDOMS
from mahovik.core.stand.model import Hold, Stand
from mahovik.core.stand.random import Features, random_stand, random_state
from mahovik.proof.verify.c_backend import InterpreterBackend
from mahovik.proof.verify.program_backend import public_names

BY_FLYWHEELS = ("torque", "torque_at", "mounts")
"""Functions whose results for a given motion depend on the wrenches on flywheels alone."""

CASES = [
    (("carrier",), False, True),
    (("carrier",), True, False),
    (("i1",), False, True),
    (("i1",), True, True),
    (("w2",), False, False),
    (("carrier", "w1"), True, True),
]


def stand_of(bodies: tuple[str, ...], held: bool, fluid: bool) -> Stand:
    """Two flywheels and an instrument; with fluid every body is damped. These bodies take a run-time wrench."""
    features = Features("ship", 1, True, fluid, fluid, 1, False, tasks=0 if held else 1)
    stand = random_stand(np.random.default_rng(3), 2, features, "pushed")
    still = (0.0, 0.0, 0.0)
    hold = Hold((FREEDOMS["roll"], FREEDOMS["z"]), still, still, still) if held else None
    return replace(
        stand,
        carrier=replace(stand.carrier, wrench_input=stand.carrier.name in bodies),
        instruments=tuple(replace(one, wrench_input=one.name in bodies) for one in stand.instruments),
        flywheels=tuple(replace(one, wrench_input=one.name in bodies) for one in stand.flywheels),
        hold=hold,
        phase_input="angle" if held else "sincos",
    )


@pytest.mark.parametrize(("bodies", "held", "fluid"), CASES)
def test_a_wrench_that_is_taken_acts(bodies: tuple[str, ...], held: bool, fluid: bool) -> None:
    """Results of every function change with the wrench on each body, or it takes none."""
    stand = stand_of(bodies, held, fluid)
    backend = InterpreterBackend(generate_all(stand))
    given = backend.arguments(random_state(stand, np.random.default_rng(1)))
    given |= {"dt": 1e-3, "order": 4, "angles": (0.1, 0.2, 0.3), "demand": (0.1,) * 6}
    takers = [body for body in bodies if body.startswith("w")]
    for name in public_names(backend.program):
        taken = "wrench" in {a.name for a in backend.program.function(name).arguments}
        if name in BY_FLYWHEELS:
            assert taken == bool(takers), name
        if not taken:
            continue
        _, still = backend.call(name, given | {"wrench": [0.0] * 6 * len(bodies)})
        for k, body in enumerate(bodies):
            pushed = [0.5 * (i // 6 == k) for i in range(6 * len(bodies))]
            _, moved = backend.call(name, given | {"wrench": pushed})
            acts = name not in BY_FLYWHEELS or body in takers
            assert (bits(still) != bits(moved)) == acts, (name, body)
