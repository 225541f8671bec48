"""Planning as a whole: preflight, search, choice, verification, report."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from mahovik.core.motion.programme import Fourier, Programme
from mahovik.core.motion.required import RequiredMotion, with_winding
from mahovik.core.stand.model import Stand
from mahovik.errors import StateError
from mahovik.use.plan.bounds import bounded
from mahovik.use.plan.budget import Budget
from mahovik.use.plan.certificate import certified, programme_of, without_refused_tables, wrong_items
from mahovik.use.plan.choose import Improver, choose
from mahovik.use.plan.figures import figures
from mahovik.use.plan.finite_planner import plan_finite
from mahovik.use.plan.interrupt import deferred
from mahovik.use.plan.ocp import plus_asked
from mahovik.use.plan.outcome import Plan, Status, Tell, Ways
from mahovik.use.plan.preflight import Preflight, preflight
from mahovik.use.plan.problem import Problem
from mahovik.use.plan.runup import shortcomings, with_runup
from mahovik.use.plan.search import Candidate, Search, search
from mahovik.use.plan.shortened import repeated, shortened
from mahovik.use.plan.wishes import Wishes


def plan_motion(stand: Stand, motion: RequiredMotion, wishes: Wishes | None = None, tell: Tell | None = None) -> Plan:
    """A programme that makes the carrier of `stand` do `motion`, (12)-(13), or why there is none.

    Ctrl-C gives the best so far; a second one in its verification ends without it. UsageError: the method means nothing
    on this stand. MotionError: the bounds exclude the winding that is wished.
    """
    asked = wishes or Wishes()
    plus = plus_asked(stand, asked)
    if asked.winding is not None:
        motion = with_winding(motion, asked.winding)
    whole = Budget(0, asked.seconds)
    with_tables = motion.runup is not None and motion.periodic
    asked = replace(asked, seconds=whole.left(SEARCH if with_tables else 1.0))
    budget = Budget(asked.steps, asked.seconds_of_search)
    try:
        problem = Problem.of(stand, shortened(motion))
        first = preflight(problem)
    except StateError as error:
        return Plan("SINGULAR_ATTITUDE", None, (str(error),), (), ())
    if first.refusal is not None:
        return Plan("NO_PROGRAM", first.refusal.reason, (first.refusal.words,), tuple(first.warnings), ())
    if not motion.periodic:
        return plan_finite(problem, first, asked, budget, tell, plus)
    improver = Improver.of(problem)
    found = search(problem, improver, first.bias, asked.seed, budget, max(asked.enough, asked.keep), tell=tell)

    def say(doing: str) -> None:
        found.doing = doing
        if tell is not None:
            tell(found)

    after = After(whole, say, asked.verify)
    chosen = choose(improver, found)
    ways = Ways([(each, {}) for each in chosen], words=() if chosen else (not_found(found),))
    if asked.method != "fourier" and chosen and not found.interrupted:
        from mahovik.use.plan.ocp.plan import periodic_ocp

        ways = periodic_ocp(improver, chosen, asked, plus, budget, tell)
        found.interrupted |= ways.interrupted
        found.cut |= ways.cut
    return _plan(problem, motion, first, found, ways, budget.taken, asked, after)


SEARCH = 0.5
"""Of the time that is given, where run-up and run-down come after the search: they have the rest."""


@dataclass(frozen=True, eq=False)
class After:
    """What comes after the search: run-ups in what is left of the time, then the verification, whatever its time."""

    whole: Budget
    say: Callable[[str], None]
    verify: bool

    def completed(self, stand: Stand, motion: RequiredMotion, programme: Programme, seed: int) -> Programme:
        """The programme with its tables, verified."""
        programme = with_runup(stand, motion, programme, seed, self.whole, self.say)
        if not self.verify:
            return programme
        self.say("verifying")
        with deferred(self.whole.interrupt, again=True):
            return without_refused_tables(certified(stand, motion, programme))


def _plan(
    problem: Problem,
    motion: RequiredMotion,
    first: Preflight,
    found: Search,
    ways: Ways[Candidate],
    steps: int,
    asked: Wishes,
    after: After,
) -> Plan:
    """The outcome of a search for `motion`, of which the problem may be a part that repeats itself."""
    effort = {
        "seed": asked.seed,
        "starts": found.starts,
        "steps": steps,
        "windings_tried": dict(found.tried),
        "found": len(found.found),
        "best_residual": float(found.best),
        "cut_by_time": found.cut,
        "objective_spread": [each.objective for each, _ in ways.found],
    }
    if not ways.found:
        return Plan("NO_PROGRAM", ways.reason, tuple(ways.words), tuple(first.warnings), (), effort, found.interrupted)
    programmes, refused = [], []
    for each, told in ways.found:
        with deferred(after.whole.interrupt, again=True):
            programme = _programme(problem, motion, each, {"search": effort, **told})
        programme = after.completed(problem.stand, motion, programme, asked.seed)
        wrong = wrong_items(programme)
        if wrong:
            refused.append(f"a programme was found and refused by the verification: {wrong}")
        else:
            programmes.append((each, programme))
        if len(programmes) == asked.keep or (programmes and after.whole.interrupted):
            break
    interrupted = found.interrupted or after.whole.interrupted
    if not programmes:
        return Plan("NO_PROGRAM", "SEARCH", tuple(refused), tuple(first.warnings), (), effort, interrupted)
    best, programme = programmes[0]
    warnings = (*first.warnings, *programme.report.get("warnings", ()))
    given = tuple(each for _, each in programmes)
    over = (*(each.words for each in best.exceeded), *shortcomings(programme))
    status: Status = "OK_LIMIT" if over else "OK"
    return Plan(status, None, over, warnings, given, effort, interrupted)


def not_found(found: Search) -> str:
    """Words of a search without success; it proves nothing."""
    tried = ", ".join(f"{kind} {number}" for kind, number in found.tried.items()) or "none"
    ended = "cut by time" if found.cut else "interrupted" if found.interrupted else "out of budget"
    return (
        f"no programme was found, which is no proof that there is none: {found.starts} starts tried ({tried}), "
        f"best relative residual {found.best:.3g}, {ended}; another seed, more time, another winding, a smaller "
        "motion or one more flywheel may help"
    )


def _programme(problem: Problem, motion: RequiredMotion, chosen: Candidate, told: Mapping[str, Any]) -> Programme:
    """The programme with its report."""
    own = repeated(chosen.motion, round(motion.span / problem.motion.span))
    found = figures(problem, chosen.motion)
    report: dict[str, Any] = {
        "kind": chosen.kind,
        "objective": chosen.objective,
        "objective_parts": dict(chosen.parts),
        "bounds_used": chosen.used if bounded(motion.bounds) else None,
        "exceeded": [each.words for each in chosen.exceeded],
        "harmonics": own.H,
        "residual": found.residual,
        "peak_speed": found.speed,
        "peak_acceleration": found.acceleration,
        "peak_torque": found.torque,
        "least_singular_value": found.sigma,
        "det_I_sign_changes": found.sign_changes,
        **told,
    }
    course = Fourier(np.array(own.mean), np.array(own.cos), np.array(own.sin))
    return programme_of(problem.stand, motion, own.bias, tuple(int(n) for n in own.winding), course, report)
