"""The magnetic torquer: d x B on its mount, in every derivation and in the C; what is refused."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from mahovik.core.emit.generate import generate_all
from mahovik.core.stand import Stand, dumps, identities, loads, rest_state
from mahovik.core.stand.random import BARE, Features, random_stand, random_state
from mahovik.errors import StandError
from mahovik.laws.torquer.data import Torquer, Torquers
from mahovik.proof import reference
from mahovik.proof.verify.c_backend import CBackend
from second.agreement import AGREEMENT, differences, expectations, worst_difference
from toolchain.quick import quick

FILE = """
schema = 1
name = "compass"
magnetic_field = ["20 uT", 0, "-40 uT"]
[carrier]
mass = 3.0
inertia = [0.1, 0.2, 0.25]
[[instrument]]
name = "boom"
angles = ["90 deg", 0, 0]
[[torquer]]
name = "mx"
dipole = [2.0, 0, 0]
[[torquer]]
name = "my"
mount = "boom"
dipole = { value = [3.0, 0, 0], unit = "A m^2" }
"""


def torqued(seed: int, flywheels: int = 2, **kinds: Any) -> Stand:
    """A random stand with three torquers."""
    laws = {"suspension": 0, "leg": 0, "torquer": 3}
    return random_stand(np.random.default_rng(seed), flywheels, Features(instruments=2, laws=laws, **kinds))


def test_moment_by_hand() -> None:
    """Field and dipoles at an aligned attitude: (2, 0, 0) + (0, 3, 0) of the turned boom, times (20, 0, -40) uT."""
    stand = loads(FILE)
    assert stand.law(Torquers) == Torquers(
        (2e-5, 0.0, -4e-5), (Torquer("mx", "carrier", (2.0, 0.0, 0.0)), Torquer("my", "boom", (3.0, 0.0, 0.0)))
    )
    F = reference.pieces(stand, rest_state(stand)).F
    np.testing.assert_allclose(F, [0, 0, 0, -12e-5, 8e-5, -6e-5], rtol=1e-12, atol=1e-19)


def test_the_field_is_constant_in_E0() -> None:
    """Half a turn about z turns the field in E1, and so the moment of a dipole along x."""
    stand = loads(FILE)
    turned = replace(rest_state(stand), angles=(np.pi, 0.0, 0.0))
    F = reference.pieces(stand, turned).F
    np.testing.assert_allclose(F[3:], np.cross([2.0, 3.0, 0.0], [-2e-5, 0.0, -4e-5]), rtol=1e-12, atol=1e-19)


@pytest.mark.slow
@pytest.mark.parametrize("seed", quick(2, range(4)))
def test_derivations_and_C_agree(seed: int) -> None:
    """Literal, by energy and the compiled C."""
    from mahovik.proof.second import Second

    stand = torqued(seed, stream=False, wrench_inputs=False)
    backend, second = CBackend(stand), Second(stand)
    for number in range(3):
        state = random_state(stand, np.random.default_rng([seed, number]))
        assert worst_difference(stand, state, second.evaluate, backend.evaluate) <= AGREEMENT


def test_a_missing_torquer_would_be_seen() -> None:
    """The comparison above can fail."""
    stand = torqued(0)
    state = random_state(stand, np.random.default_rng(0))
    law = stand.law(Torquers)
    assert law is not None
    changed = stand.with_laws(replace(law, torquers=law.torquers[1:]))
    found = differences(lambda s, w: reference.evaluate(changed, s, w), state, expectations(stand, state))
    assert max(found.values()) > 1e-6


def test_rigorous_balls_hold_the_moment() -> None:
    """In balls as by the literal formula."""
    from rigorous.balls import forward_is_enclosed

    stand = torqued(5)
    state = random_state(stand, np.random.default_rng(5))
    forward_is_enclosed(stand, state)


def test_slopes_of_planning() -> None:
    """Slopes agree with differences of the wrench over small turns of the carrier."""
    from mahovik.laws.torquer import plan

    stand = torqued(6)
    state = replace(random_state(stand, np.random.default_rng(6)), quaternion=None, angles=(0.3, 0.4, -0.2))
    C = reference.pieces(stand, state).C

    def moment_at(turn: Any) -> Any:
        zero = np.zeros((1, 6))
        turned = (C @ Rotation.from_rotvec(turn).as_matrix())[None]
        return SimpleNamespace(C=turned, O1=np.zeros((1, 3)), V=zero)

    by_pose = plan.slopes(stand, moment_at(np.zeros(3))).by_pose[0]
    for k, step in enumerate(1e-5 * np.eye(3)):
        difference = (plan.wrench(stand, moment_at(step)) - plan.wrench(stand, moment_at(-step)))[0] / 2e-5
        np.testing.assert_allclose(by_pose[:, 3 + k], difference, rtol=0, atol=1e-8)
    F = reference.pieces(stand, state).terms["carrier"]
    own = sum(wrench for kind, wrench in F.items() if kind.startswith("torquer"))
    np.testing.assert_allclose(plan.wrench(stand, moment_at(np.zeros(3)))[0], own, rtol=0, atol=1e-13)


def test_file_comes_back_and_numbers_are_no_structure() -> None:
    """A written file reads as the same stand; dipoles change the physics alone, mounts the structure."""
    stand = torqued(3)
    assert loads(dumps(stand)) == stand
    law = stand.law(Torquers)
    assert law is not None
    first, *rest = law.torquers
    stronger = stand.with_laws(replace(law, torquers=(replace(first, dipole=(9.0, 0.0, 0.0)), *rest)))
    assert identities(stronger).structure == identities(stand).structure
    assert identities(stronger).physics != identities(stand).physics
    moved = "i1" if first.mount != "i1" else "i2"
    elsewhere = stand.with_laws(replace(law, torquers=(replace(first, mount=moved), *rest)))
    assert identities(elsewhere).structure != identities(stand).structure


def test_stands_without_torquers_have_none_in_the_C() -> None:
    """No member and no function for what is not there."""
    stand = random_stand(np.random.default_rng(1), 2, BARE)
    assert "magnetic" not in generate_all(stand).files[f"{stand.name}.h"]
    assert "magnetic_field" in generate_all(torqued(1)).files["random.h"]


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('mount = "boom"', 'mount = "bom"', 'torquer "my", mount: unknown "bom", did you mean "boom"?'),
        ('name = "my"', 'name = "boom"', 'torquer "boom", name: taken by an instrument'),
        ("[2.0, 0, 0]", "[2.0, 0, inf]", 'torquer "mx", dipole[2]'),
        ("[2.0, 0, 0]", '["2 T", 0, 0]', 'torquer "mx", dipole[0]'),
        ('"20 uT"', '"20 A m^2"', "magnetic_field[0]"),
        ("dipole = [2.0, 0, 0]", "dipol = [2.0, 0, 0]", 'torquer "mx": unknown key "dipol"'),
        ("magnetic_field", "magnetic_feld", 'unknown key "magnetic_feld"'),
    ],
)
def test_refusals(old: str, new: str, words: str) -> None:
    """Each names the place and what was found."""
    with pytest.raises(StandError) as caught:
        loads(FILE.replace(old, new))
    assert words in str(caught.value)


@pytest.mark.parametrize(("unit", "tesla"), [("T", 1.0), ("mT", 1e-3), ("uT", 1e-6), ("nT", 1e-9)])
def test_units_of_the_field(unit: str, tesla: float) -> None:
    stand = loads(FILE.replace('["20 uT", 0, "-40 uT"]', f'["3 {unit}", 0, 0]'))
    law = stand.law(Torquers)
    assert law is not None
    field, *others = law.magnetic_field
    assert field == pytest.approx(3 * tesla, rel=1e-15)
    assert others == [0.0, 0.0]
