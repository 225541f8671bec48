"""Stands with everything, and their programs run by the interpreter, right or deliberately broken."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace
from functools import cache

import numpy as np

from mahovik.core.emit.generate import Generated
from mahovik.core.lower.layout import Layout
from mahovik.core.lower.program import lower_layout
from mahovik.core.lower.values import Values
from mahovik.core.program.types import DOUBLE
from mahovik.core.stand.model import Sequence, Stand
from mahovik.core.stand.random import EVERYTHING, random_stand
from mahovik.core.stand.structure import structure
from mahovik.laws.buoyancy.law import Buoyancy
from mahovik.laws.damping.law import Damping


@cache
def everything(angles: Sequence = "ship") -> Stand:
    """A stand with every kind of wrench and body; flywheel w1 is damped, floats, and takes a run-time wrench."""
    features = replace(EVERYTHING, angles=angles)
    for seed in range(1000):
        stand = random_stand(np.random.default_rng(seed), 3, features)
        first = stand.flywheels[0]
        dampings = [damping for body in stand.bodies if (damping := body.law(Damping)) is not None]
        if (
            first.law(Damping) is not None
            and first.law(Buoyancy) is not None
            and first.wrench_input
            and first.inertia_about == "center_of_mass"
            and any(wheel.mount != "carrier" for wheel in stand.flywheels)
            and any(p.added_mass is not None for p in stand.instruments)
            and all(any(getattr(d, kind) for d in dampings) for kind in ("linear", "quadratic", "terms"))
        ):
            return stand
    raise AssertionError("no such stand in a thousand")


def generated(stand: Stand) -> Generated:
    """The program of a stand and its numbers, without C."""
    layout = Layout(structure(stand), DOUBLE)
    program = lower_layout(layout)
    return Generated(layout, program, Values(stand, layout, program), {})


def changed(pattern: str, new: str, count: int = 1) -> Callable[[str], str]:
    """The source with a pattern replaced, which it must hold."""

    def change(text: str) -> str:
        text, replaced = re.subn(pattern, new, text, count=count)
        assert replaced
        return text

    return change
