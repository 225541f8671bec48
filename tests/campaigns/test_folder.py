"""Folder of a campaign: the same bits however often they are written, damage is found, other campaigns are refused."""

from __future__ import annotations

import json
import os
import shutil
from pathlib import Path

import duckdb
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pyarrow import parquet

import mahovik
from campaigns.stub import POISON, load_stub, write_stub
from mahovik.errors import CheckError, UsageError
from mahovik.out.campaign.cluster import connect
from mahovik.out.campaign.dataset import remove_drafts, status
from mahovik.out.campaign.face import Campaign, CampaignFolder
from mahovik.out.campaign.folder import _open
from mahovik.out.campaign.manifest import read_manifest
from mahovik.out.campaign.shards import DamagedError, read_shard, shard_path


@pytest.fixture(autouse=True)
def forget_opened() -> None:
    """Make the next one read the campaign file, like a new process."""
    _open.cache_clear()


def prepare(tmp_path: Path, **values: object) -> CampaignFolder:
    """A folder that was begun, with 40 samples in 5 shards; the stand file is beside the campaign file."""
    mahovik.example("shaker2").save(tmp_path / "stand.toml")
    file = write_stub(tmp_path / "c.json", **{"samples": 40, "shard_size": 8, "stand_file": "stand.toml"} | values)
    return Campaign(file, load=load_stub).prepare(tmp_path / "out")


def make_all(campaign: CampaignFolder) -> list[bytes]:
    """Contents of all shards, made in the other order."""
    for number in reversed(range(5)):
        record = campaign.shard(number)
        assert record.number == number and record.count == 8
    return [shard_path(campaign.path, number).read_bytes() for number in range(5)]


def test_every_sample_is_there_once_with_the_same_bits_whenever_it_is_written(tmp_path: Path) -> None:
    campaign = prepare(tmp_path)
    before = make_all(campaign)
    query = f"select * from read_parquet('{campaign.path}/rows/*/*.parquet') order by sample"
    rows, expected = duckdb.connect().execute(query).fetchnumpy(), load_stub(tmp_path / "c.json").rows(0, 40)
    assert rows["sample"].tolist() == campaign.columns()["sample"].tolist() == list(range(40))
    assert np.asarray(rows["carrier.mass"]).tobytes() == expected.parameters["carrier.mass"].tobytes()
    for name, column in expected.quantities.items():
        assert np.array_equal(np.ma.filled(rows[name], np.nan), column, equal_nan=True)
    assert list(rows["error"]) == list(expected.reason)
    assert any(POISON in each for each in expected.reason)  # recorded as rows
    state = campaign.status()
    assert state.complete and state.rows == 40 and state.failed == sum(map(bool, expected.reason))
    assert campaign.merge(tmp_path / "all.parquet") == 40
    table = parquet.read_table(tmp_path / "all.parquet")
    assert table.column("sample").to_pylist() == list(range(40))
    assert json.loads(table.schema.metadata[b"mahovik units"]) == {"carrier.mass": "kg", "root": "1", "double": "kg"}
    written = shard_path(campaign.path, 2).stat().st_mtime_ns
    campaign.shard(2)  # whole: not computed again
    assert shard_path(campaign.path, 2).stat().st_mtime_ns == written
    shutil.rmtree(campaign.path / "rows")
    assert make_all(campaign) == before and len(set(before)) == 5


def test_every_flipped_bit_is_found(tmp_path: Path) -> None:
    campaign = prepare(tmp_path)
    campaign.shard(3)
    path = shard_path(campaign.path, 3)
    content = path.read_bytes()

    @settings(max_examples=200)
    @given(place=st.integers(0, len(content) - 1), bit=st.integers(0, 7))
    def flip(place: int, bit: int) -> None:
        altered = bytearray(content)
        altered[place] ^= 1 << bit
        path.write_bytes(altered)
        with pytest.raises(DamagedError):
            read_shard(campaign.path, read_manifest(campaign.path), 3)

    flip()


def test_shards_that_are_damaged_missing_or_of_others_are_told_and_made_again(tmp_path: Path) -> None:
    campaign = prepare(tmp_path)
    before = make_all(campaign)
    paths = [shard_path(campaign.path, number) for number in range(5)]
    paths[1].write_bytes(before[1][:-9])
    paths[2].write_bytes(before[0])
    (tmp_path / "other").mkdir()
    prepare(tmp_path / "other", seed=2).shard(3)
    shutil.copyfile(shard_path(tmp_path / "other" / "out", 3), paths[3])
    draft = paths[4].with_name(".000000004.parquet.0123456789abcdef")
    paths[4].rename(draft)
    state = campaign.status()
    assert state.missing == (4,) and state.drafts == 1 and list(state.damaged) == [1, 2, 3]
    assert str(paths[1]) in state.damaged[1] and "other samples than 16 to 23" in state.damaged[2]
    assert "of another campaign" in state.damaged[3] and "missing shards: 4" in list(state.lines())
    with pytest.raises(CheckError, match="4 of 5 shards are missing or damaged: 1-4; `mahovik campaign resume"):
        campaign.merge(tmp_path / "all.parquet")
    assert not (tmp_path / "all.parquet").exists()
    remove_drafts(campaign.path)
    assert draft.exists()  # some process may write it just now
    os.utime(draft, (0.0, 0.0))
    remove_drafts(campaign.path)
    assert not draft.exists()
    assert make_all(campaign) == before
    for number in (-1, 5):
        with pytest.raises(UsageError, match=f"shard {number}: not there, expected 0 to 4"):
            campaign.shard(number)


def test_another_campaign_is_refused(tmp_path: Path) -> None:
    prepare(tmp_path).shard(0)
    for values in ({"seed": 2}, {"samples": 50}):
        file = write_stub(tmp_path / "c.json", **{"samples": 40, "shard_size": 8, "stand_file": "stand.toml"} | values)
        words = 'out: holds rows of another campaign, "stub": the text of its file differs; undo'
        with pytest.raises(UsageError, match=words):
            Campaign(file, load=load_stub).prepare(tmp_path / "out")
        _open.cache_clear()
        with pytest.raises(UsageError, match="holds rows of another campaign"):
            CampaignFolder(tmp_path / "out", load=load_stub).shard(1)


def test_a_changed_stand_is_refused_with_its_changes(tmp_path: Path) -> None:
    prepare(tmp_path).shard(0)
    stand = mahovik.load(tmp_path / "stand.toml")
    name = stand.flywheels[0].name
    stand.replace({"carrier.mass": 31.5, f"{name}.unbalance.static": "3 g mm"}).save(tmp_path / "stand.toml")
    _open.cache_clear()
    with pytest.raises(UsageError) as refused:
        CampaignFolder(tmp_path / "out", load=load_stub).shard(1)
    said = str(refused.value)
    assert "out: the stand file has changed since the campaign was begun: carrier.mass was" in said
    assert "is 31.5" in said and name in said and "\n" not in said
    assert "undo that, or begin again in another folder" in said
    assert status(tmp_path / "out").rows == 8


def test_a_campaign_of_another_version_is_refused(tmp_path: Path) -> None:
    campaign = prepare(tmp_path)
    manifest = json.loads((campaign.path / "manifest.json").read_text())
    manifest["identity"]["version"] = "0.0.9"
    (campaign.path / "manifest.json").write_text(json.dumps(manifest))
    words = "out: mahovik 0.1.0 is installed here, but the campaign was begun with 0.0.9; install that version"
    with pytest.raises(UsageError, match=words):
        campaign.shard(0)


def test_other_folders_are_refused(tmp_path: Path) -> None:
    file = write_stub(tmp_path / "c.json", samples=40, shard_size=8)
    (tmp_path / "full").mkdir()
    (tmp_path / "full" / "thesis.txt").touch()
    with pytest.raises(UsageError, match="full: holds other files; give an empty or a new folder"):
        Campaign(file, load=load_stub).prepare(tmp_path / "full")
    with pytest.raises(UsageError, match="none: no campaign was begun here; `mahovik campaign run"):
        CampaignFolder(tmp_path / "none")


@pytest.mark.parametrize(
    ("key", "value", "words"),
    [
        ("end", '"515"', 'end: expected a valid integer, found "515"'),
        ("end", "41", "end: expected at most `samples`, 40, found 41"),
        ("samples", str(10**12), "samples: expected less than or equal to 10000000000, found 1000000000000"),
        ("shard_size", "0", "shard_size: expected greater than or equal to 1, found 0"),
        ("file", r'"\u0000"', "file: expected a path, found a NUL"),
        ("quantities", '{"root": 1}', "quantities.root: expected a valid string, found 1"),
        ("stand", "[" * 10_000 + "]" * 10_000, ""),
    ],
)
def test_a_damaged_manifest_is_one_line(key: str, value: str, words: str, tmp_path: Path) -> None:
    path = prepare(tmp_path).path / "manifest.json"
    text = json.dumps({**json.loads(path.read_text()), key: "HERE"})
    path.write_text(text.replace('"HERE"', value))
    said = f"{path}: no manifest of a campaign{': ' if words else ''}{words}; begin again in another folder"
    with pytest.raises(UsageError) as refused:
        CampaignFolder(tmp_path / "out")
    assert str(refused.value) == said


@pytest.mark.slow
def test_where_enough_samples_end_does_not_depend_on_the_workers(tmp_path: Path) -> None:
    """Shards come back in any order, and are looked at in that of the samples."""
    ends = []
    for workers in (1, 2):
        (tmp_path / str(workers)).mkdir()
        outcome = prepare(tmp_path / str(workers), samples=20000, shard_size=100, within=0.04).resume(workers=workers)
        ends.append(outcome.status.manifest.end)
        assert outcome.status.complete and outcome.status.rows == ends[-1]
    assert ends[0] == ends[1] < 20000


@pytest.mark.parametrize("address", ["nonsense", "http://127.0.0.1:9"])
def test_a_scheduler_that_cannot_be_reached(address: str) -> None:
    with pytest.raises(UsageError) as refused, connect(None, address):
        pass
    assert str(refused.value).startswith(f"scheduler {address}: cannot be reached, ")
    with pytest.raises(UsageError, match="--workers: a scheduler has its own workers"), connect(2, address):
        pass
