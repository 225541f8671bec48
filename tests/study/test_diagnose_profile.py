"""A wrong profile of the stream is named as such, and as nothing else."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import pytest

from mahovik.core.stand import load
from mahovik.core.stand.model import Stand, StreamProfile
from mahovik.proof.diagnose.diagnosis import Diagnoser, Diagnosis
from mahovik.proof.diagnose.faults import DICTIONARY
from mahovik.proof.diagnose.faults.stream import PROFILE_FAULTS, above, mean, nearest
from mahovik.proof.diagnose.predict import FaultyProgram, Part
from mahovik.proof.diagnose.words import name_of
from mahovik.stands import path

PROFILE = StreamProfile((0.0, 0.0, 1.0), (0.0, 10.0, 50.0), ((0.5, 0.0, 0.1), (0.25, 0.0, 0.0), (0.0, 0.0, 0.0)))


@cache
def stand() -> Stand:
    """The underwater vehicle, without suspension and legs, in a stream that depends on depth alone."""
    return replace(load(str(path("auv6"))), stream=(0.0, 0.0, 0.0), profile=PROFILE, laws=())


@cache
def diagnoser() -> Diagnoser:
    return Diagnoser(stand(), wants=("forward",))


def names(found: Diagnosis) -> set[str]:
    return {name_of(part) for cause in found.causes for part in cause.parts}


@pytest.mark.parametrize("fault", PROFILE_FAULTS, ids=lambda fault: fault.name)
def test_a_wrong_profile_is_named(fault: object) -> None:
    (planted,) = (each for each in DICTIONARY if each is fault)
    found = diagnoser().diagnose(FaultyProgram(stand(), (Part(planted),)).answer)
    assert planted.name in names(found)
    assert names(found) <= {planted.name, "position ignored"}


@pytest.mark.parametrize(
    "changed",
    [
        {"profile": None, "stream": (0.24, 0.0, 0.02)},
        {"profile": replace(PROFILE, velocity=((0.5, 0.0, 0.1), (0.35, 0.0, 0.0), (0.0, 0.0, 0.0)))},
    ],
    ids=["uniform", "another velocity at a station"],
)
def test_what_is_not_in_the_dictionary_has_no_name(changed: dict[str, object]) -> None:
    found = diagnoser().diagnose(FaultyProgram(replace(stand(), **changed)).answer)  # type: ignore[arg-type]
    assert found.outcome == "unknown"


def test_velocities_of_wrong_profiles() -> None:
    assert nearest(PROFILE, 29.0).tolist() == [0.25, 0.0, 0.0]
    assert above(PROFILE, 10.0).tolist() == above(PROFILE, 49.0).tolist() == [0.25, 0.0, 0.0]
    assert mean(PROFILE, 3.0).tolist() == pytest.approx([(3.75 + 5.0) / 50, 0.0, 0.5 / 50])
