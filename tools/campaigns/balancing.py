"""Published cases of balancing, repeated by `mahovik balance`."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, cast

import numpy as np

from balance.published import BRUEL_KJAER, FEESE, GOODMAN, KELM, TURBOGENERATOR
from campaigns import Row, Rows, Table
from mahovik.use.balance.influence import Method, read_influence, read_polar, solve, write_polar

OPTIONS: dict[str, int] = {}

ROUNDING = 1e-9
"""Vibration that is left by rounding alone."""


@dataclass(frozen=True)
class Published:
    """A case: where it is printed, what is measured there, the data, the corrections as printed, the method."""

    source: str
    what: str
    data: dict[str, Any]
    printed: tuple[str, ...]
    method: str = "least-squares"


TWO = "two planes, "
FOILES = "W. C. Foiles, P. E. Allaire, E. J. Gunter, Min-max Optimum Flexible Rotor Balancing, 2000"
CASES = (
    Published(
        "J. Vaughan, Static and Dynamic Balancing, Brüel & Kjær 17-227, example 4", TWO + "two sensors", BRUEL_KJAER,
        ("1.979@236.2", "1.071@121.8"),
    ),
    Published(
        "T. D. Feese, P. E. Grazier, Balance This!, Turbomachinery Symposium 2004",
        TWO + "four sensors, trial weights stay on", FEESE, ("15.3@3", "6.6@113"),
    ),
    Published(
        "R. Kelm, D. Pavelek, Rotor Balancing Tutorial, Turbomachinery Symposium 2016",
        TWO + "four sensors, influences of two digits; printed: by hand", KELM, ("17.5@230", "30.3@0"),
    ),
    Published(
        "T. P. Goodman, A Least-Squares Method for Computing Balance Corrections, 1964", TWO + "three sensors", GOODMAN,
        ("0.81@0", "1.48@0"),
    ),
    Published(
        FOILES, "four planes, eleven vibrations", TURBOGENERATOR,
        ("4.42@88", "2.92@352", "1.588@322", "1.928@304"), "min-max",
    ),
)  # fmt: skip


def measure(options: Namespace) -> Iterator[tuple[Any, ...]]:
    """A row for each case."""
    for case in CASES:
        ((problem, *_), _), method = read_influence(case.data), cast(Method, case.method)
        solved = solve(problem, method)
        printed = np.array([read_polar(text) for text in case.printed])
        left = (problem.A + problem.alpha @ printed, solved.left)
        sizes = [float(np.abs(x).max() if case.method == "min-max" else np.linalg.norm(x)) for x in left]
        corrections = ", ".join(write_polar(w) for w in solved.w.tolist())
        rounded = (x if x > ROUNDING else 0.0 for x in sizes)
        yield case.source, case.what, case.method, ", ".join(case.printed), corrections, *rounded


def is_no_worse(row: Row) -> bool:
    """Whether no more vibration is left than by the printed corrections."""
    return bool(row["left by computed"] <= row["left by printed"])


def claim(rows: Rows) -> str:
    """How many cases are repeated."""
    return (
        f"{sum(map(is_no_worse, rows))} of {len(rows)} published cases of balancing are repeated, and no correction "
        "leaves more vibration than the printed one"
    )


TABLES = {
    "balancing": Table(
        measure,
        {
            "source": "{}", "case": "{}", "method": "{}", "printed": "{}", "computed": "{}",
            "left by printed": "{:.4g}", "left by computed": "{:.4g}",
        },
        claim,
        is_no_worse,
        "*Left*: root of the sum of squares of the vibration for least squares, the largest for min-max. Printed "
        "corrections are rounded, so they leave a little more.",
    )
}  # fmt: skip
