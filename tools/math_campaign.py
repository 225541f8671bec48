"""Accuracy of sincos, sqrt, atan2, exp and wrap, compiled, against Arb: tables of docs/results/arithmetic.md.

python tools/math_campaign.py [--samples 100000] [--quick | --proven]
"""

from __future__ import annotations

from collections.abc import Iterator
from random import Random
from typing import Any

import campaign
import math_proof
import numpy as np
from flint import arb
from kept import Campaign, Figures, Measured
from math_judge import LAST_NEAR, Row, every_float, every_power, every_root, largest_error, rows, run

from mahovik.core.program.types import DOUBLE, FLOAT
from mahovik.core.routines.exponential import LOWEST

MEASURED_HEAD = ("routine", "real", "arguments", "count", "worst error", "where", "must be at most")
PROVEN_HEAD = ("what", "real", "proven bound", "must be at most")


def _cells(row: Any) -> str:
    return campaign.row(*row.cells())


def measure_page(found: Figures) -> str:
    """The table of what Arb and every float say."""
    return campaign.table(MEASURED_HEAD, [Row(**row).cells() for row in found["rows"]], None)


def proven_page(found: Figures) -> str:
    """The table of what is proven."""
    return campaign.table(PROVEN_HEAD, [math_proof.Row(**row).cells() for row in found["rows"]], None)


ROUTINES: dict[str, tuple[str, int, Any]] = {
    "sin": ("sincos", 0, arb.sin), "cos": ("sincos", 1, arb.cos), "sqrt": ("sqrt", 0, arb.sqrt),
    "atan2": ("atan2", 0, arb.atan2), "exp": ("exp", 0, arb.exp),
}  # fmt: skip
"""Name in C, number of the result, judge."""


def measure_sample(found: Figures, rng: Random) -> Iterator[Measured]:
    """The error where it was worst, and what it must not exceed."""
    for row in found["rows"]:
        if row["routine"] not in ROUTINES or row["samples"].startswith("every"):
            continue
        precision = {"double": DOUBLE, "float": FLOAT}[row["precision"]]
        arguments = [np.array([float(word.split(" = ")[1])], dtype=precision.scalar) for word in row["at"].split(", ")]
        name, number, exact = ROUTINES[row["routine"]]
        got = run(precision, name, *arguments, results=1 + (name == "sincos"))[number]
        worst, _ = largest_error(precision, arguments, got, exact, absolute=row["unit"] == "")
        yield Measured(f"{row['routine']}, {row['precision']}, {row['at']}", row["worst"], worst, 1.01)
    for row in rng.sample([*rows(200)], 3):
        (kept,) = (
            each
            for each in found["rows"]
            if (each["routine"], each["precision"], each["samples"]) == (row.routine, row.precision, row.samples)
        )
        yield Measured(f"bound of {row.routine}, {row.precision}, {row.samples}", kept["bound"], row.bound)
        yield Measured(f"{row.routine}, {row.precision}, at most", kept["worst"], max(kept["worst"], row.worst))


def proven_sample(found: Figures, rng: Random) -> Iterator[Measured]:
    """The proofs of float, which are quick."""
    wanted = {row["what"]: row for row in found["rows"] if row["precision"] == "float"}
    for row in math_proof.rows((FLOAT,)):
        kept = wanted.pop(row.what)
        yield Measured(f"{row.what}, bound", kept["bound"], row.bound, 1.01)
        yield Measured(f"{row.what}, most", kept["most"], row.most, 1.001)
    yield Measured("rows without a proof", [], list(wanted))


def _campaign(name: str, what: str, page: Any, sample: Any) -> Campaign:
    block = campaign.Block("docs/results/arithmetic.md", f"{what}: tools/math_campaign.py")
    return Campaign(name, block, page, ("math_campaign.py", "math_judge.py", "math_proof.py"), sample)


MEASURED = _campaign("arithmetic-measured", "measured", measure_page, measure_sample)
PROVEN = _campaign("arithmetic-proven", "proven", proven_page, proven_sample)


def main() -> None:
    """Run all, write the page. Exit status 1 where a bound is exceeded."""
    parser = campaign.parser(__doc__, samples=100_000)
    parser.add_argument("--quick", action="store_true", help="fewer floats, page not written")
    parser.add_argument("--proven", action="store_true", help="only what is proven")
    options = parser.parse_args()
    proofs = list(math_proof.rows())
    if options.proven:
        PROVEN.keep({"rows": [vars(row) for row in proofs]})
        raise SystemExit(0 if all(row.good for row in proofs) else 1)
    found = list(rows(options.samples))
    if options.quick:
        found += [*every_float(0.5, LAST_NEAR), every_root(1.0, 4.0), every_power(-0.5, -2.0)]
    else:
        found += [*every_float(0.0, LAST_NEAR), *every_float(LAST_NEAR, FLOAT.max_phase)]
        found += [every_root(0.0, FLOAT.largest), every_power(0.0, LOWEST["float"])]
    print(*map(_cells, [*found, *proofs]), sep="\n")
    if not options.quick:
        MEASURED.keep({"rows": [vars(row) for row in found]})
        PROVEN.keep({"rows": [vars(row) for row in proofs]})
    raise SystemExit(0 if all(row.good for row in found) and all(row.good for row in proofs) else 1)


if __name__ == "__main__":
    main()
