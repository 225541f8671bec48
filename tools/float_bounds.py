"""What rounding to float costs: measures every quantity of verify over random and example stands, and writes the table
of docs/results/verification.md; exit status 1 where a bound is not met.

python tools/float_bounds.py [--stands 48] [--states 40] [--jobs 2]
"""

from __future__ import annotations

from collections.abc import Iterator

import campaign
import numpy as np
from kept import Campaign, Columns, Figures
from random_stands import random_stands, verify_random

from mahovik.core.stand.model import Stand
from mahovik.core.stand.summary import summarize
from mahovik.proof import reference
from mahovik.proof.verify.bounds import FLOAT
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.draw import round_to_float
from mahovik.stands import names, path
from mahovik.use.study.resolution import FACTOR, MOTIONS, QUANTITIES, UNIT, states

Worst = dict[tuple[str, str], float]
UNITS = "units of `check`"
TABLE = Columns({"want": "`{}`", "quantity": "`{}`", "bound": "{:.0e}", "worst measured": "{:.0e}"}, 2)


def stand_of(number: int) -> Stand:
    """Example stands first, then random ones."""
    if number < len(names()):
        from mahovik.core.stand import load

        return load(path(names()[number]))
    *_, found = random_stands(number - len(names()) + 1)
    return found


def measure_stand(number: int, count: int) -> tuple[int, Worst]:
    """States, and the worst difference of every quantity over its scale; for `check` in units of its terms."""
    stand = stand_of(number)
    found: Worst = {}
    for row in verify_random(stand, count, real="float").rows:
        found[row.want, row.quantity] = max(row.worst, row.between or 0.0)
    found[UNITS, ""] = max(units(stand), default=0.0)
    return count, found


def units(stand: Stand) -> Iterator[float]:
    """Error of the C in float over 2^-24 times the terms of study.resolution, at its states."""
    backend = CBackend(stand, "float")
    speeds = [row.speed for row in summarize(stand).unbalance]
    for motion in MOTIONS if speeds else ():
        for state in map(round_to_float, states(stand, speeds, motion)):
            at = reference.pieces(stand, state)
            for want, quantity in QUANTITIES.items():
                expected = reference.evaluate(stand, state, [want], at)[quantity.key]
                off = np.abs(np.array(backend.evaluate(state, [want])[quantity.key]) - expected)
                terms = quantity.terms(at, state)
                yield float((off[terms > 0] / terms[terms > 0]).max(initial=0.0)) / UNIT


def figures(worst: Worst, stands: int, count: int) -> Figures:
    """The figures to keep: a row for each quantity."""
    rows = [
        (want, quantity, FLOAT.of(want, quantity), off)
        for (want, quantity), off in worst.items()
        if want != UNITS and quantity not in ("status", "rank")
    ]
    return {
        "stands": stands,
        "states": count,
        "units": worst[UNITS, ""],
        "units_assumed": FACTOR,
        "rows": TABLE.rows(rows),
    }


def page(found: Figures) -> str:
    """The block between the markers."""
    return (
        f"{found['stands']} stands (the examples, then random ones of 0 to 64 flywheels), {found['states']} states "
        f"each.\nRounding in `check`: at most {found['units']:.1f} units of 2^-24 of the terms measured, "
        f"{found['units_assumed']:.0f} assumed.\n\n{TABLE.text(found['rows'])}"
    )


CAMPAIGN = Campaign(
    "verification-float",
    campaign.Block("docs/results/verification.md", "float: tools/float_bounds.py"),
    page,
)


def main() -> None:
    """Measure, write, judge."""
    given = campaign.parser(__doc__, stands=48, states=40, jobs=campaign.cores()).parse_args()
    total = given.stands + len(names())
    worst: Worst = {}
    for _, found in campaign.map_rows(measure_stand, given.jobs, range(total), [given.states] * total):
        for key, off in found.items():
            worst[key] = max(worst.get(key, 0.0), off)
    CAMPAIGN.keep(figures(worst, total, given.states), 0)
    beyond = [
        f"{want}: {quantity}"
        for (want, quantity), off in worst.items()
        if want != UNITS and off > FLOAT.of(want, quantity)
    ]
    if worst[UNITS, ""] > FACTOR:
        beyond.append(UNITS)
    print(f"beyond their bounds: {', '.join(beyond) or 'none'}")
    raise SystemExit(1 if beyond else 0)


if __name__ == "__main__":
    main()
