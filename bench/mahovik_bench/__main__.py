"""python -m mahovik_bench [bench|quick|full|page|gate]: see `make help`."""

from __future__ import annotations

import argparse
import json
import os
import sys

from mahovik.errors import MahovikError
from mahovik_bench.build import CACHE, ROOT
from mahovik_bench.gate import gate
from mahovik_bench.page import figures, plots
from mahovik_bench.roster import MODULES
from mahovik_bench.run import run
from mahovik_bench.tables import count_table, text, work_table
from mahovik_bench.works import WORKS

SIZES = (2, 6, 8, 12)
RESULTS = CACHE / "results.json"


def main() -> int:
    """Exit status 1 where results do not agree or a cost has risen."""
    parser = argparse.ArgumentParser(prog="mahovik_bench", description=__doc__)
    parser.add_argument("what", choices=["bench", "quick", "full", "page", "gate"])
    parser.add_argument("--accept", action="store_true", help="gate: accept the figures of today")
    parser.add_argument("--budget", type=float, default=330.0, help="seconds, after which no compiling is begun")
    parser.add_argument("--repetitions", type=int, default=200)
    parser.add_argument("--patient", action="store_true", help="full: CasADi for all N, compiled for an hour")
    given = parser.parse_args()
    if given.patient:
        os.environ["MAHOVIK_BENCH_PATIENT"] = "1"
    try:
        if given.what == "gate":
            return _gate(given.accept)
        if given.what == "quick":
            return _quick()
        if given.what != "page":
            sizes = (*SIZES, 32, 64) if given.what == "full" else SIZES
            budget = given.budget if given.what == "bench" else 10 * given.budget
            results = run(sizes, tuple(MODULES), given.repetitions, budget, say)
            RESULTS.write_text(json.dumps(results, indent=1), encoding="utf-8")
    except MahovikError as error:
        print(error, file=sys.stderr)
        return 1
    results = json.loads(RESULTS.read_text(encoding="utf-8"))
    sys.path.insert(0, str(ROOT / "tools"))
    from bench_campaign import CAMPAIGN

    CAMPAIGN.keep(figures(results), command=f"python -m mahovik_bench {given.what}")
    say(CAMPAIGN.block.page)
    for path, drawn in plots(results).items():
        (ROOT / path).write_text(drawn, encoding="utf-8")
        say(path)
    return 0


def say(text: str) -> None:
    """Progress."""
    print(text, flush=True)


def _quick() -> int:
    """Our own C and NumPy, to the terminal."""
    results = run((2, 8), ("mahovik",), 60, 1e9, say)
    for work in WORKS:
        print(f"\n{text(work_table(results, work))}\n{text(count_table(results, work))}", end="")
    for name, why in results["absent"].items():
        print(f"{name}: {why}")
    return 0


def _gate(accept: bool) -> int:
    rises = gate(accept)
    for line in rises:
        print(f"rise: {line}")
    if rises:
        print("`make bench-gate ACCEPT=--accept` accepts it", file=sys.stderr)
    return 1 if rises else 0


if __name__ == "__main__":
    sys.exit(main())
