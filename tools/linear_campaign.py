"""Compare linear models with automatic differentiation and steady states with simulation.

Writes docs/results/linear.md and docs/results/response.md.

python tools/linear_campaign.py [--stands 200] [--first 1] [--write]

Exit status 1 where a figure is not what the pages promise.
"""

from __future__ import annotations

import sys
from dataclasses import dataclass, replace
from typing import Any

import campaign
import numpy as np
from kept import Campaign, Columns, Figures
from scipy.spatial.transform import Rotation

from mahovik.core import motion
from mahovik.core.motion.laws import WrenchTable
from mahovik.core.stand import Stand, load
from mahovik.core.stand.random import random_stand, random_state
from mahovik.proof.second.linear import linear
from mahovik.stands import path
from mahovik.use.simulate import Case, simulate
from mahovik.use.study.linear import linear_model
from mahovik.use.study.response import Periodic, periodic_response
from mahovik.use.study.rest import rest

AGREEMENT, EQUAL = 1e-10, 1e-6
FLYWHEELS = (0, 1, 2, 4, 8)
LINEAR = Columns({"flywheels": "{}", "stands": "{}", **dict.fromkeys("ABCD", "{:.0e}")})
RESPONSE = Columns({"stand": "{}", "speeds, rpm": "{}", "nodes": "{}", "simulated": "{}", "apart": "{:.0e}"})
POSE = ("x [m]", "y [m]", "z [m]", "qx", "qy", "qz", "qw")


def disagreement(first: object, second: object) -> dict[str, float]:
    """Largest difference of each matrix, part of the largest number of its row."""
    found = {}
    for name in "ABCD":
        a, b = (np.asarray(getattr(each, name)) for each in (first, second))
        size = np.abs(b).max(axis=1, keepdims=True, initial=0.0) if b.size else np.ones((1, 1))
        found[name] = float((np.abs(a - b) / np.where(size > 0.0, size, 1.0)).max(initial=0.0))
    return found


def linear_row(N: int, stands: int, first: int) -> tuple[Any, ...]:
    """Random stands with this number of flywheels, a state each."""
    found = []
    for seed in campaign.seeds(first, stands):
        rng = np.random.default_rng([seed, N])
        stand = random_stand(rng, N)
        state = random_state(stand, rng)
        found.append(disagreement(linear_model(stand, state), linear(stand, state)))
    return N, len(found), *(max(each[name] for each in found) for name in "ABCD")


def linear_figures(stands: int, first: int) -> Figures:
    """Random stands by number of flywheels."""
    rows = [linear_row(N, stands // len(FLYWHEELS), first) for N in FLYWHEELS]
    return {"first": first, "accepted": AGREEMENT, "rows": LINEAR.rows(rows)}


def linear_page(found: Figures) -> str:
    """A sentence and the table."""
    return (
        f"Random stands, each at a random state; accepted is {found['accepted']:g} of the largest number of a row.\n\n"
        + LINEAR.text(found["rows"])
    )


@dataclass(frozen=True)
class Course:
    """A steady state to be reached: an example stand, speeds in rpm, seconds from rest (None: starts on the course)."""

    stand: str
    rpm: tuple[float, ...]
    until: float | None


COURSES = (
    Course("bench8", (90.0,) + (0.0,) * 7, 40.0),
    Course("bench8", (600.0,) * 8, 40.0),
    Course("bench8", (200.0, -300.0) + (0.0,) * 5 + (100.0,), 40.0),
    Course("shaker2", (1200.0, -1200.0), 40.0),
    Course("shaker2", (120.0, 60.0), 40.0),
    Course("sat4", (6000.0, 0.0, -3000.0, 0.0), None),
    Course("sat4", (3000.0, 3010.0, 2990.0, 3020.0), None),
    Course("auv6", (600.0,) * 6, None),
)


def response_row(course: Course) -> tuple[Any, ...]:
    """A steady state against the generated C, from rest for long, or begun on the course for a period."""
    stand = load(path(course.stand))
    found = periodic_response(stand, [x * np.pi / 30 for x in course.rpm])
    how = "one period from the course" if course.until is None else f"{course.until:g} s from rest"
    speeds = ", ".join(f"{x:g}" for x in course.rpm)
    return course.stand, speeds, len(found.y), how, distance_from_course(stand, found, course.until)


def response_figures() -> Figures:
    """All courses."""
    return {"accepted": EQUAL, "rows": RESPONSE.rows(map(response_row, COURSES))}


def response_page(found: Figures) -> str:
    """A sentence and the table."""
    return (
        "Largest distance in place and attitude over the last period, part of the amplitude; accepted is "
        f"{found['accepted']:g}.\n\n{RESPONSE.text(found['rows'])}"
    )


def distance_from_course(stand: Stand, found: Periodic, until: float | None) -> float:
    """Distance of a run of the C from the course, at eight moments of its last period."""
    period, chart = found.turning.period, found.scene.chart
    periods = 1 if until is None else int(np.ceil(until / period))
    start = rest(stand).state
    if until is None:
        C = chart.C @ Rotation.from_rotvec(found.y[0, 3:6]).as_matrix()
        q = tuple(Rotation.from_matrix(C).as_quat(scalar_first=True).tolist())
        position = tuple((chart.O1 + chart.C @ found.y[0, :3]).tolist())
        start = replace(start, position=position, angles=None, quaternion=q, V=tuple(found.y[0, 6:].tolist()))
    hold = WrenchTable(np.zeros(1), found.hold[None])
    regime = replace(motion.steady_regime(stand, found.turning.speeds), wrenches={stand.carrier.name: hold})
    step = 0.02 / max(map(abs, found.turning.speeds))
    run = simulate(Case(stand, regime, start, periods * period, period / 8, step), "c")
    last = run.data[-9:, [run.names.index(name) for name in POSE]]
    x = (last[:, :3] - chart.O1) @ chart.C
    r = Rotation.from_matrix(chart.C.T @ Rotation.from_quat(last[:, 3:]).as_matrix()).as_rotvec()
    spectrum = np.fft.rfft(found.y[:, :6], axis=0) / len(found.y)
    k = np.arange(len(spectrum))
    waves = np.exp(2j * np.pi * np.outer(np.arange(9) / 8, k))
    expected = np.real(waves @ (spectrum * np.where(k == 0, 1.0, 2.0)[:, None]))
    off, size = np.abs(np.hstack([x, r]) - expected), np.ptp(found.y[:, :6], axis=0)
    return float(max(off[:, a].max() / size[a].max() for a in (slice(0, 3), slice(3, 6))))


def _block(name: str) -> campaign.Block:
    return campaign.Block(f"docs/results/{name}.md", "campaign: tools/linear_campaign.py --write")


LINEAR_CAMPAIGN = Campaign("linear", _block("linear"), linear_page)
RESPONSE_CAMPAIGN = Campaign("response", _block("response"), response_page)


def main() -> int:
    """Prints the tables, keeps them where asked to."""
    given = campaign.parser(__doc__, stands=200, first=1, write=False).parse_args()
    good = True
    both = (LINEAR_CAMPAIGN, linear_figures(given.stands, given.first)), (RESPONSE_CAMPAIGN, response_figures())
    for each, found in both:
        print(each.page(found), flush=True)
        largest = max(row[key] for row in found["rows"] for key in (*"ABCD", "apart") if key in row)
        good &= largest <= found["accepted"]
        if given.write:
            each.keep(found, given.first if each is LINEAR_CAMPAIGN else None)
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
