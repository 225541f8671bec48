"""The C of the example stands, double and float, on arbitrary arguments.

Corpora stay in build/fuzz and grow with every run; each is minimised at its end. Executions of the same C by the same
harness add up, so an interrupted campaign goes on where it was. `--seconds` shares a time among the stands instead.
"""

from __future__ import annotations

import hashlib
import json
import math
import re
import shutil
import subprocess
import sys
import time
from argparse import Namespace
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

from checks import compile_harness, fuzz, minimise

from campaigns import CORES, REALS, ROOT, Rows, Table
from mahovik.core.stand import load
from mahovik.core.toolchain.checks import FLAGS, fuzz_project, sources
from mahovik.errors import CheckError
from mahovik.stands import path
from mahovik.writing import write_all

OPTIONS = {"runs": 10_500_000, "seconds": 0, "stands": "demo3,bench8,shaker2,auv6,remus6,sat4"}

PIECE = 250_000
"""Executions after which progress is recorded."""


def build_harness(stand: str, real: str) -> tuple[Path, Path, str]:
    """Folder, program, and the hash of its sources."""
    folder = ROOT / "build" / "fuzz" / f"{stand}-{real}"
    folder.mkdir(parents=True, exist_ok=True)
    texts = fuzz_project(load(path(stand)), real)
    write_all(folder, texts)
    made_of = "".join(texts[name] for name in sources(stand)) + " ".join(FLAGS)
    return folder, compile_harness(folder, sources(stand)), hashlib.sha256(made_of.encode()).hexdigest()


def fuzz_stand(stand: str, real: str, runs: int, seconds: int) -> tuple[int, float, tuple[float | None, ...]]:
    """Executions, seconds, and percent of lines and branches reached. Raises CheckError with a finding."""
    folder, program, digest = build_harness(stand, real)
    corpus, record = folder / "corpus", folder / "executed.json"
    if seconds:
        return fuzz(program, corpus, seconds=seconds).executions, seconds, (None, None)
    done = json.loads(record.read_text(encoding="utf-8")) if record.is_file() else {}
    if done.get("digest") != digest:
        done = {"digest": digest, "executions": 0, "seconds": 0.0}
    while done["executions"] < runs:
        start = time.perf_counter()
        run = fuzz(program, corpus, runs=min(PIECE, runs - done["executions"]), seed=1 + done["executions"])
        minimise(program, corpus)
        done["executions"] += run.executions
        done["seconds"] += time.perf_counter() - start
        record.write_text(json.dumps(done) + "\n", encoding="utf-8")
    return done["executions"], done["seconds"], covered_share(folder, stand, sorted(corpus.iterdir()))


def covered_share(folder: Path, stand: str, inputs: Sequence[Path]) -> tuple[float, ...]:
    """Percent of lines and of branch outcomes of the stand's C that a corpus reaches, by gcov."""
    scratch = folder / "coverage"
    shutil.rmtree(scratch, ignore_errors=True)
    scratch.mkdir()

    def output(*command: str) -> str:
        return subprocess.run(command, cwd=scratch, capture_output=True, text=True, check=True).stdout

    files = [str(folder / name) for name in sources(stand)]
    flags = ["-std=c99", "-O0", "--coverage", "-ffp-contract=off", f"-D{stand.upper()}_FUZZ_MAIN"]
    output("gcc", *flags, *files, "-o", "replay")
    for begin in range(0, len(inputs), 500):
        output("./replay", *map(str, inputs[begin : begin + 500]))
    _, _, text = output("gcov", "-b", "-n", f"replay-{stand}.gcda").partition(f"{stand}.c'")
    numbers = [re.search(rf"{what}:([\d.]+)%", text) for what in ("Lines executed", "Taken at least once")]
    return tuple(float(number[1]) if number else 0.0 for number in numbers)


def measure(options: Namespace) -> Iterator[tuple[Any, ...]]:
    """A row for each stand and element type; runs are shared by size, seconds evenly."""
    cases = [(stand, real) for stand in options.stands.split(",") for real in REALS]
    jobs = min(len(cases), CORES)
    shares = [1.0 / (1 + len(load(path(stand)).flywheels)) for stand, _ in cases]
    seconds = options.seconds and max(1, options.seconds * jobs // len(cases))
    with ThreadPoolExecutor(jobs) as pool:
        futures = [
            pool.submit(fuzz_stand, *case, math.ceil(options.runs * share / sum(shares)), seconds)
            for case, share in zip(cases, shares, strict=True)
        ]
        for case, future in zip(cases, futures, strict=True):
            try:
                executions, spent, covered = future.result()
                yield *case, executions, executions / spent, *covered, 0
            except CheckError as error:
                print(f"error: {error}", file=sys.stderr, flush=True)
                yield *case, None, None, None, None, 1


def claim(rows: Rows) -> str:
    """Executions and coverage."""
    return (
        f"{sum(row['executions'] for row in rows):,} executions of the C on arbitrary arguments, without a finding; "
        f"kept inputs reach at least {min(row['lines reached'] for row in rows):.1f} % of its lines"
    )


TABLES = {
    "fuzz": Table(
        measure,
        {
            "stand": "`{}`", "real": "{}", "executions": "{:,}", "a second": "{:,.0f}", "lines reached": "{:.2f} %",
            "branches reached": "{:.2f} %", "findings": "{}",
        },
        claim,
        lambda row: row["findings"] == 0,
        "libFuzzer with sanitizers; lines and branches of the stand's C that the kept inputs reach, by gcov "
        "([what is looked for](verification.md#fuzzing)).",
    )
}  # fmt: skip
