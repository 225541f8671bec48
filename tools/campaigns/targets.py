"""The generated C of a stand and its self-test on every target: the same bits."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Iterator, Sequence

from campaigns import REALS, Row, Rows, Table
from mahovik.core.stand import load
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.selftest import SWEEP, parse_targets, verify_targets
from mahovik.stands import path

OPTIONS = {"stand": "bench8", "states": SWEEP}
EQUAL = "equal"


def verdict(rows: Sequence[Check]) -> str:
    """Verdict of the rows that share a cell, with the reason of a failure."""
    return "; ".join(dict.fromkeys(EQUAL if r.verdict == "ok" else f"{r.verdict}: {r.words}" for r in rows))


def measure(options: Namespace) -> Iterator[tuple[str, ...]]:
    """A row for each target."""
    report = verify_targets(load(path(options.stand)), parse_targets("all"), options.states)
    for name in dict.fromkeys(row.judged.split()[0] for row in report.rows):
        rows = [row for row in report.rows if row.judged.split()[0] == name]
        verdicts = (verdict([row for row in rows if row.judged.endswith(real)]) for real in REALS)
        yield name, rows[0].quantity, rows[0].state, *verdicts


def is_equal(row: Row) -> bool:
    """Whether both element types have the bits of the host."""
    return all(row[real] == EQUAL for real in REALS)


def claim(rows: Rows) -> str:
    """How many targets give the same bits."""
    return (
        f"Every public function of `bench8` gives the same bits on {sum(map(is_equal, rows))} of {len(rows)} targets: "
        "processors and compilers, in `double` and `float`"
    )


TABLES = {
    "targets": Table(
        measure,
        {"target": "`{}`", "processor": "{}", "compiler": "{}", **dict.fromkeys(REALS, "{}")},
        claim,
        is_equal,
        "The generated C and its self-test; emulators run what is not this machine "
        "([targets](c-interface.md#what-changes-the-bits)).",
    )
}
