"""Fuzzes the C of the example stands, double and float: writes the table of docs/results/fuzzing.md.

python tools/fuzz_campaign.py [--runs 10500000] [--quick] [STAND ...]

Corpora stay in build/fuzz and grow with every campaign; each is minimised at its end. Executions of the same C by the
same harness add up, so an interrupted campaign goes on where it was. `--quick` shares `--seconds` (60) among the stands
and writes no page. Exit status 1 where anything was found.
"""

from __future__ import annotations

import hashlib
import json
import math
import os
import re
import shutil
import subprocess
import sys
import time
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import campaign
from kept import Campaign, Columns, Figures

from mahovik.core.stand import load
from mahovik.core.toolchain.board import version
from mahovik.core.toolchain.fuzz_project import fuzz_project, sources
from mahovik.core.toolchain.fuzzing import FLAGS, FuzzRun, compile_harness, fuzz, minimise
from mahovik.errors import CheckError
from mahovik.stands import path

STANDS = ("demo3", "bench8", "shaker2", "auv6", "remus6", "sat4")
"""Together they have every kind of wrench: legs, suspension, added mass, buoyancy, damping, run-time wrenches."""

REALS = ("double", "float")

PIECE = 250_000
"""Executions after which what was done is recorded."""


@dataclass(frozen=True)
class FuzzResult:
    """A harness after its runs."""

    stand: str
    real: str
    executions: int
    seconds: float
    lines: float  # percent of the lines of the C that the corpus reaches
    branches: float
    inputs: int
    size: int


def fuzz_stand(stand: str, real: str, runs: int) -> FuzzResult:
    """One stand at one precision, until it has had this many executions. Raises CheckError with what was found."""
    folder, program, digest = _build(stand, real)
    corpus, record = folder / "corpus", folder / "executed.json"
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
    files = sorted(corpus.iterdir())
    size = sum(f.stat().st_size for f in files)
    return FuzzResult(
        stand, real, done["executions"], done["seconds"], *covered_share(folder, stand, files), len(files), size
    )


def quick(stand: str, real: str, seconds: int) -> FuzzRun:
    """One stand at one precision for some seconds. Raises CheckError."""
    folder, program, _ = _build(stand, real)
    return fuzz(program, folder / "corpus", seconds=seconds)


def _build(stand: str, real: str) -> tuple[Path, Path, str]:
    """Folder, harness, and the hash of what it was made of."""
    folder = campaign.ROOT / "build" / "fuzz" / f"{stand}-{real}"
    folder.mkdir(parents=True, exist_ok=True)
    texts = fuzz_project(load(path(stand)), real)
    for name, text in texts.items():
        (folder / name).write_text(text, encoding="utf-8")
    made_of = "".join(texts[name] for name in sources(stand)) + " ".join(FLAGS)
    return folder, compile_harness(folder, sources(stand)), hashlib.sha256(made_of.encode()).hexdigest()


def covered_share(folder: Path, stand: str, inputs: Sequence[Path]) -> tuple[float, float]:
    """Percent of lines and of branch outcomes of the stand's C that a corpus reaches, by gcov."""
    scratch = folder / "coverage"
    shutil.rmtree(scratch, ignore_errors=True)
    scratch.mkdir()
    files = [str(folder / name) for name in sources(stand)]
    flags = ["-std=c99", "-O0", "--coverage", "-ffp-contract=off", f"-D{stand.upper()}_FUZZ_MAIN"]
    _must(["gcc", *flags, *files, "-o", "replay"], scratch)
    for begin in range(0, len(inputs), 500):
        _must(["./replay", *map(str, inputs[begin : begin + 500])], scratch)
    text = _must(["gcov", "-b", "-n", f"replay-{stand}.gcda"], scratch)
    own = text[text.index(f"{stand}.c'") :]
    numbers = [re.search(rf"{what}:([\d.]+)%", own) for what in ("Lines executed", "Taken at least once")]
    return tuple(float(n[1]) if n else 0.0 for n in numbers)  # type: ignore[return-value]


def _must(command: Sequence[str], folder: Path) -> str:
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise CheckError(f"{command[0]}: {done.stderr.strip()[-400:]}")
    return done.stdout


TABLE = Columns(
    {
        "stand": "{}", "reals": "{}", "executions": "{:,}", "of them a second": "{:,.0f}", "lines reached": "{:.2f} %",
        "branches reached": "{:.2f} %", "inputs kept": "{}", "kB": "{:.0f}",
    },
    2,
)  # fmt: skip


def figures(results: Sequence[FuzzResult]) -> Figures:
    """The figures to keep."""
    lines = [
        (r.stand, r.real, r.executions, r.executions / r.seconds, r.lines, r.branches, r.inputs, r.size / 1000)
        for r in results
    ]
    return {"compiler": version("clang"), "seconds": sum(r.seconds for r in results), "rows": TABLE.rows(lines)}


def page(found: Figures) -> str:
    """The table and its sum."""
    total = sum(row["executions"] for row in found["rows"])
    return (
        f"{total:,} executions, {found['seconds'] / 60:.0f} minutes of a core that others used as well, by "
        f"{found['compiler']}; no finding is open. Lines and branches of the stand's C that the kept inputs reach are "
        f"counted by gcov.\n\n{TABLE.text(found['rows'])}"
    )


CAMPAIGN = Campaign(
    "fuzzing",
    campaign.Block("docs/results/fuzzing.md", "figures: tools/fuzz_campaign.py"),
    page,
)


def main() -> None:
    """Run all, print a line each, write the page."""
    parser = campaign.parser(__doc__, quick=False)
    parser.add_argument("stands", nargs="*", default=STANDS, metavar="STAND")
    parser.add_argument("--runs", type=int, default=10_500_000, help="executions of all together")
    parser.add_argument("--seconds", type=int, default=60, help="of all together, with --quick")
    given = parser.parse_args()
    cases = [(stand, real) for stand in given.stands for real in REALS]
    jobs = min(len(cases), os.cpu_count() or 1)
    shares = [1.0 / (1 + len(load(path(stand)).flywheels)) for stand, _ in cases]
    results, failed = [], False
    with ThreadPoolExecutor(jobs) as pool:
        if given.quick:
            seconds = max(1, given.seconds * jobs // len(cases))
            futures = [pool.submit(quick, *case, seconds) for case in cases]
        else:
            runs = [math.ceil(given.runs * share / sum(shares)) for share in shares]
            futures = [pool.submit(fuzz_stand, *case, count) for case, count in zip(cases, runs, strict=True)]
        for case, future in zip(cases, futures, strict=True):
            try:
                results.append(found := future.result())
                print(f"{' '.join(case)}: {found.executions} executions", flush=True)
            except CheckError as error:
                failed = True
                print(f"error: {error}", file=sys.stderr, flush=True)
    if not failed and not given.quick and set(given.stands) == set(STANDS):
        CAMPAIGN.keep(figures(results))
    raise SystemExit(1 if failed else 0)


if __name__ == "__main__":
    main()
