"""Shards: the same bits however often they are written, and every alteration of a file is found."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import duckdb
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pyarrow import parquet

from campaigns.stub import POISON, load_stub, write_stub
from mahovik.errors import CheckError, UsageError
from mahovik.out.campaign.dataset import merge, status
from mahovik.out.campaign.folder import begin, make_shard, whole_shard
from mahovik.out.campaign.manifest import read_manifest
from mahovik.out.campaign.shards import DamagedError, read_shard, shard_path


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A folder that has been begun, with 25 samples in 4 shards."""
    file = write_stub(tmp_path / "c.json", samples=25, shard_size=7)
    begin(tmp_path / "out", file, load_stub(file))
    return tmp_path / "out"


def make_all(folder: Path) -> None:
    for number in range(read_manifest(folder).shards):
        make_shard(folder, number, load_stub)


def test_every_sample_is_there_once(folder: Path) -> None:
    make_all(folder)
    query = f"select * from read_parquet('{folder}/rows/*/*.parquet') order by sample"
    rows = duckdb.connect().execute(query).fetchnumpy()
    work = load_stub(folder.parent / "c.json")
    expected = work.rows(0, 25)
    assert rows["sample"].tolist() == list(range(25))
    assert np.asarray(rows["carrier.mass"]).tobytes() == expected.parameters["carrier.mass"].tobytes()
    for name in work.quantities:
        column = np.ma.filled(rows[name], np.nan)
        assert np.array_equal(column, expected.quantities[name], equal_nan=True)
    assert list(rows["error"]) == list(expected.reason)
    assert any(POISON in each for each in expected.reason)  # recorded as rows
    found = status(folder)
    assert found.complete and found.rows == 25
    assert found.failed == sum(map(bool, expected.reason))


def test_every_flipped_bit_is_found(folder: Path) -> None:
    make_shard(folder, 3, load_stub)
    path = shard_path(folder, 3)
    content = path.read_bytes()

    @settings(max_examples=300)
    @given(place=st.integers(0, len(content) - 1), bit=st.integers(0, 7))
    def flip(place: int, bit: int) -> None:
        altered = bytearray(content)
        altered[place] ^= 1 << bit
        path.write_bytes(altered)
        with pytest.raises(DamagedError):
            read_shard(folder, read_manifest(folder), 3)

    flip()


@pytest.mark.parametrize("part", [0.0, 0.99])
def test_a_truncated_shard_is_found_and_computed_again(part: float, folder: Path) -> None:
    make_all(folder)
    path = shard_path(folder, 1)
    content = path.read_bytes()
    path.write_bytes(content[: int(part * len(content))])
    found = status(folder)
    assert list(found.damaged) == [1] and str(path) in found.damaged[1]
    assert whole_shard(folder, read_manifest(folder), 1) is None
    with pytest.raises(CheckError, match="1 of 4 shards are missing or damaged: 1;"):
        merge(folder, folder / "all.parquet")
    assert not (folder / "all.parquet").exists()
    make_shard(folder, 1, load_stub)
    assert path.read_bytes() == content


def test_a_shard_of_another_campaign_is_found(folder: Path, tmp_path: Path) -> None:
    make_all(folder)
    other = write_stub(tmp_path / "d.json", samples=25, shard_size=7, seed=2)
    begin(tmp_path / "other", other, load_stub(other))
    make_shard(tmp_path / "other", 1, load_stub)
    shutil.copyfile(shard_path(tmp_path / "other", 1), shard_path(folder, 1))
    assert "of another campaign" in status(folder).damaged[1]


def test_merge_writes_all_rows_in_their_order(folder: Path) -> None:
    make_all(folder)
    assert merge(folder, folder / "all.parquet") == 25
    table = parquet.read_table(folder / "all.parquet")
    assert table.column("sample").to_pylist() == list(range(25))
    assert json.loads(table.schema.metadata[b"mahovik units"]) == {"carrier.mass": "kg", "root": "1", "double": "kg"}


def test_what_is_missing_is_said(folder: Path) -> None:
    make_shard(folder, 2, load_stub)
    found = status(folder)
    assert not found.complete
    assert found.missing == (0, 1, 3)
    assert "missing shards: 0-1, 3" in list(found.lines())
    with pytest.raises(CheckError, match="3 of 4 shards are missing or damaged: 0-1, 3; `mahovik campaign resume"):
        merge(folder, folder / "all.parquet")


def test_a_number_of_no_shard_is_refused(folder: Path) -> None:
    for number in (-1, 4):
        with pytest.raises(UsageError, match=f"shard {number}: not there, expected 0 to 3"):
            make_shard(folder, number, load_stub)
