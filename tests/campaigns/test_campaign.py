"""Campaigns of a file: rows that depend on nothing but their number, impossible samples, what is refused before."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import mahovik
from campaigns.sections import RUN, VARY, write
from mahovik import stands
from mahovik.core.stand.numbers import StandNumbers
from mahovik.errors import UsageError
from mahovik.out.campaign.campaign import Campaign
from mahovik.out.campaign.file import files_in, load_campaign
from mahovik.out.campaign.rows import Rows

POISON = """
[vary]
"carrier.inertia.J11" = { normal = [0.2, 0.1] }
"w1.mass" = { relative = 0.01 }
"""


def load(folder: Path, body: str, **head: Any) -> Campaign:
    given: dict[str, Any] = {"stand": "demo3", "samples": 300, **head}
    return Campaign.load(write(folder, body, **given))


def same(one: Rows, other: Rows, part: slice) -> None:
    """Bits of some rows are those of a part of others."""
    assert np.array_equal(one.sample, other.sample[part])
    for mine, theirs in ((one.parameters, other.parameters), (one.quantities, other.quantities)):
        assert list(mine) == list(theirs)
        for name, column in mine.items():
            assert column.tobytes() == theirs[name][part].tobytes(), name
    assert list(one.reason) == list(other.reason[part])


@pytest.mark.parametrize("design", ["saltelli", "random"])
def test_rows_have_the_same_bits_however_they_are_parted(tmp_path: Path, design: str) -> None:
    campaign = load(tmp_path, VARY + RUN, design=design)
    whole = campaign.rows(0, 60)
    for first, last in ((40, 60), (0, 1), (1, 40)):
        same(Campaign.load(tmp_path / "C.toml").rows(first, last - first), whole, slice(first, last))
    assert list(campaign.parameters) == list(whole.parameters)
    assert (np.array(whole.quantities["shake"]) > 0).all()
    assert not any(whole.reason)


def test_a_row_is_of_the_stand_with_its_numbers(tmp_path: Path) -> None:
    campaign = load(tmp_path, VARY + RUN)
    rows = campaign.rows(7, 1)
    seventh = campaign.stand_of(7)
    numbers = StandNumbers(seventh, seventh.to_dict())
    for path, column in rows.parameters.items():
        if "unbalance" in path:
            (place,) = numbers.find(path)
            turns = (place.value - column[0]) / (2 * np.pi) if path.endswith("_at") else place.value / column[0] - 1
            assert turns == pytest.approx(round(turns), abs=1e-6)
        else:
            assert numbers.find(path)[0].value == column[0]
    nominal = load(tmp_path, '[vary]\n"w1.mass" = { tolerance = 0 }' + RUN)
    assert nominal.rows(0, 1).quantities["shake"] != rows.quantities["shake"]


def test_an_impossible_sample_is_a_row_with_its_reason(tmp_path: Path) -> None:
    campaign = load(tmp_path, POISON + RUN)
    rows = campaign.rows(0, 100)
    bad = np.array([bool(reason) for reason in rows.reason])
    assert 0 < bad.sum() < 100
    assert np.array_equal(np.isnan(rows.quantities["shake"]), bad)
    for j in np.flatnonzero(bad)[:3]:
        with pytest.raises(mahovik.StandError) as found:
            campaign.stand_of(int(j))
        assert rows.reason[j] in str(found.value)
    with pytest.raises(UsageError, match="the campaign has 300"):
        campaign.rows(299, 2)


def test_identity_is_that_of_what_decides_the_rows(tmp_path: Path) -> None:
    (tmp_path / "own.toml").write_text(stand_text())
    (tmp_path / "w.csv").write_text("mass [kg]\n1.0\n1.1\n")
    vary = '[vary]\n"w1.mass" = { table = "w.csv" }\n'
    first = load(tmp_path, vary + RUN, stand="own.toml").identity
    assert load(tmp_path, 'shard = 9\nname = "x"\nuntil = 0.1\n[quantile]\nof = "shake"\n' + vary + RUN,
                stand="own.toml").identity == first  # fmt: skip
    assert load(tmp_path, vary + RUN, stand="own.toml", seed=8).identity["campaign"] != first["campaign"]
    (tmp_path / "w.csv").write_text("mass [kg]\n1.0\n1.2\n")
    assert load(tmp_path, vary + RUN, stand="own.toml").identity["campaign"] != first["campaign"]
    (tmp_path / "own.toml").write_text(stand_text().replace('name = "demo3"', 'name = "demo3"  # the same'))
    assert load(tmp_path, vary + RUN, stand="own.toml").identity["stand"] == first["stand"]


def test_files_that_other_files_name_are_part_of_the_identity(tmp_path: Path) -> None:
    (tmp_path / "spin.toml").write_text('schema = 1\n[default]\ntable = "speeds.csv"\n')
    run = RUN.replace('{ default = { speed = "1000 rpm" } }', '"spin.toml"')
    (tmp_path / "speeds.csv").write_text("t,speed\n0,1\n")
    file = load_campaign(write(tmp_path, VARY + run, stand="demo3"))
    assert [path.name for path in files_in(file.document, file.folder)] == ["spin.toml", "speeds.csv"]


def stand_text() -> str:
    return stands.path("demo3").read_text()
