"""Planning as a whole: preflight, search, choice, verification, report; of periodic and of finite motions."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from mahovik.core.motion.functions import Angles, Fourier, Samples
from mahovik.core.motion.programme import Programme
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.stand.model import Stand
from mahovik.errors import StateError
from mahovik.use.numeric.residual import linear, prescribe, torques
from mahovik.use.plan.certificate import (
    certify,
    drop_refused_tables,
    failed_items,
    make_programme,
    motor_warnings,
    peaks,
    regularity,
)
from mahovik.use.plan.finite import FiniteProblem, FiniteSolution, fit, search_finite, table_of
from mahovik.use.plan.improve import Candidate, Improver
from mahovik.use.plan.mean_pose import refuse_unplannable
from mahovik.use.plan.objective import Cost, Rows, exceeded_bounds, has_bounds
from mahovik.use.plan.outcome import Budget, OnProgress, Plan, PlanOptions, defer_interrupt
from mahovik.use.plan.preflight import Preflight, preflight
from mahovik.use.plan.problem import Periodic, Problem
from mahovik.use.plan.runup import shortcomings, with_runup
from mahovik.use.plan.search import Search, search, single
from mahovik.use.plan.starts import repeat_motion, with_shortest_period

SEARCH = 0.5
"""Share of the given time for the search, if run-up and run-down follow it; they have the rest."""
RESERVE = 5.0
"""s: for making exact what exceeds the bounds least, where nothing keeps them."""
_TIMES = 2000
"""Times at which peaks and bounds of a finite motion are evaluated."""


def plan_motion(
    stand: Stand, motion: RequiredMotion, options: PlanOptions | None = None, on_progress: OnProgress | None = None
) -> Plan:
    """A programme that makes the carrier of `stand` do `motion`, (12)-(13), or the reason why there is none.

    Ctrl-C gives the best so far; a second one during its verification skips that.
    MotionError: the bounds exclude the wanted winding.
    """
    options = options or PlanOptions()
    refuse_unplannable(stand, motion)
    whole = Budget(0, options.seconds)
    with_tables = motion.runup is not None and motion.periodic
    options = replace(options, seconds=whole.seconds_left(SEARCH if with_tables else 1.0))
    budget = Budget(options.steps, options.seconds)
    try:
        problem = Problem.of(stand, with_shortest_period(motion))
        first = preflight(problem)
    except StateError as error:
        return Plan("SINGULAR_ATTITUDE", None, (str(error),), (), ())
    if first.refusal is not None:
        return Plan("NO_PROGRAM", first.refusal.reason, (first.refusal.words,), tuple(first.warnings), ())
    say = on_progress or (lambda _: None)
    if motion.periodic:
        return _plan_periodic(problem, motion, first, options, budget, whole, say)
    return _plan_finite(problem, first, options, budget, say)


def _plan_periodic(
    problem: Problem,
    motion: RequiredMotion,
    first: Preflight,
    options: PlanOptions,
    budget: Budget,
    whole: Budget,
    progress: OnProgress,
) -> Plan:
    """A programme of a periodic motion; the problem may be one repeating part of it. `whole`: time with the run-ups.

    Run-ups have the time after the search, the verification has no limit.
    """
    improver = Improver.of(problem)
    if isinstance(options.start, Periodic):
        result = single(improver, options.start, budget)
    else:
        result = search(problem, improver, first.bias, options.seed, budget, options.enough, on_progress=progress)

    def say(doing: str) -> None:
        result.doing = doing
        progress(result)

    chosen = improver.choose(result.programmes, result.beyond, RESERVE)
    effort = _effort(result, options, budget) | {"objective_spread": [candidate.objective for candidate in chosen]}

    def programmes() -> Iterator[Programme]:
        for candidate in chosen:
            with defer_interrupt(whole.interrupt, again=True):
                programme = _periodic_programme(problem, motion, candidate, {"search": effort})
            programme = with_runup(problem.stand, motion, programme, options.seed, whole, say)
            if options.verify:
                say("verifying")
                with defer_interrupt(whole.interrupt, again=True):
                    programme = drop_refused_tables(certify(problem.stand, motion, programme))
            yield programme

    fewer = "another winding, a smaller motion or one more flywheel"
    words = () if chosen else (no_programme_message(result, fewer),)
    return _verified_plan(problem.stand, first, result, words, effort, programmes(), whole)


def _plan_finite(
    whole: Problem,
    first: Preflight,
    options: PlanOptions,
    budget: Budget,
    say: OnProgress,
) -> Plan:
    """A programme of a finite motion. The objective chooses among those found."""
    problem = FiniteProblem.from_problem(whole)
    cost = Cost.of(whole.mechanics, whole.motion.objective, 2.0 * np.pi / whole.motion.span)
    if isinstance(options.start, Samples):
        made = fit(problem, first.bias, options.start, budget)
        search = Search[FiniteSolution]([made] if made and made.residual < problem.tolerance else [], starts=1)
    else:
        search = search_finite(problem, first.bias, options.seed, budget, options.enough, say)
    reports = [_finite_report(problem, cost, solution) for solution in search.programmes]
    order = sorted(range(len(reports)), key=lambda k: (len(reports[k]["exceeded"]) > 0, reports[k]["objective"]))
    effort = _effort(search, options, budget) | {"objective_spread": [reports[k]["objective"] for k in order]}
    search.doing = "verifying"
    say(search)

    def programmes() -> Iterator[Programme]:
        for k in order:
            solved, report = search.programmes[k], {**reports[k], "search": effort}
            table, bias = table_of(problem, solved), solved.motion.bias
            programme = make_programme(whole.stand, whole.motion.name, whole.motion.span, bias, None, table, report)
            if options.verify:
                with defer_interrupt(budget.interrupt, again=True):
                    programme = certify(whole.stand, whole.motion, programme)
            yield programme

    few = whole.stand.hold is None and whole.N < 8  # two flywheels more than its rows keep I regular
    fewer = f"a smaller or slower motion or {'eight flywheels' if few else 'one more flywheel'}"
    words = () if search.programmes else (no_programme_message(search, fewer),)
    return _verified_plan(whole.stand, first, search, words, effort, programmes(), budget)


def _effort(search: Search[Any], options: PlanOptions, budget: Budget) -> dict[str, Any]:
    """Effort of a search, for the report."""
    return {
        "seed": options.seed,
        "starts": search.starts,
        "steps": budget.steps_taken,
        "windings_tried": dict(search.tried),
        "found": len(search.programmes),
        "best_residual": float(search.best),
        "cut_by_time": search.cut,
    }


def _verified_plan(
    stand: Stand,
    first: Preflight,
    search: Search[Any],
    words: tuple[str, ...],
    effort: dict[str, Any],
    programmes: Iterable[Programme],
    budget: Budget,
) -> Plan:
    """The plan of the first programme without objections of the verification; `words`: why there is none to verify."""
    refused = list(words)
    for programme in programmes:
        if wrong := failed_items(programme):
            refused.append(f"a programme was found and refused by the verification: {wrong}")
            continue
        warnings = (*first.warnings, *motor_warnings(stand, programme.report))
        over = (*programme.report["exceeded"], *shortcomings(programme))
        interrupted = search.interrupted or budget.interrupted
        return Plan("OK_LIMIT" if over else "OK", None, over, warnings, (programme,), effort, interrupted)
    warnings = (*first.warnings, *first.hint)
    interrupted = search.interrupted or budget.interrupted
    return Plan("NO_PROGRAM", "SEARCH", tuple(refused), warnings, (), effort, interrupted)


def no_programme_message(search: Search[Any], hint: str) -> str:
    """Message of a search without success, which proves nothing; `hint`: what else may help."""
    tried = ", ".join(f"{kind} {number}" for kind, number in search.tried.items())
    near = search.beyond[0].exceeded_bounds[:1] if search.beyond else ()
    bound = "".join(f"; the nearest attempt exceeds a bound, {exceeded.words}" for exceeded in near)
    return (
        f"no programme was found (this does not prove that there is none): {search.starts} starts tried"
        f"{f' ({tried})' if tried else ''}, best relative residual {search.best:.3g}, {search.end_reason}{bound}; "
        f"try {'wider bounds, ' if bound else ''}another seed, more time, {hint}"
    )


def _periodic_programme(
    problem: Problem, motion: RequiredMotion, chosen: Candidate, more: Mapping[str, Any]
) -> Programme:
    """The programme with its report."""
    periodic = repeat_motion(chosen.motion, round(motion.span / problem.motion.span))
    report: dict[str, Any] = {
        "kind": chosen.kind,
        "objective": chosen.objective,
        "objective_parts": dict(chosen.parts),
        "bounds_used": chosen.utilisation if has_bounds(motion.bounds) else None,
        "exceeded": [bound.words for bound in chosen.exceeded_bounds],
        "harmonics": periodic.H,
        **figures(problem, chosen.motion),
        **more,
    }
    course = Fourier(np.array(periodic.mean), np.array(periodic.cos), np.array(periodic.sin))
    winding = tuple(int(n) for n in periodic.winding)
    return make_programme(problem.stand, motion.name, motion.span, periodic.bias, winding, course, report)


def figures(problem: Problem, motion: Periodic) -> dict[str, Any]:
    """Figures of a periodic motion for a report, on a grid 20 times finer than its harmonics need."""
    grid = problem.grid(20 * (2 * motion.H + 2), motion.H, 0.5)
    angles = motion.at(grid.basis)
    tau = torques(prescribe(problem.mechanics, grid.course, motion.bias), *angles)
    regular = regularity(problem.mechanics, angles.phi, periodic=True)
    return {"residual": problem.relative(motion), **peaks(angles, tau), **regular}


def _finite_report(problem: FiniteProblem, cost: Cost, solved: FiniteSolution) -> dict[str, Any]:
    """Figures of a finite programme."""
    motion, span = solved.motion, problem.motion.span
    t = np.linspace(0.0, span, _TIMES)
    grid = problem.grid_of(solved.space, t)
    angles: Angles = motion.at(grid.basis)
    at = linear(prescribe(problem.mechanics, grid.course, motion.bias), *angles)
    swing = angles.phi - angles.phi.mean(axis=0)
    parts = cost.value(angles, np.zeros(problem.N), Rows.torque(at))
    over = exceeded_bounds(problem.motion.bounds, problem.stand, t, angles, swing, at.tau, motion.bias)
    return {
        "kind": "finite",
        "objective": float(sum(parts.values())),
        "objective_parts": parts,
        "exceeded": [bound.words for bound in over],
        "residual": solved.residual,
        "degree": solved.degree,
        **peaks(angles, at.tau),
        "end_speed": angles.phi_dot[-1],
        **regularity(problem.mechanics, angles.phi, periodic=False),
    }
