"""The C, the reference and the second derivation on random stands, in double and float; the C's error by enclosures."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Iterator
from typing import Any

from random_stands import random_stands, verify_random

from campaigns import CORES, REALS, Rows, Table, at_most, side_by_side
from mahovik.contract.limits import LIMITS
from mahovik.core.stand import load
from mahovik.core.stand.model import Stand
from mahovik.proof.verify.check import conclusion, worst_lines
from mahovik.proof.verify.rigorous import measure_rounding
from mahovik.stands import names, path

OPTIONS = {"stands": 50, "states": 60, "rounded": 12, "jobs": CORES}

PAIRS = ("C - reference", "second - reference", "C - second")
NOT_NUMBERS = ("status", "rank")


def stand_of(number: int) -> Stand:
    """An example stand, then random ones."""
    examples = names()
    if number < len(examples):
        return load(path(examples[number]))
    *_, stand = random_stands(number - len(examples) + 1)
    return stand


def largest_differences(number: int, states: int) -> tuple[int, bool, list[float]]:
    """Flywheels of the random stand of that number, whether it passed, and the largest differences of PAIRS."""
    stand = stand_of(number + len(names()))
    report = verify_random(stand, states)
    if not report.passed:
        print(f"{stand.name}: {conclusion(report)}\n{worst_lines(report)}", flush=True)
    pairs = ((row.value, row.second or 0.0) for row in report.rows)
    return len(stand.flywheels), report.passed, [max(column) for column in zip(*pairs, strict=True)]


def three_ways(options: Namespace) -> Iterator[tuple[Any, ...]]:
    """A row for each number of flywheels."""
    stands = range(options.stands)
    verdicts = list(side_by_side(largest_differences, options.jobs, stands, [options.states] * len(stands)))
    for count in sorted({flywheels for flywheels, *_ in verdicts}):
        passed = [good for flywheels, good, _ in verdicts if flywheels == count]
        worst = zip(*(pairs for flywheels, _, pairs in verdicts if flywheels == count), strict=True)
        yield count, len(passed), sum(passed), *map(max, worst)


def claim_of_three_ways(rows: Rows) -> str:
    """Stands that passed, and the largest difference."""
    passed, stands = (sum(row[key] for row in rows) for key in ("passed", "stands"))
    worst = max(row[pair] for row in rows for pair in PAIRS)
    return f"C and two derivations agree on {passed} of {stands} random stands: largest difference {worst:.0e}"


def worst_in_float(number: int, states: int) -> dict[tuple[str, str], float]:
    """Largest difference of every quantity of a stand's C in float."""
    report = verify_random(stand_of(number), states, real="float")
    return {(row.judged, row.quantity): row.value for row in report.rows if row.quantity not in NOT_NUMBERS}


def in_float(options: Namespace) -> Iterator[tuple[Any, ...]]:
    """A row for each quantity, over example and random stands."""
    stands = range(len(names()) + options.stands)
    worst: dict[tuple[str, str], float] = {}
    for differences in side_by_side(worst_in_float, options.jobs, stands, [options.states] * len(stands)):
        worst |= {key: max(off, worst.get(key, 0.0)) for key, off in differences.items()}
    for key, off in worst.items():
        yield *key, LIMITS["float"].value, off


def claim_of_float(rows: Rows) -> str:
    """The quantity that is nearest to its bound."""
    row = max(rows, key=lambda row: row["worst"] / row["bound"])
    return (
        f"In `float` every quantity of example and random stands keeps its bound; nearest is `{row['quantity']}` of "
        f"`{row['want']}`, {row['worst']:.0e} of {row['bound']:.0e}"
    )


def rounding_of(number: int, states: int, real: str) -> dict[tuple[str, str, str], float]:
    """True error of each quantity of a stand's C by enclosures, over its scale."""
    report = measure_rounding(stand_of(number), count=states, real=real)
    return {(real, row.judged, row.quantity): row.value for row in report.rows}


def rounding(options: Namespace) -> Iterator[tuple[Any, ...]]:
    """A row for each quantity, over example stands and `rounded` random ones."""
    work = [(number, options.states, real) for real in REALS for number in range(len(names()) + options.rounded)]
    worst: dict[tuple[str, str, str], float] = {}
    for errors in side_by_side(rounding_of, options.jobs, *zip(*work, strict=True)):
        for key, error in errors.items():
            worst[key] = max(error, worst.get(key, 0.0))
    for (real, want, quantity), error in worst.items():
        yield real, want, quantity, error, LIMITS[real].rigorous


def claim_of_rounding(rows: Rows) -> str:
    """The largest errors."""
    words = [f"in `{real}` at most {max(row['of scale'] for row in rows if row['real'] == real):.1e}" for real in REALS]
    return f"Rounding of the C, bounded by enclosures, as a part of the scale: {'; '.join(words)}"


def forward_and_torque(rows: Rows) -> Rows:
    """Those quantities alone that move a stand."""
    return [row for row in rows if row["want"] in ("forward", "coupled", "torque")]


TABLES = {
    "three-ways": Table(
        three_ways,
        {"flywheels": "{}", "stands": "{}", "passed": "{}", **dict.fromkeys(PAIRS, "{:.0e}")},
        claim_of_three_ways,
        lambda row: row["passed"] == row["stands"],
        "Random stands, compiled: the generated C against the literal reference and the second derivation. Accepted: "
        "1e-12.",
    ),
    "float": Table(
        in_float,
        {"want": "`{}`", "quantity": "`{}`", "bound": "{:.0e}", "worst": "{:.0e}"},
        claim_of_float,
        at_most("worst", "bound"),
        "The same in `float`, where the bounds of `verify` are those of rounding.",
    ),
    "rounding": Table(
        rounding,
        {
            "real": "{}", "want": "`{}`", "quantity": "`{}`", "of scale": "{:.1e}", "accepted": "{:.0e}",
        },
        claim_of_rounding,
        at_most("of scale", "accepted"),
        "The error of the C from stand file and state to the answer, bounded by [ball "
        "arithmetic](verification.md#rounding), as a part of the measured scale.",
        forward_and_torque,
    ),
}  # fmt: skip
