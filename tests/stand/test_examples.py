"""The example stands that the package ships, and files of other kinds in the place of a stand file."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mahovik import stands
from mahovik.core.stand import load
from mahovik.core.stand.summary import summarize
from mahovik.errors import StandError, UsageError
from mahovik.laws.suspension.law import Suspension
from mahovik.stands import names, path


def test_the_examples_are_there() -> None:
    assert names() == ("auv6", "bench8", "demo3", "eye4", "remus6", "sat4", "shaker2", "two_exciters")


@pytest.mark.parametrize("name", names())
def test_each_loads_under_its_own_name_and_says_what_it_shows(name: str) -> None:
    assert name == load(path(name)).name
    assert path(name).read_text().startswith("# ")


def test_an_unknown_example_is_a_usage_error() -> None:
    with pytest.raises(UsageError, match='no example stand "bench9", did you mean "bench8"'):
        path("bench9")


def test_remus6_has_the_published_totals() -> None:
    """30.48 kg, centre of gravity 19.6 mm below the centre of buoyancy, 0.177 and 3.45 kg m2 about that."""
    stand = load(path("remus6"))
    summary = summarize(stand)
    assert summary.mass == pytest.approx(30.48, rel=1e-12)
    assert np.array(summary.center_of_mass) == pytest.approx(np.array([0, 0, 0.0196]), abs=1e-7)
    assert stand.flywheels[5].mount == "nose"


def test_bench8_weight_hangs_at_its_suspension() -> None:
    """The suspension is raised by weight / stiffness, as its file says."""
    stand = load(path("bench8"))
    held = stand.law(Suspension)
    assert held is not None
    assert held.position[2] == pytest.approx(summarize(stand).mass * 9.81 / 1633.5, rel=1e-8)


FOLDER = stands.path("bench8").parent


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("bench8.motion.json", "is JSON, as motions and programmes are; expected a stand file (TOML)"),
        ("servos/bench8.toml", "is a file of servos, expected a stand file"),
    ],
)
def test_a_file_of_another_kind_is_named(name: str, words: str) -> None:
    with pytest.raises(StandError) as error:
        load(FOLDER / name)
    assert str(error.value) == f"{Path(name).name}: {words}"


def test_a_regime_is_named(tmp_path: Path) -> None:
    (tmp_path / "r.toml").write_text('schema = 1\n[default]\nspeed = "3000 rpm"\n')
    with pytest.raises(StandError, match=r"r.toml: is a regime, expected a stand file"):
        load(tmp_path / "r.toml")
