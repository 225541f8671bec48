"""Search for motions that preflight refuses, and write what was found into docs/results/planning.md.

python tools/refusal_campaign.py [--stands 4] [--first 8000] [--seconds 5] [--jobs 1] [--write]

Four kinds of motions that cannot be, a little beyond what can be where there is such a measure. Exit status 1 where a
search finds a programme that preflight refuses.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import replace
from functools import partial

import campaign
import numpy as np
from kept import Campaign, Columns, Figures
from plan_stands import PERIOD, campaign_motion, campaign_stand

from mahovik.core.motion.required import Bounds
from mahovik.laws.suspension.data import Suspension
from mahovik.use.plan.budget import Budget
from mahovik.use.plan.preflight import preflight
from mahovik.use.plan.problem import Problem
from mahovik.use.plan.search import Improver, search

COUNTS = (6, 8, 12)
ROUNDS = 3


def without_support(seed: int, N: int, factor: float) -> Problem:
    """Nothing carries the weight, or the mean height is held where the suspension does not carry it."""
    stand = campaign_stand(seed, N)
    if seed % 2:
        return Problem.of(stand.without_laws(Suspension), campaign_motion(seed, N))
    motion = campaign_motion(seed, N)
    mean = np.array([0.0, 0.0, 1e-3 * factor, 0.0, 0.0, 0.0])
    return Problem.of(stand, replace(motion, mean=mean, free_mean=(True, True, False, True, True, True)))


def without_unbalance(seed: int, N: int, factor: float) -> Problem:
    """Flywheels without static unbalance: the motion needs forces."""
    return Problem.of(campaign_stand(seed, N, 0.0), campaign_motion(seed, N, amplitude=factor))


def too_far(seed: int, N: int, factor: float) -> Problem:
    """`factor` times the amplitude that the first moment allows."""
    reach = preflight(Problem.of(campaign_stand(seed, N), campaign_motion(seed, N))).reach
    return Problem.of(campaign_stand(seed, N), campaign_motion(seed, N, amplitude=factor / reach))


def too_slow(seed: int, N: int, factor: float) -> Problem:
    """Bounds on acceleration and speed squared `factor` times tighter than those that preflight lets through."""
    stand, omega2 = campaign_stand(seed, N), (2 * np.pi / PERIOD) ** 2

    def problem_within(share: float) -> Problem:
        bounds = Bounds(speed=(float(np.sqrt(share * omega2)),) * N, acceleration=(share * omega2,) * N)
        return Problem.of(stand, campaign_motion(seed, N, bounds=bounds))

    low, high = 0.0, 1.0
    for _ in range(12):
        middle = (low + high) / 2
        low, high = (middle, high) if preflight(problem_within(middle)).refusal else (low, middle)
    return problem_within(low / factor)


KINDS: dict[str, tuple[str, Callable[[int, int, float], Problem]]] = {
    "MEAN_WRENCH": ("no suspension, or a mean height held 1 to 1.5 mm off", without_support),
    "SPAN": ("balanced flywheels", without_unbalance),
    "FIRST_MOMENT": ("amplitude 1.05 to 1.5 times the limit", too_far),
    "BOUND_REACH": ("bounds 1.05 to 1.5 times tighter than the limit", too_slow),
}


def outcome(seconds: float, kind: str, seed: int) -> tuple[bool, bool, float]:
    """Whether preflight refuses it by this reason, whether a search finds it, the search's best relative residual."""
    factor = float(np.random.default_rng(seed).uniform(1.05, 1.5))
    problem = KINDS[kind][1](seed, COUNTS[seed % 3], factor)
    first = preflight(problem)
    found = search(problem, Improver.of(problem), first.bias, 0, Budget(10**6, seconds), most=ROUNDS)
    return first.refusal is not None and first.refusal.reason == kind, bool(found.found), found.best


TABLE = Columns(
    {
        "refusal": "`{}`", "motion": "{}", "refused": "{} of {}", "found by a search": "{}",
        "least residual of a search, bounds aside": "{:.1g}",
    },
    None,
)  # fmt: skip


def page(found: Figures) -> str:
    """The table."""
    return (
        f"{found['stands']} stands per kind, seeds from {found['first']}, N = {', '.join(map(str, COUNTS))} in turn; "
        f"a search of {found['rounds']} rounds, cut after {found['seconds']:g} s.\n\n{TABLE.text(found['rows'])}"
    )


CAMPAIGN = Campaign(
    "refusals",
    campaign.Block("docs/results/planning.md", "refusals: tools/refusal_campaign.py --write"),
    page,
)


def main() -> None:
    """Runs the kinds and writes the page."""
    asked = campaign.parser(__doc__, stands=4, first=8000, seconds=5.0, jobs=1, write=False).parse_args()
    seeds = campaign.seeds(asked.first, asked.stands)
    lines, false = [], 0
    for kind, (words, _) in KINDS.items():
        found = list(campaign.map_rows(partial(outcome, asked.seconds, kind), asked.jobs, seeds))
        refused, reached = (sum(each[k] for each in found) for k in (0, 1))
        false += reached
        least = min(each[2] for each in found)
        lines.append((kind, words, (refused, len(found)), reached, least))
        print(campaign.row(*lines[-1]), flush=True)
    if asked.write:
        settings = {"first": asked.first, "stands": asked.stands, "seconds": asked.seconds, "rounds": ROUNDS}
        CAMPAIGN.keep({**settings, "rows": TABLE.rows(lines)}, asked.first)
    sys.exit(1 if false else 0)


if __name__ == "__main__":
    main()
