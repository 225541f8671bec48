"""Energies body by body, differentiated, against (1)-(13): two ways that share no formula."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mahovik import stands
from mahovik.contract.functions import wants_of, wants_of_carrier
from mahovik.core.stand import load
from mahovik.core.stand.model import Stand
from mahovik.core.stand.random import BARE, EVERYTHING, EXTREMES, SEQUENCES, Features, random_stand
from mahovik.proof.second import Second
from mahovik.proof.verify.draw import draw
from second.agreement import AGREEMENT, differences, expectations
from toolchain.quick import quick

WANTS = tuple(want for want in wants_of("second") if want in wants_of_carrier(held=False))

EXAMPLES = sorted(Path(stands.__file__).parent.glob("*.toml"))
KINDS = {"everything": EVERYTHING, "bare": BARE, "drawn": Features()}


def agrees(stand: Stand, seed: int, count: int) -> set[tuple[str, str]]:
    """The quantities that were compared at `count` states, some of them extreme. Fails where the derivations differ."""
    second = Second(stand)
    compared = set()
    for name, state in draw(stand, seed, count):
        for what, off in differences(second.evaluate, state, expectations(stand, state)).items():
            assert off <= AGREEMENT, (stand.name, name, what)
            compared.add(what)
    return compared


@pytest.mark.parametrize("path", quick(2, EXAMPLES), ids=lambda path: path.stem)
def test_example_stands_agree_in_every_want(path: Path) -> None:
    stand = load(path)
    compared = agrees(stand, 1, 3 * len(EXTREMES) + 1)
    assert {want for want, _ in compared} == set(WANTS)


@pytest.mark.parametrize("flywheels", quick(1, [5, 0, 7, 1, 64]))
@pytest.mark.parametrize("kind", KINDS)
def test_random_general_stands_agree_in_every_want(flywheels: int, kind: str) -> None:
    angles = SEQUENCES[(flywheels + list(KINDS).index(kind)) % 3]
    stand = random_stand(np.random.default_rng(flywheels), flywheels, replace(KINDS[kind], angles=angles))
    compared = agrees(stand, flywheels, 3 * len(EXTREMES) + 1)
    assert {want for want, _ in compared} == set(WANTS)


@pytest.mark.parametrize("seed", quick(8, range(30)))
def test_many_small_random_stands_agree(seed: int) -> None:
    stand = random_stand(np.random.default_rng(seed), seed % 4)
    assert agrees(stand, seed, 6)


def test_singular_attitudes_are_refused_by_both() -> None:
    for seed, angles in enumerate(SEQUENCES):
        rng = np.random.default_rng(seed)
        stand = random_stand(rng, 2, replace(EVERYTHING, angles=angles))
        singular = 0.0 if angles == "euler" else np.pi / 2
        _, state = draw(stand, seed, 2)[1]
        for theta, refused in ((singular + 1e-7, True), (singular + 2e-6, False)):
            near = replace(state, quaternion=None, angles=(0.3, theta, -0.2))
            found = differences(Second(stand).evaluate, near, expectations(stand, near, ["generalized"]))
            assert (found == {}) == refused
            assert all(off <= AGREEMENT for off in found.values())
