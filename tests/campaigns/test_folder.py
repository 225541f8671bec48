"""`mahovik campaign`: a folder of chunks, whatever happens to it and to the processes that compute it."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import mahovik
from campaigns.files import RUN, VARY, write
from cli.run import run
from mahovik.out.campaign.chunks import compute
from mahovik.out.campaign.file import load_campaign

psutil = pytest.importorskip("psutil")
parquet = pytest.importorskip("pyarrow.parquet")


def computed(folder: Path, *options: str, **head: Any) -> Any:
    """Run the command with a campaign of four chunks of ten samples."""
    return run("campaign", str(write(folder, VARY + RUN, chunk=10, **head)), "-o", str(folder / "out"), *options)


def content(folder: Path) -> dict[str, bytes]:
    """Files of the folder by name."""
    return {path.name: path.read_bytes() for path in sorted((folder / "out" / "rows").iterdir())}


def test_rows_are_the_same_to_the_bit_however_they_are_computed(tmp_path: Path) -> None:
    """One process, two workers, and runs that go on after missing, cut or altered chunks give the same rows."""
    assert computed(tmp_path, "--workers", "1").exit_code == 0
    whole = content(tmp_path)
    assert list(whole) == [f"chunk-{k:06d}.parquet" for k in range(4)]
    rows = tmp_path / "out" / "rows"
    (rows / "chunk-000000.parquet").unlink()
    (rows / "chunk-000001.parquet").write_bytes(whole["chunk-000001.parquet"][:-30])
    altered = bytearray(whole["chunk-000002.parquet"])
    altered[len(altered) // 3] ^= 4
    (rows / "chunk-000002.parquet").write_bytes(altered)
    (rows / "chunk-000003.parquet").write_bytes(whole["chunk-000000.parquet"])
    (rows / "chunk-000004.parquet").write_bytes(b"other names are never read")
    assert computed(tmp_path, "--workers", "2").exit_code == 0
    assert content(tmp_path) == whole | {"chunk-000004.parquet": b"other names are never read"}
    for path in rows.iterdir():
        path.unlink()
    for k in (3, 1, 0, 2):
        assert computed(tmp_path, "--chunk", str(k)).exit_code == 0
    assert content(tmp_path) == whole


def test_columns_are_samples_numbers_quantities_and_errors(tmp_path: Path) -> None:
    merged, page = tmp_path / "all.parquet", tmp_path / "page.html"
    done = computed(tmp_path, "--merge", str(merged), "--report", str(page), "--workers", "1", "--json", samples=100)
    assert done.exit_code == 0
    table, rows = parquet.read_table(merged), load_campaign(tmp_path / "C.toml").rows(0, 100)
    assert table.column_names == list(rows) and table["sample"].to_pylist() == list(range(100))
    for name, column in rows.items():
        assert np.array_equal(
            table[name].to_numpy(zero_copy_only=False), np.array(column, dtype=object if name == "error" else None)
        )
    answer = json.loads(done.output)
    assert answer["samples"] == 100 and answer["chunks"] == 10 and answer["without_quantities"] == 0
    shake = answer["quantities"]["shake"]
    assert shake["unit"] == "m/s" and shake["mean"] == pytest.approx(rows["shake"].mean())
    assert shake["50 %"] == np.sort(rows["shake"])[49]
    assert {row["number"] for row in answer["sensitivity"]} == set(rows) - {"sample", "shake", "error"}
    assert "<svg" in page.read_text() and "shake" in page.read_text() and "<script" not in page.read_text()


@pytest.mark.parametrize(
    ("head", "body", "words"),
    [
        ({"seed": 8}, VARY, "campaign file"),
        ({"samples": 41}, VARY, "campaign file"),
        ({"stand": "own.toml"}, VARY, "stand"),
        ({}, VARY.replace("[10, 1]", "[10, 2]"), "campaign file"),
    ],
)
def test_a_folder_of_another_campaign_is_refused(tmp_path: Path, head: dict[str, Any], body: str, words: str) -> None:
    mahovik.example("demo3").replace({"carrier.mass": 9.0}).save(tmp_path / "own.toml")
    assert computed(tmp_path, "--chunk", "0").exit_code == 0
    before = content(tmp_path)
    path = write(tmp_path, body + RUN, **{"chunk": 10} | head)
    done = run("campaign", str(path), "-o", str(tmp_path / "out"))
    assert done.exit_code == 2 and f"of another campaign, the {words} differs" in done.stderr
    assert content(tmp_path) == before


def test_names_comments_and_units_are_of_the_same_campaign_and_files_are_not(tmp_path: Path) -> None:
    (tmp_path / "spin.toml").write_text('schema = 1\n[default]\ntable = "speeds.csv"\n')
    (tmp_path / "speeds.csv").write_text("t,speed\n0,1\n")
    body = VARY + RUN.replace('{ default = { speed = "1000 rpm" } }', '"spin.toml"')
    first = load_campaign(write(tmp_path, body)).identity
    assert load_campaign(write(tmp_path, "# a comment\n" + body, name="x")).identity == first
    (tmp_path / "speeds.csv").write_text("t,speed\n0,2\n")
    assert load_campaign(write(tmp_path, body)).identity != first


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (("--chunk", "4"), "--chunk 4: expected 0 to 3"),
        (("--chunk", "0", "--workers", "2"), "--workers: not allowed with --chunk N"),
        (("--workers", "0"), "--workers 0: expected a whole number of at least 1"),
        (("--merge", "all.csv"), "--merge all.csv: expected a name that ends in .parquet"),
        (("--scheduler", "tcp://127.0.0.1:1"), "scheduler tcp://127.0.0.1:1: no scheduler answered"),
        (("--scheduler", "nowhere"), "--scheduler"),
    ],
)
def test_options_that_cannot_be_are_refused_in_one_line(tmp_path: Path, options: tuple[str, ...], words: str) -> None:
    done = computed(tmp_path, *options)
    assert done.exit_code == 2 and words in done.stderr and done.stderr.count("\n") == 1


def test_an_interrupt_says_what_is_there_and_the_same_command_goes_on(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(*arguments: Any) -> Iterator[tuple[int, str]]:
        yield from islice(compute(*arguments), 2)
        raise KeyboardInterrupt

    monkeypatch.setattr("mahovik.out.campaign.chunks.compute", interrupted)
    done = computed(tmp_path, "--workers", "1")
    words = f"2 of 4 chunks are in {tmp_path / 'out'}, and the same command goes on"
    assert (done.exit_code, done.stderr) == (130, f"error: interrupted; {words}\n")
    monkeypatch.undo()
    kept = content(tmp_path)
    assert computed(tmp_path, "--workers", "1").exit_code == 0
    assert len(kept) == 2 and kept.items() <= content(tmp_path).items()


@pytest.mark.slow
def test_killed_workers_and_a_killed_client_lose_no_sample(tmp_path: Path) -> None:
    """A worker that is killed is replaced; after the client is killed the same command goes on."""
    path = write(tmp_path, VARY + RUN.replace('"5 ms"', '"2 s"'), samples=400, chunk=10)
    rows, command = (
        tmp_path / "out" / "rows",
        [sys.executable, "-m", "mahovik", "campaign", str(path), "-o", str(tmp_path / "out")],
    )
    client = subprocess.Popen([*command, "--workers", "2"], start_new_session=True)
    wait(lambda: len(list(rows.glob("chunk-*.parquet"))) > 2)
    workers = [
        process
        for process in psutil.Process(client.pid).children(recursive=True)
        if "spawn_main" in " ".join(process.cmdline())
    ]
    workers[0].kill()
    before = len(list(rows.glob("chunk-*.parquet")))
    wait(lambda: len(list(rows.glob("chunk-*.parquet"))) > before + 4)
    os.killpg(client.pid, signal.SIGKILL)
    client.wait()
    assert len(list(rows.glob("chunk-*.parquet"))) < 40
    assert subprocess.run([*command, "--workers", "2"], check=False).returncode == 0
    chunks = {path.name: path.read_bytes() for path in rows.glob("chunk-*.parquet")}
    assert len(chunks) == 40
    for k in (0, 7, 39):
        (rows / f"chunk-{k:06d}.parquet").unlink()
    assert subprocess.run([*command, "--workers", "1"], check=False).returncode == 0
    assert chunks == {path.name: path.read_bytes() for path in rows.glob("chunk-*.parquet")}


def wait(condition: Any) -> None:
    end = time.monotonic() + 120
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.02)
