"""The stream by depth: in every derivation and in the C, against the uniform stream of each depth; what is refused."""

from __future__ import annotations

import copy
import re
from collections.abc import Callable
from dataclasses import replace
from functools import cache, partial
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import mahovik
from laws.stands import CARRIER
from mahovik.core.emit.generate import generate_all
from mahovik.core.lower.fmu_variables import laws
from mahovik.core.stand import Stand, dumps, identities, loads
from mahovik.core.stand.model import StreamProfile
from mahovik.core.stand.random import Features, random_stand, random_state
from mahovik.errors import StandError, StateError
from mahovik.out.commands.check import check
from mahovik.out.commands.report import bodies_part
from mahovik.proof import reference
from mahovik.proof.reference.pieces import stream_at
from mahovik.proof.verify.backends import KeptBackend
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.draw import draw
from mahovik.use.numeric.frame import uniform_stream
from second.agreement import AGREEMENT, differences, expectations

PROFILE = StreamProfile(
    (0.1, -0.2, 2.0), (-1.0, 0.5, 1.0, 9.0), ((0.8, 0.1, 0), (0.6, -0.2, 0.05), (0.1, 0.4, 0), (-0.3, 0, 0.1))
)
FILE = (
    """
schema = 1
name = "diver"
gravity = [0, 0, 9.81]
[stream_profile]
depth = ["0 m", 10, 50]
velocity = [["2 kn", 0, 0], [0.5, 0.1, 0], [0, 0, 0]]
"""
    + CARRIER.split('name = "vessel"\n')[1]
    + "added_mass = [1, 30, 30, 0, 4, 4]\n"
)


@cache
def sheared() -> Stand:
    """A random stand in a fluid, with added mass and damping, in a stream by depth."""
    features = Features(instruments=1, fluid=True, gravity=True, stream=True)
    return replace(random_stand(np.random.default_rng(5), 2, features), profile=PROFILE)


@cache
def small_backend() -> CBackend:
    return CBackend(loads(FILE))


def test_the_compiled_c_agrees_and_a_wrong_shear_of_the_lowest_layer_is_found() -> None:
    """The C with another number there is not that of the stand."""
    stand = loads(FILE)
    table = copy.deepcopy(small_backend().table())
    table["stream_profile"]["shear"][-1][0] *= 1.01
    wrong = 0
    for _, state in draw(stand, 0, 12):
        inputs = small_backend().arguments(state)
        right, other = (small_backend().call("forward", inputs | more)[1]["V_dot"] for more in ({}, {"table": table}))
        off = differences(small_backend().evaluate, state, expectations(stand, state))
        assert max(off.values()) <= AGREEMENT
        wrong += not np.allclose(right, other, rtol=1e-9)
    assert wrong >= 3


def test_at_each_depth_it_is_the_uniform_stream_of_that_depth() -> None:
    """Accelerations, momentum, wrench: the profile acts by the velocity at O1 alone."""
    for number in range(4):
        state = random_state(sheared(), np.random.default_rng(number))
        u = stream_at(sheared(), state.position)
        uniform = replace(sheared(), profile=None, stream=tuple(u.tolist()))
        want = ["forward", "momentum", "torque"]
        answer, expected = reference.evaluate(sheared(), state, want), reference.evaluate(uniform, state, want)
        for name in expected:
            np.testing.assert_array_equal(answer[name], expected[name])


def test_rigorous_balls_hold_it() -> None:
    from rigorous.balls import forward_is_enclosed

    forward_is_enclosed(sheared(), random_state(sheared(), np.random.default_rng(3)))


@given(st.floats(0, 50))
def test_lines_between_stations(depth: float) -> None:
    """The stream between stations is written out by hand."""
    u = stream_at(loads(FILE), (3.0, -2.0, depth))
    share = min(depth / 10, 1.0)
    rest = max(0.0, (depth - 10) / 40)
    top = 2 * 1852 / 3600
    expected = [top + share * (0.5 - top) - rest * 0.5, 0.1 * share - 0.1 * rest, 0]
    np.testing.assert_allclose(u, expected, atol=1e-13)


WRONG = [
    *((*place, bad, status) for place in (("depth", 1), ("top", 2), ("shear", 1, 0), ("down", 0))
      for bad, status in ((np.nan, -1), (np.inf, -1), (-np.inf, -1), (1e7, -2))),
    ("depth", 1, 60.0, -2), ("depth", 1, -1.0, -2), ("depth", 0, 10.0, -2), ("down", 2, 1.1, -2),
    ("shear", 0, 0, 9e4, -2),
]  # fmt: skip


@pytest.mark.parametrize("wrong", WRONG, ids=str)
def test_wrong_numbers_of_the_profile_are_refused(wrong: tuple[Any, ...]) -> None:
    """NOT_FINITE or RANGE, and nothing is written: in the table of the C as in that of the interpreter."""
    c = small_backend()
    *place, last, bad, status = wrong
    table = copy.deepcopy(c.table())
    at = table["stream_profile"]
    for key in place:
        at = at[key]
    at[last] = bad
    state = replace(random_state(loads(FILE), np.random.default_rng(1)), position=(0.0, 0.0, 20.0))
    inputs = c.arguments(state) | {"table": table, "dt": 1e-3, "order": 4}
    for judged in (c, c.interpreter):
        for name in ("forward", "step"):
            assert judged.call(name, inputs)[0] == status, name


@pytest.mark.parametrize("depth", [-0.001, 50.001, 1e5])
def test_a_depth_beyond_the_profile_is_refused(depth: float) -> None:
    """The C returns RANGE, the references say it in words, and so does `eval` of the C."""
    from mahovik.proof.second import Second

    stand = loads(FILE)
    c = CBackend(stand)
    state = replace(random_state(stand, np.random.default_rng(1)), position=(0.0, 0.0, depth))
    inputs = c.arguments(state) | {"dt": 1e-3, "order": 4}
    for judged, table in ((c, {}), (c.interpreter, {"table": c.table()})):
        for name in ("forward", "matrices", "momentum", "forward_jacobian", "step"):
            assert judged.call(name, inputs | table)[0] == -2, name
    asked = (Second(stand).evaluate, KeptBackend(stand, "double").evaluate, partial(reference.evaluate, stand))
    for ask in asked:
        with pytest.raises(StateError, match=f"position: depth {depth:.6g} m is outside of stream_profile"):
            ask(state, ["forward"])


def test_a_run_that_leaves_the_profile_says_so() -> None:
    """Depth and profile by name, in the C as in SciPy."""
    stand = loads(FILE.replace("added_mass", "buoyancy = { displaced_mass = 40 }\nadded_mass"))
    still = {"position": [0, 0, 0.1], "V": [0] * 6, "phi": [], "phi_dot": []}
    for backend in ({"backend": "c", "dt": 1e-2}, {"backend": "scipy"}):
        run = mahovik.simulate(stand, until=1.0, start=still, every=1e-2, **backend)
        assert run["t"][-1] < 0.5
        words = r"depth -[\d.e-]+ m is outside of stream_profile, which is given from 0 m"
        assert re.search(words, str(run["stopped"]))


def test_file_comes_back_and_other_stands_are_as_before() -> None:
    stand = loads(FILE)
    assert loads(dumps(stand)) == stand
    assert stand.stream == (0.0, 0.0, 0.0) and stand.profile is not None
    assert stand.profile.down == (0.0, 0.0, 9.81)
    faster = replace(stand, profile=replace(stand.profile, depth=(0.0, 10.0, 51.0)))
    assert identities(faster).structure == identities(stand).structure
    assert identities(faster).physics != identities(stand).physics
    assert "stream_profile" in generate_all(stand).files["diver.h"]
    plain = loads(
        FILE.replace("[stream_profile]", "stream = [0, 0, 0]").replace("depth = ", "#").replace("velocity", "#")
    )
    assert "stream_profile" not in generate_all(plain).files["diver.h"]
    assert identities(plain).structure != identities(stand).structure


STUDIES: dict[str, Callable[[Stand], object]] = {
    "modes": mahovik.modes,
    "vibration": lambda stand: mahovik.vibration(stand, speed="100rpm", at="carrier"),
    "plan": uniform_stream,
}


@pytest.mark.parametrize("study", STUDIES.values(), ids=STUDIES)
def test_small_motions_refuse_it_before_they_search(study: Callable[[Stand], object]) -> None:
    """A stand without an equilibrium is refused for its profile."""
    stand = replace(sheared(), tasks=())
    with pytest.raises(StandError, match="stream_profile: found a stream that changes with depth"):
        study(stand)


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('["0 m", 10, 50]', "[0, 10]", "expected 2 velocities, one for each `depth`, found 3"),
        ('["0 m", 10, 50]', "[0, 10, 10]", "expected increasing numbers, found 10 m after 10 m"),
        ('["0 m", 10, 50]', "[0]", "expected"),
        ('["0 m", 10, 50]', "[0, 50, 50.00000000001]", "apart by at least 1e-09 of their depth"),
        ('["0 m", 10, 50]', "[0, 10, 1e9]", "expected depths of at most 1e+06 m"),
        ('["0 m", 10, 50]', "[0, 1e-9, 50]", "expected at most 100000 (m/s)/m, found"),
        ('"2 kn"', "2e4", "velocity[0]: expected components of at most 10000 m/s, found 20000 m/s"),
        ('["0 m", 10, 50]', '["0 s", 10, 50]', "a length"),
        ("velocity = [", "velocity = 3 # [", "expected a list of velocities"),
        ("gravity = [0, 0, 9.81]", "", "down: required without gravity"),
        ("depth = ", "down = [0, 0, 0]\ndepth = ", "has no direction"),
        ("velocity = ", "velocitie = ", 'unknown key "velocitie"'),
    ],
)
def test_refusals(old: str, new: str, words: str) -> None:
    """Each names the table and what was found."""
    assert old in FILE
    with pytest.raises(StandError) as caught:
        loads(FILE.replace(old, new))
    assert words in str(caught.value)
    assert "stream_profile" in str(caught.value)


def test_the_report_names_the_velocity_of_each_station() -> None:
    stand = mahovik.Stand.of(loads(FILE))
    words = str(bodies_part(stand, check(stand)).markup)
    assert "(0.5, 0.1, 0) m/s at 10 m" in words and "(0, 0, 0) m/s at 50 m" in words


def test_simulators_see_its_numbers() -> None:
    generated = generate_all(loads(FILE))
    parameters = {m.name: m for m in laws(loads(FILE), generated.layout, generated.values)}
    assert parameters["stream_profile.depth[3]"].value == 50.0
    assert parameters["stream_profile.shear[1,2]"].value == pytest.approx(0.01)
    assert parameters["stream_profile.shear[1,2]"].unit.name == "1/s"


def test_an_equilibrium_at_the_first_station_is_found_and_one_outside_is_refused() -> None:
    """The search looks above the surface, where the stream is that of the nearest station."""
    still = loads(FILE.replace('["2 kn", 0, 0], [0.5, 0.1, 0]', "[0, 0, 0], [0, 0, 0]"))
    weightless = replace(still, gravity=(0.0, 0.0, 0.0))
    assert "position" not in mahovik.check(weightless)["rest"]["state"]
    assert still.profile is not None
    deep = replace(weightless, profile=replace(still.profile, depth=(5.0, 10.0, 50.0)))
    result = mahovik.check(deep)
    said = [line for line in result.messages if line.startswith("no rest pose")]
    assert result["rest"] is None
    assert "depth 0 m is outside of stream_profile, which is given from 5 m to 50 m" in said[0]
