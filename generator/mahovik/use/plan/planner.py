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
from mahovik.use.plan.bounds import has_bounds
from mahovik.use.plan.budget import Budget, defer_interrupt
from mahovik.use.plan.certificate import certify, drop_refused_tables, failed_items, make_programme
from mahovik.use.plan.choose import Improver, choose
from mahovik.use.plan.figures import figures
from mahovik.use.plan.finite_planner import plan_finite
from mahovik.use.plan.ocp import requested_partition
from mahovik.use.plan.options import PlanOptions
from mahovik.use.plan.outcome import Candidates, OnProgress, Plan, Status
from mahovik.use.plan.period import repeat_motion, with_shortest_period
from mahovik.use.plan.preflight import Preflight, preflight
from mahovik.use.plan.problem import Problem
from mahovik.use.plan.runup import shortcomings, with_runup
from mahovik.use.plan.search import Candidate, Search, search


def plan_motion(
    stand: Stand, motion: RequiredMotion, options: PlanOptions | None = None, on_progress: OnProgress | None = None
) -> Plan:
    """A programme that makes the carrier of `stand` do `motion`, (12)-(13), or the reason why there is none.

    Ctrl-C gives the best so far; a second one during its verification skips that. UsageError: the method does not apply
    to this stand. MotionError: the bounds exclude the wanted winding.
    """
    options = options or PlanOptions()
    plus = requested_partition(stand, options)
    if options.winding is not None:
        motion = with_winding(motion, options.winding)
    whole = Budget(0, options.seconds)
    with_tables = motion.runup is not None and motion.periodic
    options = replace(options, seconds=whole.left(SEARCH if with_tables else 1.0))
    budget = Budget(options.steps, options.seconds_of_search)
    try:
        problem = Problem.of(stand, with_shortest_period(motion))
        first = preflight(problem)
    except StateError as error:
        return Plan("SINGULAR_ATTITUDE", None, (str(error),), (), ())
    if first.refusal is not None:
        return Plan("NO_PROGRAM", first.refusal.reason, (first.refusal.words,), tuple(first.warnings), ())
    if not motion.periodic:
        return plan_finite(problem, first, options, budget, on_progress, plus)
    improver = Improver.of(problem)
    found = search(
        problem, improver, first.bias, options.seed, budget, max(options.enough, options.keep), on_progress=on_progress
    )

    def say(doing: str) -> None:
        found.doing = doing
        if on_progress is not None:
            on_progress(found)

    after = AfterSearch(whole, say, options.verify)
    chosen = choose(improver, found)
    candidates = Candidates([(each, {}) for each in chosen], words=() if chosen else (not_found(found),))
    if options.method != "fourier" and chosen and not found.interrupted:
        from mahovik.use.plan.ocp.plan import periodic_ocp

        candidates = periodic_ocp(improver, chosen, options, plus, budget, on_progress)
        found.interrupted |= candidates.interrupted
        found.cut |= candidates.cut
    return _plan(problem, motion, first, found, candidates, budget.taken, options, after)


SEARCH = 0.5
"""Share of the given time for the search, if run-up and run-down follow it; they have the rest."""


@dataclass(frozen=True, eq=False)
class AfterSearch:
    """Work after the search: run-ups in the remaining time, then the verification without a time limit."""

    whole: Budget
    say: Callable[[str], None]
    verify: bool

    def complete(self, stand: Stand, motion: RequiredMotion, programme: Programme, seed: int) -> Programme:
        """The programme with its tables, verified."""
        programme = with_runup(stand, motion, programme, seed, self.whole, self.say)
        if not self.verify:
            return programme
        self.say("verifying")
        with defer_interrupt(self.whole.interrupt, again=True):
            return drop_refused_tables(certify(stand, motion, programme))


def _plan(
    problem: Problem,
    motion: RequiredMotion,
    first: Preflight,
    found: Search,
    candidates: Candidates[Candidate],
    steps: int,
    options: PlanOptions,
    after: AfterSearch,
) -> Plan:
    """The outcome of a search for `motion`, of which the problem may be one repeating part."""
    effort = {
        "seed": options.seed,
        "starts": found.starts,
        "steps": steps,
        "windings_tried": dict(found.tried),
        "found": len(found.found),
        "best_residual": float(found.best),
        "cut_by_time": found.cut,
        "objective_spread": [each.objective for each, _ in candidates.found],
    }
    if not candidates.found:
        return Plan(
            "NO_PROGRAM",
            candidates.reason,
            tuple(candidates.words),
            tuple(first.warnings),
            (),
            effort,
            found.interrupted,
        )
    programmes, refused = [], []
    for each, told in candidates.found:
        with defer_interrupt(after.whole.interrupt, again=True):
            programme = _programme(problem, motion, each, {"search": effort, **told})
        programme = after.complete(problem.stand, motion, programme, options.seed)
        wrong = failed_items(programme)
        if wrong:
            refused.append(f"a programme was found and refused by the verification: {wrong}")
        else:
            programmes.append((each, programme))
        if len(programmes) == options.keep or (programmes and after.whole.interrupted):
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
    """Message of a search without success; it proves nothing."""
    tried = ", ".join(f"{kind} {number}" for kind, number in found.tried.items()) or "none"
    ended = "cut by time" if found.cut else "interrupted" if found.interrupted else "out of budget"
    return (
        f"no programme was found (this does not prove that there is none): {found.starts} starts tried ({tried}), "
        f"best relative residual {found.best:.3g}, {ended}; try another seed, more time, another winding, a smaller "
        "motion or one more flywheel"
    )


def _programme(problem: Problem, motion: RequiredMotion, chosen: Candidate, told: Mapping[str, Any]) -> Programme:
    """The programme with its report."""
    own = repeat_motion(chosen.motion, round(motion.span / problem.motion.span))
    found = figures(problem, chosen.motion)
    report: dict[str, Any] = {
        "kind": chosen.kind,
        "objective": chosen.objective,
        "objective_parts": dict(chosen.parts),
        "bounds_used": chosen.used if has_bounds(motion.bounds) else None,
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
    return make_programme(problem.stand, motion, own.bias, tuple(int(n) for n in own.winding), course, report)
