"""Accuracy of sincos, sqrt, atan2, exp and wrap, compiled, against Arb: tables of docs/results/arithmetic.md.

python tools/math_campaign.py [--samples 100000] [--quick | --proven]
"""

from __future__ import annotations

from typing import Any

import campaign
import math_proof
from kept import Campaign, Figures
from math_judge import LAST_NEAR, Row, every_float, every_power, every_root, rows

from mahovik.core.program.types import FLOAT
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


def _campaign(name: str, what: str, page: Any) -> Campaign:
    block = campaign.Block("docs/results/arithmetic.md", f"{what}: tools/math_campaign.py")
    return Campaign(name, block, page)


MEASURED = _campaign("arithmetic-measured", "measured", measure_page)
PROVEN = _campaign("arithmetic-proven", "proven", proven_page)


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
