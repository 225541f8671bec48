"""Folder of a campaign: rows of one campaign alone, from the first process to the last."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

import mahovik
from campaigns.stub import load_stub, write_stub
from mahovik.errors import UsageError
from mahovik.out.campaign.cluster import connect
from mahovik.out.campaign.dataset import status
from mahovik.out.campaign.face import Campaign, CampaignFolder
from mahovik.out.campaign.folder import _open
from mahovik.out.campaign.manifest import read_manifest


@pytest.fixture(autouse=True)
def forget_opened() -> None:
    """Make the next one read the campaign file, like a new process."""
    _open.cache_clear()


def prepare(tmp_path: Path, **values: object) -> CampaignFolder:
    """A folder that was begun; the stand file is beside the campaign file."""
    mahovik.example("shaker2").save(tmp_path / "stand.toml")
    file = write_stub(tmp_path / "c.json", **{"samples": 40, "shard_size": 8, "stand_file": "stand.toml"} | values)
    return Campaign(file, load=load_stub).prepare(tmp_path / "out")


def test_every_shard_alone(tmp_path: Path) -> None:
    found = prepare(tmp_path)
    for number in reversed(range(5)):
        record = found.shard(number)
        assert record.number == number and record.count == 8
    assert found.status().complete
    columns = found.columns()
    assert columns["sample"].tolist() == list(range(40))
    with np.errstate(invalid="ignore"):
        assert np.array_equal(columns["root"], np.sqrt(columns["carrier.mass"]), equal_nan=True)


def test_another_campaign_is_refused(tmp_path: Path) -> None:
    prepare(tmp_path).shard(0)
    for values in ({"seed": 2}, {"samples": 50}):
        file = write_stub(tmp_path / "c.json", **{"samples": 40, "shard_size": 8, "stand_file": "stand.toml"} | values)
        with pytest.raises(
            UsageError, match='out: holds rows of another campaign, "stub": the text of its file differs; undo'
        ):
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
    with pytest.raises(UsageError, match="the stand file has changed"):
        Campaign(tmp_path / "c.json", load=load_stub).run(tmp_path / "out", workers=1)
    assert status(tmp_path / "out").rows == 8


def test_a_campaign_of_another_version_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    found = prepare(tmp_path)
    manifest = json.loads((tmp_path / "out" / "manifest.json").read_text())
    manifest["identity"]["version"] = "0.0.9"
    (tmp_path / "out" / "manifest.json").write_text(json.dumps(manifest))
    words = "out: mahovik 0.1.0 is installed here, but the campaign was begun with 0.0.9; install that version"
    for action in (lambda: found.shard(0), lambda: Campaign(tmp_path / "c.json", load=load_stub).run(tmp_path / "out")):
        with pytest.raises(UsageError, match=words):
            action()


def test_other_folders_are_refused(tmp_path: Path) -> None:
    file = write_stub(tmp_path / "c.json", samples=40, shard_size=8)
    (tmp_path / "full").mkdir()
    (tmp_path / "full" / "thesis.txt").touch()
    with pytest.raises(UsageError, match="full: holds other files; give an empty or a new folder"):
        Campaign(file, load=load_stub).prepare(tmp_path / "full")
    with pytest.raises(UsageError, match="none: no campaign was begun here; `mahovik campaign run"):
        CampaignFolder(tmp_path / "none")
    for text in ("", "[]", '{"format": 1}', '{"format": 1, "nmae": 2}'):
        (tmp_path / "none").mkdir(exist_ok=True)
        (tmp_path / "none" / "manifest.json").write_text(text)
        with pytest.raises(UsageError, match=r"none/manifest.json: no manifest of a campaign"):
            CampaignFolder(tmp_path / "none")


@pytest.mark.parametrize(
    ("key", "value", "words"),
    [
        ("end", '"515"', 'end: expected a valid integer, found "515"'),
        ("end", "41", "end: expected at most `samples`, 40, found 41"),
        ("samples", str(10**12), "samples: expected less than or equal to 10000000000, found 1000000000000"),
        ("shard_size", "0", "shard_size: expected greater than or equal to 1, found 0"),
        ("file", "7", "file: expected a valid string, found 7"),
        ("file", r'"\u0000"', "file: expected a path, found a NUL"),
        ("quantities", '{"root": 1}', "quantities.root: expected a valid string, found 1"),
        ("stand", "[" * 10_000 + "]" * 10_000, ""),
    ],
)
def test_a_damaged_manifest_is_one_line(key: str, value: str, words: str, tmp_path: Path) -> None:
    prepare(tmp_path)
    path = tmp_path / "out" / "manifest.json"
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
        found = prepare(tmp_path / str(workers), samples=20000, shard_size=100, within=0.04)
        outcome = found.resume(workers=workers)
        ends.append(outcome.status.manifest.end)
        assert outcome.status.complete and outcome.status.rows == ends[-1]
    assert ends[0] == ends[1] < 20000
    assert read_manifest(tmp_path / "1" / "out").shards == len(list((tmp_path / "1" / "out").glob("rows/*/*.parquet")))
    # a finer accuracy goes on from there
    finer = write_stub(tmp_path / "2" / "c.json", samples=20000, shard_size=100, within=0.02, stand_file="stand.toml")
    again = Campaign(finer, load=load_stub).run(tmp_path / "2" / "out", workers=2)
    assert ends[0] < again.status.manifest.end < 20000


@pytest.mark.parametrize(
    "address", [pytest.param("tcp://127.0.0.1:9", marks=pytest.mark.slow), "nonsense", "http://127.0.0.1:9"]
)
def test_a_scheduler_that_cannot_be_reached(address: str) -> None:
    with pytest.raises(UsageError) as refused, connect(None, address):
        pass
    assert str(refused.value).startswith(f"scheduler {address}: cannot be reached, ")
    assert "\n" not in str(refused.value)
    with pytest.raises(UsageError, match="--workers: a scheduler has its own workers"), connect(2, address):
        pass
