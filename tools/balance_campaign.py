"""Published cases of balancing, repeated by `mahovik balance`: docs/results/balancing.md.

python tools/balance_campaign.py
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import campaign
import numpy as np
from kept import Campaign, Columns, Figures

import mahovik
from mahovik.use.balance.polar import read_polar, write_polar

FOILES = (
    ("9.8@117 17@124 7.2@114 38.5@77", "55@259"),
    ("2.7@43 14.3@317 4.5@213 14.3@270", "45@118"),
    ("12.5@323 25@261 15.2@158 30@238", "124@21"),
    ("22.4@92 32.6@45 23.3@315 27.8@210", "138@349"),
    ("26@94 40.3@9 25@330 34@213", "107@349"),
    ("40.3@355 43@144 29.6@61 65.4@322", "90@280"),
    ("20.6@339 32.3@152 36.7@41 61.8@322", "58@354"),
    ("12.6@226 37.6@52 18.8@153 26@176", "108@201"),
    ("13.4@209 26.9@76 47.5@98 71.7@312", "88@190"),
    ("13.4@154 22.4@307 52@299 102@165", "56@48"),
    ("5.4@24 7.2@199 22.4@2 27.8@99", "73@158"),
)
"""A turbogenerator of Foiles, Allaire, Gunter: ALPHA, A."""

TURBOGENERATOR = {"ALPHA": [row.split() for row, _ in FOILES], "A": [a for _, a in FOILES]}


ROUNDING = 1e-9
"""Vibration that is left by rounding alone."""


@dataclass(frozen=True)
class Published:
    """A case: where it is printed, what is measured there, the method, and the corrections as printed."""

    source: str
    what: str
    given: dict[str, Any]
    printed: tuple[str, ...]
    method: str = "least-squares"

    def line(self) -> tuple[object, ...]:
        """A line of the table."""
        found = mahovik.balance(self.given, method=self.method)
        theirs = np.array([read_polar(text) for text in self.printed])
        left = (found.problem.A + found.problem.alpha @ theirs, found.residual)
        sizes = [float(np.abs(x).max() if self.method == "min-max" else np.linalg.norm(x)) for x in left]
        sizes = [x if x > ROUNDING else 0.0 for x in sizes]
        return (
            self.source,
            self.what,
            self.method,
            list(self.printed),
            [write_polar(w) for w in found.w.tolist()],
            *sizes,
        )


CASES = (
    Published(
        "Brüel & Kjær 17-227, example 4", "two planes, two sensors",
        {"A": ["170@112", "53@78"], "B": [["235@94", "185@115"], ["58@68", "77@104"]], "U": ["1.15@0", "1.15@0"]},
        ("1.979@236.2", "1.071@121.8"),
    ),
    Published(
        "Feese, Grazier 2004", "two planes, four sensors, trial weights stay on",
        {
            "A": [".68@32", ".56@86", "1.94@231", "2.07@335"],
            "B": [["1.31@1", ".54@9"], ["1.25@75", ".52@75"], [".93@251", ".81@196"], ["1@342", ".9@296"]],
            "U": ["11.1@35", "3.7@135"],
            "keep_trial": True,
        },
        ("15.3@3", "6.6@113"),
    ),
    Published(
        "Kelm, Pavelek 2016", "two planes, four sensors, influences of two digits; printed: by hand",
        {
            "ALPHA": [["0.04@58", "0.029@47.9"], ["0.034@123.3", "0.051@358"], ["0.039@31.8", "0.025@115.4"],
                      ["0.046@311.5", "0.034@57.0"]],
            "A": ["0.97@175", "2.2@168", "0.84@327", "0.58@318.5"],
        },
        ("17.5@230", "30.3@0"),
    ),
    Published(
        "Goodman 1964", "two planes, three sensors",
        {"ALPHA": [["3@0", "2@180"], ["5@0", "2@180"], ["5@0", "3@180"]], "A": ["1@0", "1@180", "0@0"]},
        ("0.81@0", "1.48@0"),
    ),
    Published(
        "Foiles, Allaire, Gunter 2000", "four planes, eleven vibrations", TURBOGENERATOR,
        ("4.42@88", "2.92@352", "1.588@322", "1.928@304"), "min-max",
    ),
    Published(
        "Foiles, Allaire, Gunter 2000", "the same, at most 3.402 in a plane", {**TURBOGENERATOR, "most": 3.402},
        ("3.402@91", "2.325@354", "1.361@318", "1.786@305"), "min-max",
    ),
)  # fmt: skip

TABLE = Columns(
    {
        "source": "{}", "case": "{}", "method": "{}", "printed": ", ".join, "found": ", ".join,
        "left by printed": "{:.4g}", "left by found": "{:.4g}",
    },
    5,
)  # fmt: skip


def page(figures: Figures) -> str:
    """The table, and what it means."""
    words = (
        "Left: root of the sum of squares of the vibration for least squares, the largest for min-max. Corrections as "
        "printed are rounded, so they leave a little more."
    )
    return f"{TABLE.text(figures['rows'])}\n\n{words}"


CAMPAIGN = Campaign(
    "balancing",
    campaign.Block("docs/results/balancing.md", "published: tools/balance_campaign.py"),
    page,
)


def main() -> None:
    """Repeats all cases and writes the page."""
    campaign.parser(__doc__).parse_args()
    rows = TABLE.rows(case.line() for case in CASES)
    CAMPAIGN.keep({"rows": rows})
    print(TABLE.text(rows))


if __name__ == "__main__":
    main()
