"""The true error of the C of the example stands and of random ones, by enclosures: writes docs/results/rounding.md.

python tools/rigorous.py [--states 200] [--random 12] [--random-states 24] [--jobs 2]
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from statistics import median

import campaign
from random_stands import random_stands

from mahovik.contract.functions import wants_of
from mahovik.core.stand import load
from mahovik.proof.verify.bounds import BOUNDS
from mahovik.proof.verify.rounding.limits import MARGIN, ULPS
from mahovik.proof.verify.rounding.measure import measure_rounding
from mahovik.proof.verify.rounding.report import ulp_text
from mahovik.stands import names, path

PAGE = campaign.ROOT / "docs" / "results" / "rounding.md"
SHORT = ("forward", "coupled", "torque")
HEAD = ("want", "quantity", "ulp", "function alone", "judges", "of scale", "judges of scale", "accepted", "relative")
RANDOM = "random"

INTRODUCTION = """# Rounding, bounded

Written by `python tools/rigorous.py` (`make rigorous`). How far is the C from the *exact* answer? Comparing two
programs in the same arithmetic does not say: both round. Here (1)-(9) are evaluated literally in ball arithmetic (Arb,
by python-flint): each number is a midpoint and a radius, each operation gives a ball that holds the exact result, and
the precision, 256 bits at first, is doubled until no ball adds more than 2^-16 ulp. So every error below is an upper
bound, proved for its states; the states are samples ([which](../verification.md#states)).

```sh
mahovik new demo3
mahovik verify demo3.toml --rigorous --states 50
```

measures a stand of yours (`pip install 'mahovik[rigorous]'`), also with `--real float` or `--against DIR`. The exit
status is 1 where an error is above the tolerance of `verify`{limit}.

## What is measured

* **ulp**: from stand file and state to the answer. The numbers of both are taken as the doubles that they are read as
  (for `float` those of a state are rounded to float first); all that follows is exact: mountings, inertias, attitude,
  sums, the solution. So the rounding of `prepare`, and for `float` that of the parameters, are errors of the C. It is
  the worst component of all states, in units in the last place of its
  [natural scale](../verification.md#the-natural-scale), the same that `verify` uses. (What comes before is not in it:
  units are converted exactly and rounded once, an unbalance by angles is turned into a centre of mass.)
* **function alone**: what the function itself rounds. Exact is then the program of the stand in ball arithmetic, with
  exact sine, cosine and square root, on the C's own prepared table and the quaternion that the C was given.
* **judges**: the larger error of the two that `verify` judges by, reference and second derivation (always in double).
* **of scale**: the error over the natural scale, of the C and of the judges. **accepted**: the tolerance of `verify`.
* **relative**: error over the largest exact component of the same unit (linear or angular part; all flywheels), the
  median over all states of all stands. It needs no scale. Its worst is left out: at some states the exact answer is
  zero, or nearly.

"""

FOLLOWS = """## What follows for the tolerances

`verify` compares the C with its judges, so their difference may be as large as both errors together. Each tolerance is
at least {margin:g} times that sum, over example and random stands (`tests/docs/test_rounding_page.py`). The narrowest
in `double`: {double}; in `float`: {single}.

The one tolerance of `double` leaves digits for stands that are worse conditioned than any here. An error of 1e-12 in
one number is too small for it, and is caught by `--rigorous`, which accepts {ulps:g} ulp. In `float` the tolerances
are near the error, each with its own reason (`mahovik.proof.verify.bounds`).

`generalized`, `points` and `inverse` have no enclosure: they are held to their tolerances by the judges alone.
"""


@dataclass
class Worst:
    """Of one quantity over stands."""

    ulps: float = 0.0
    alone: float = 0.0
    judges: float = 0.0
    scale: float = 0.0
    apart: float = 0.0
    own: tuple[float, ...] = ()

    def join(self, other: Worst) -> Worst:
        """The larger of each; relative errors of the states of both."""
        *mine, own = vars(self).values()
        *its, others = vars(other).values()
        return Worst(*map(max, mine, its), (*own, *others))

    @property
    def relative(self) -> float:
        """Median over states."""
        return median(self.own) if self.own else 0.0


Found = Mapping[tuple[str, str], Worst]


def measured(stand_name: str, number: int, states: int, real: str) -> tuple[bool, dict[tuple[str, str], Worst]]:
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


def joined(all_found: Sequence[Found]) -> dict[tuple[str, str], Worst]:
    """The worst over stands, in the order of the wants: a stand without flywheels has not all of them."""
    total: dict[tuple[str, str], Worst] = {}
    for found in all_found:
        for key, worst in found.items():
            total[key] = total.get(key, Worst()).join(worst)
    order = wants_of("rigorous")
    return {key: total[key] for key in sorted(total, key=lambda key: order.index(key[0]))}


def by_quantity(found: Found, real: str) -> str:
    """All columns, quantity by quantity."""
    rows = [
        [
            f"`{want}`",
            f"`{quantity}`",
            *(ulp_text(x) for x in (worst.ulps, worst.alone, worst.judges)),
            *(f"{x:.1e}" for x in (worst.scale, worst.apart)),
            f"{BOUNDS[real].of(want, quantity):.0e}",
            f"{worst.relative:.1e}",
        ]
        for (want, quantity), worst in found.items()
    ]
    return campaign.table(HEAD, rows, 2)


def by_stand(found: Mapping[str, Found]) -> str:
    """ulp of what moves a stand: quantities by stands."""
    keys = [key for key in joined(list(found.values())) if key[0] in SHORT]
    rows = [
        [f"`{want}`", f"`{quantity}`", *(_ulps(by.get((want, quantity))) for by in found.values())]
        for want, quantity in keys
    ]
    return campaign.table(["want", "quantity", *found], rows, 2)


def _ulps(worst: Worst | None) -> str:
    return "" if worst is None else ulp_text(worst.ulps)


def narrowest(found: Found, real: str) -> str:
    """The tolerance that stands least above the errors, in words."""

    def times(key: tuple[str, str]) -> float:
        worst = found[key]
        return BOUNDS[real].of(*key) / max(worst.scale + worst.apart, 1e-300)

    key = min(found, key=times)
    return f"`{key[1]}` of `{key[0]}`, {times(key):.3g} times"


def page(found: Mapping[str, Mapping[str, Found]], counts: tuple[int, int, int]) -> str:
    """The whole page; `found` by element type and stand, RANDOM the last of these."""
    states, stands, random_states = counts
    limit = f", or in double above {ULPS['double']:g} ulp"
    text = INTRODUCTION.format(limit=limit)
    for real, by in found.items():
        examples = {name: each for name, each in by.items() if name != RANDOM}
        text += f"## {real.capitalize()}\n\nThe example stands, {states} states each:\n\n"
        text += by_quantity(joined(list(examples.values())), real)
        text += (
            f"\nulp, stand by stand; `{RANDOM}`: the worst of {stands} random stands of 0 to 64 flywheels with legs, "
        )
        text += f"stream and all\nother kinds of wrench, {random_states} states each:\n\n" + by_stand(by)
        text += f"\n{RANDOM.capitalize()} stands:\n\n" + by_quantity(by[RANDOM], real) + "\n"
    totals = {real: joined(list(by.values())) for real, by in found.items()}
    return text + FOLLOWS.format(
        margin=MARGIN,
        double=narrowest(totals["double"], "double"),
        single=narrowest(totals["float"], "float"),
        ulps=ULPS["double"],
    )


def main() -> None:
    """Measure, write the page. Exit status 1 where a limit is not met."""
    options = campaign.parser(__doc__, states=200, random=12, random_states=24, jobs=campaign.cores())
    given = options.parse_args()
    jobs = [(name, 0, given.states, real) for real in BOUNDS for name in names()]
    jobs += [(RANDOM, number, given.random_states, real) for real in BOUNDS for number in range(given.random)]
    found: dict[str, dict[str, dict[tuple[str, str], Worst]]] = {real: {} for real in BOUNDS}
    passed = True
    for job, (good, worst) in zip(jobs, campaign.each(measured, given.jobs, *zip(*jobs, strict=True)), strict=True):
        passed = passed and good
        by = found[job[3]]
        by[job[0]] = joined([by.get(job[0], {}), worst])
    text = page(found, (given.states, given.random, given.random_states))
    PAGE.write_text(text, encoding="utf-8")
    raise SystemExit(0 if passed else 1)


if __name__ == "__main__":
    main()
