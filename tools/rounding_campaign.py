"""The true error of the C of the example stands and of random ones, by enclosures: writes docs/results/rounding.md.

python tools/rounding_campaign.py [--states 200] [--random 12] [--random-states 24] [--jobs 2]
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from statistics import median
from typing import Any

import campaign
from kept import Campaign, Columns, Figures
from random_stands import random_stands

from mahovik.contract.functions import wants_of
from mahovik.core.stand import load
from mahovik.proof.verify.bounds import BOUNDS
from mahovik.proof.verify.rounding.measure import MARGIN, measure_rounding, ulp_text
from mahovik.stands import names, path

SHORT = ("forward", "coupled", "torque")
TABLE = Columns(
    {
        "want": "`{}`", "quantity": "`{}`", "ulp": ulp_text, "function alone": ulp_text, "judges": ulp_text,
        "of scale": "{:.1e}", "judges of scale": "{:.1e}", "accepted": "{:.0e}", "relative": "{:.1e}",
    },
    2,
)  # fmt: skip
RANDOM = "random"

FOLLOWS = """## What follows for the tolerances

`verify` compares the C with its judges, so their difference may be as large as both errors together. Each tolerance is
at least {margin:g} times that sum, over example and random stands (`tests/docs/test_rounding_page.py`). The narrowest
in `double`: {double}; in `float`: {float}.
"""


@dataclass
class Worst:
    """Worst errors of one quantity over stands."""

    ulps: float = 0.0
    alone: float = 0.0
    judges: float = 0.0
    scale: float = 0.0
    apart: float = 0.0
    own: tuple[float, ...] = ()

    def join(self, other: Worst) -> Worst:
        """The larger of each; relative errors of the states of both."""
        return Worst(
            max(self.ulps, other.ulps),
            max(self.alone, other.alone),
            max(self.judges, other.judges),
            max(self.scale, other.scale),
            max(self.apart, other.apart),
            (*self.own, *other.own),
        )

    @property
    def relative(self) -> float:
        """Median over states."""
        return median(self.own) if self.own else 0.0


Found = Mapping[tuple[str, str], Worst]


def measure_stand(stand_name: str, number: int, states: int, real: str) -> tuple[bool, dict[tuple[str, str], Worst]]:
    """Whether a stand passed, and its worst errors by want and quantity. `number`: of a random stand."""
    stand = load(path(stand_name)) if stand_name != RANDOM else list(random_stands(number + 1))[number]
    found = measure_rounding(stand, count=states, real=real)
    if not found.report.passed:
        print(f"{stand.name}, {real}: {[(row.quantity, row.state, row.reason) for row in found.report.failures]}")
    return found.report.passed, {
        (line.row.want, line.row.quantity): Worst(
            line.ulps, line.alone, line.judges, line.row.worst, line.apart, tuple(line.own)
        )
        for line in found.lines
    }


def join_worst(all_found: Sequence[Found]) -> dict[tuple[str, str], Worst]:
    """The worst over stands, in the order of the wants: a stand without flywheels does not answer all of them."""
    total: dict[tuple[str, str], Worst] = {}
    for found in all_found:
        for key, worst in found.items():
            total[key] = total.get(key, Worst()).join(worst)
    order = wants_of("rigorous")
    return {key: total[key] for key in sorted(total, key=lambda key: order.index(key[0]))}


def by_quantity(found: Found, real: str) -> list[dict[str, Any]]:
    """All columns, quantity by quantity."""
    return TABLE.rows(
        (*key, w.ulps, w.alone, w.judges, w.scale, w.apart, BOUNDS[real].of(*key), w.relative)
        for key, w in found.items()
    )


def by_stand(found: Mapping[str, Found]) -> list[dict[str, Any]]:
    """ulp of what moves a stand: quantities by stands."""
    keys = [key for key in join_worst(list(found.values())) if key[0] in SHORT]
    ulps = {key: {name: by[key].ulps if key in by else None for name, by in found.items()} for key in keys}
    return [{"want": key[0], "quantity": key[1], **ulps[key]} for key in keys]


def narrowest(found: Found, real: str) -> dict[str, Any]:
    """The tolerance that stands least above the errors."""

    def times(key: tuple[str, str]) -> float:
        worst = found[key]
        return BOUNDS[real].of(*key) / max(worst.scale + worst.apart, 1e-300)

    key = min(found, key=times)
    return {"want": key[0], "quantity": key[1], "times": times(key)}


def figures(found: Mapping[str, Mapping[str, Found]], counts: tuple[int, int, int]) -> Figures:
    """The figures to keep; `found` by element type and stand, RANDOM the last of these."""
    kept: Figures = dict(zip(("states", "random stands", "random states"), counts, strict=True))
    for real, by in found.items():
        examples = [each for name, each in by.items() if name != RANDOM]
        kept[real] = {
            "examples": by_quantity(join_worst(examples), real),
            "stands": by_stand(by),
            "random": by_quantity(by[RANDOM], real),
            "narrowest": narrowest(join_worst(list(by.values())), real),
        }
    return kept


def page(found: Figures) -> str:
    """The tables of both element types, and what is narrowest."""
    text = ""
    words = {}
    for real in BOUNDS:
        kept = found[real]
        stands = Columns({key: TABLE.forms.get(key, ulp_text) for key in kept["stands"][0]}, 2)
        text += (
            f"## {real.capitalize()}\n\nThe example stands, {found['states']} states each:\n\n"
            f"{TABLE.text(kept['examples'])}\nulp, stand by stand; `{RANDOM}`: the worst of {found['random stands']} "
            "random stands of 0 to 64 flywheels with legs, stream and all\nother kinds of wrench, "
            f"{found['random states']} states each:\n\n{stands.text(kept['stands'])}\n"
            f"{RANDOM.capitalize()} stands:\n\n{TABLE.text(kept['random'])}\n"
        )
        least = kept["narrowest"]
        words[real] = f"`{least['quantity']}` of `{least['want']}`, {least['times']:.3g} times"
    return text + FOLLOWS.format(margin=MARGIN, **words)


CAMPAIGN = Campaign(
    "rounding",
    campaign.Block("docs/results/rounding.md", "figures: tools/rounding_campaign.py"),
    page,
)


def main() -> None:
    """Measure, write the page. Exit status 1 where a limit is not met."""
    options = campaign.parser(__doc__, states=200, random=12, random_states=24, jobs=campaign.cores())
    given = options.parse_args()
    jobs = [(name, 0, given.states, real) for real in BOUNDS for name in names()]
    jobs += [(RANDOM, number, given.random_states, real) for real in BOUNDS for number in range(given.random)]
    found: dict[str, dict[str, dict[tuple[str, str], Worst]]] = {real: {} for real in BOUNDS}
    passed = True
    for job, (good, worst) in zip(
        jobs, campaign.map_rows(measure_stand, given.jobs, *zip(*jobs, strict=True)), strict=True
    ):
        passed = passed and good
        by = found[job[3]]
        by[job[0]] = join_worst([by.get(job[0], {}), worst])
    CAMPAIGN.keep(figures(found, (given.states, given.random, given.random_states)), 0)
    raise SystemExit(0 if passed else 1)


if __name__ == "__main__":
    main()
