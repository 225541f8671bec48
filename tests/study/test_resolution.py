"""Motions below the resolution of float: claims of `check` against the C in float itself."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from cli.run import run
from mahovik.core.stand import Stand, load
from mahovik.core.stand.summary import summarize
from mahovik.core.stand.write import dumps
from mahovik.proof import reference
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.draw import round_to_float
from mahovik.stands import names, path
from mahovik.use.study.resolution import FACTOR, MOTIONS, QUANTITIES, UNIT, balanced_flywheel, shortfalls, states
from physics.general import rows
from toolchain.quick import quick

SPEED = 300.0


@cache
def heavy() -> Stand:
    """shaker2 on a carrier of 500 t that falls, its left flywheel balanced to a millionth of a gramme millimetre."""
    stand = load(path("shaker2"))
    left = balanced_flywheel(stand.flywheels[0])
    left = replace(left, center_of_mass=(left.center_of_mass[0], 1e-12 / left.mass, 0.0))
    mass = replace(stand.carrier, mass=5e5, inertia=rows(1e5 * np.array(stand.carrier.inertia)))
    return replace(stand, carrier=mass, flywheels=(left, *stand.flywheels[1:]), gravity=(0.0, 0.0, -9.81))


def speeds(stand: Stand) -> list[float]:
    return [row.speed for row in summarize(stand).unbalance]


@pytest.mark.parametrize("name", names())
def test_the_examples_are_fine(name: str) -> None:
    stand = load(path(name))
    assert shortfalls(stand, speeds(stand)) == []


def test_a_tiny_unbalance_on_a_heavy_carrier_is_too_much() -> None:
    found = shortfalls(heavy(), [SPEED, SPEED])
    assert ("left", "forward") in {(each.flywheel, each.want) for each in found}
    assert all(each.effect < 2 * each.rounding for each in found)
    assert all("double" in str(each) and each.flywheel in str(each) for each in found)


@pytest.mark.slow
def test_the_c_in_float_does_lose_it() -> None:
    """In the claimed motion the error of the C in V_dot is larger than the whole effect of the unbalance."""
    stand = heavy()
    (claim,) = (each for each in shortfalls(stand, [SPEED, SPEED]) if (each.flywheel, each.want) == ("left", "forward"))
    without = replace(stand, flywheels=(balanced_flywheel(stand.flywheels[0]), *stand.flywheels[1:]))
    single, double = CBackend(stand, "float"), CBackend(stand)
    for state in map(round_to_float, states(stand, [SPEED, SPEED], claim.motion)):
        exact = reference.evaluate(stand, state, ["forward"])["V_dot"]
        effect = np.abs(exact - reference.evaluate(without, state, ["forward"])["V_dot"])
        off = np.abs(np.array(single.evaluate(state, ["forward"])["V_dot"]) - exact)
        fine = np.abs(np.array(double.evaluate(state, ["forward"])["V_dot"]) - exact)
        assert off.max() > effect.max()
        assert fine.max() < off.max() * 1e-6


@pytest.mark.parametrize("name", quick(1, ["sat4", "auv6"]))
def test_rounding_is_what_the_estimate_allows(name: str) -> None:
    stand = load(path(name))
    c = CBackend(stand, "float")
    for motion in MOTIONS:
        for state in map(round_to_float, states(stand, speeds(stand), motion)):
            at = reference.pieces(stand, state)
            for want, quantity in QUANTITIES.items():
                expected = reference.evaluate(stand, state, [want], at)[quantity.key]
                off = np.abs(np.array(c.evaluate(state, [want])[quantity.key]) - expected)
                assert (off <= FACTOR * UNIT * quantity.terms(at, state)).all(), (want, motion)


def test_generate_of_float_says_so_as_check_does(tmp_path: Path) -> None:
    file = tmp_path / "heavy.toml"
    file.write_text(dumps(heavy()))
    warned = [line for line in run("check", str(file)).stdout.splitlines() if line.startswith("warning: ")]
    of_float, singular = ([line for line in warned if line.startswith(f"warning: {of}")] for of in ("float: ", "(12)"))
    assert len(of_float) == len(singular) == 1
    result = run("generate", str(file), "--real", "float", "-o", str(tmp_path / "float"))
    unbalance, steps, *others = result.stderr.splitlines()
    assert (result.exit_code, unbalance, others) == (0, *of_float, singular)
    assert steps.startswith("warning: float: steps of 0.0001 s lose")
    double = run("generate", str(file), "-o", str(tmp_path / "double"))
    assert (double.exit_code, double.stderr.splitlines()) == (0, singular)
