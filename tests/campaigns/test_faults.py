"""Faults of real processes and disks: at the end every sample is there once, or a line says what is missing."""

from __future__ import annotations

import os
import resource
import signal
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from campaigns.processes import Processes, finish, processes, shard_files, until
from campaigns.stub import load_stub, write_stub
from mahovik.errors import UsageError
from mahovik.out.campaign.dataset import status
from mahovik.out.campaign.folder import begin, make_shard
from mahovik.out.campaign.manifest import read_manifest

pytestmark = pytest.mark.slow


@pytest.fixture
def run(tmp_path: Path) -> Iterator[Processes]:
    """Processes of the test."""
    with processes(tmp_path) as found:
        yield found


def bare(file: Path, out: Path) -> list[bytes]:
    """Contents of all shards, computed one after the other in this process, without workers."""
    begin(out, file, load_stub(file))
    for number in range(read_manifest(out).shards):
        make_shard(out, number, load_stub)
    return [path.read_bytes() for path in shard_files(out)]


def require_all(file: Path, out: Path) -> None:
    """Every sample is there once, with the bits that one process computes."""
    assert status(out).complete
    assert [path.read_bytes() for path in shard_files(out)] == bare(file, out.parent / "bare")


@pytest.mark.parametrize("workers", [1, 3])
def test_any_number_of_workers_gives_the_same_bits(workers: int, run: Processes, tmp_path: Path) -> None:
    file = write_stub(tmp_path / "c.json", samples=200, shard_size=9)
    client = run.client(file, tmp_path / "out", workers)
    said = finish(client)
    assert client.returncode == 0, said
    assert "200 of 200 samples in 23 of 23 shards" in said
    require_all(file, tmp_path / "out")


def test_the_scheduler_and_then_the_client_are_killed(run: Processes, tmp_path: Path) -> None:
    file, out = write_stub(tmp_path / "c.json", samples=400, shard_size=9, pause=0.1), tmp_path / "out"
    address, scheduler = run.scheduler()
    run.worker(address, "one")
    client = run.client(file, out, scheduler=address)
    until(lambda: len(shard_files(out)) > 3)
    scheduler.kill()
    begin = time.monotonic()
    said = finish(client)
    assert client.returncode == 1
    assert time.monotonic() - begin < 45.0
    assert "the scheduler is gone" in said and "shards are whole; `mahovik campaign resume" in said
    assert said.count("\n") == 1
    second = run.client(file, out, 2)
    before = len(shard_files(out))
    until(lambda: len(shard_files(out)) > before + 3)
    second.kill()
    second.wait()
    assert not status(out).complete
    until(lambda: not [pid for pid in workers_below(second.pid) if Path(f"/proc/{pid}").exists()])
    third = run.client(file, out, 2)
    assert "400 of 400 samples" in finish(third)
    require_all(file, out)


def workers_below(group: int) -> list[int]:
    """Processes of a group that has lost its leader."""
    found = []
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit():
            try:
                fields = (entry / "stat").read_text().rpartition(")")[2].split()
            except OSError:
                continue
            if int(fields[2]) == group and fields[0] != "Z":
                found.append(int(entry.name))
    return found


def test_ctrl_c_leaves_a_campaign_to_go_on_with(run: Processes, tmp_path: Path) -> None:
    """To the whole group, as a terminal does."""
    file, out = write_stub(tmp_path / "c.json", samples=400, shard_size=9, pause=0.1), tmp_path / "out"
    client = run.client(file, out, 2)
    until(lambda: len(shard_files(out)) > 3)
    begin = time.monotonic()
    os.killpg(client.pid, signal.SIGINT)
    assert finish(client) == "interrupted\n"
    assert client.returncode == 130
    assert time.monotonic() - begin < 15.0
    until(lambda: not workers_below(client.pid))
    found = status(out)
    assert not found.complete and not found.damaged
    assert "400 of 400 samples" in finish(run.client(file, out, 2))
    require_all(file, out)


def test_a_shard_that_always_kills_its_workers_is_given_up(run: Processes, tmp_path: Path) -> None:
    """It alone: those that its workers had beside it are computed."""
    (tmp_path / "always").touch()
    file = write_stub(tmp_path / "c.json", samples=90, shard_size=9, killer="always", once=False)
    client = run.client(file, tmp_path / "out", 2)
    said = finish(client)
    assert client.returncode == 1, said
    assert "missing shards: 0\nshard 0 (samples 0 to 8): given up, its workers were killed\n" in said
    assert "81 of 90 samples in 9 of 10 shards" in said
    (tmp_path / "always").unlink()
    assert finish(run.client(file, tmp_path / "out", 2)).startswith("stub: 90 of 90 samples")
    require_all(file, tmp_path / "out")


def test_a_limit_of_the_size_of_files_is_said(tmp_path: Path) -> None:
    file = write_stub(tmp_path / "c.json", samples=400, shard_size=200)
    begin(tmp_path / "out", file, load_stub(file))
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    handler = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    try:
        resource.setrlimit(resource.RLIMIT_FSIZE, (2000, before[1]))
        with pytest.raises(UsageError, match="cannot be written: File too large"):
            make_shard(tmp_path / "out", 0, load_stub)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
        signal.signal(signal.SIGXFSZ, handler)
    found = status(tmp_path / "out")
    assert found.missing == (0, 1) and not found.drafts
