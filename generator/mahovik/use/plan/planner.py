"""Planning as a whole: preflight, search, choice, verification, report; of periodic and of finite motions."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from mahovik.core.motion.functions import Fourier, Samples
from mahovik.core.motion.motion_file import NO_SLEW
from mahovik.core.motion.programme import Programme
from mahovik.core.motion.required import RequiredMotion, Slew
from mahovik.core.stand.coordinates import coordinates_of
from mahovik.core.stand.model import Stand
from mahovik.errors import MotionError, StateError
from mahovik.use.numeric.residual import prescribe, torques
from mahovik.use.plan.improve import TIMES, Candidate, Collocator, Improver, table_of
from mahovik.use.plan.objective import has_bounds
from mahovik.use.plan.outcome import (
    Budget,
    OnProgress,
    Plan,
    PlanOptions,
    certify,
    defer_interrupt,
    drop_refused_tables,
    failed_items,
    motor_shortage,
    motor_warnings,
    peaks,
    regularity,
)
from mahovik.use.plan.preflight import preflight
from mahovik.use.plan.problem import FlywheelMotion, Problem, SplineSpace
from mahovik.use.plan.runup import shortcomings, with_runup
from mahovik.use.plan.search import Search, repeat_motion, search, single, with_shortest_period

SEARCH = 0.5
"""Share of the given time for the search, if run-up and run-down follow it; they have the rest."""
RESERVE = 5.0
"""s: for making exact what exceeds the bounds least, where nothing keeps them."""


def plan_motion(
    stand: Stand, motion: RequiredMotion, options: PlanOptions | None = None, on_progress: OnProgress | None = None
) -> Plan:
    """A programme that makes the carrier of `stand` do `motion`, (12)-(13), or the reason why there is none.

    Ctrl-C gives the best so far; a second one during its verification skips that.
    MotionError: the bounds exclude the wanted winding.
    """
    options = options or PlanOptions()
    refuse_unplannable(stand, motion)
    whole = Budget(0, options.seconds)  # run-ups have what the search leaves of it, the verification has no limit
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
    refiner = Improver.of(problem) if motion.periodic else Collocator.of(problem, first.bias)
    if options.start is None:
        result = search(refiner, first.bias, options.seed, budget, options.enough, on_progress=say)
    else:
        result = single(refiner, options.start, budget)
    chosen = refiner.choose(result.programmes, result.beyond, RESERVE)
    effort = {
        "seed": options.seed,
        "starts": result.starts,
        "steps": budget.steps_taken,
        "windings_tried": dict(result.tried),
        "found": len(result.programmes),
        "best_residual": float(result.best),
        "cut_by_time": result.cut,
        "objective_spread": [candidate.objective for candidate in chosen],
    }

    def now(doing: str) -> None:
        result.doing = doing
        say(result)

    refused = [] if chosen else [no_programme_message(result, _fewer(problem))]
    for candidate in chosen:
        with defer_interrupt(whole.interrupt, again=True):
            programme = _programme(problem, motion, candidate, effort)
        programme = with_runup(stand, motion, programme, options.seed, whole, now)
        if options.verify:
            now("verifying")
            with defer_interrupt(whole.interrupt, again=True):
                programme = drop_refused_tables(certify(stand, motion, programme))
        interrupted = result.interrupted or whole.interrupted
        if wrong := failed_items(programme):
            refused.append(f"a programme was found and refused by the verification: {wrong}")
            continue
        warnings = (*first.warnings, *motor_warnings(stand, programme.report))
        over = (*programme.report["exceeded"], *shortcomings(programme))
        return Plan("OK_LIMIT" if over else "OK", None, over, warnings, (programme,), effort, interrupted)
    interrupted = result.interrupted or whole.interrupted
    return Plan("NO_PROGRAM", "SEARCH", tuple(refused), (*first.warnings, *first.hint), (), effort, interrupted)


def refuse_unplannable(stand: Stand, required: RequiredMotion | Slew) -> None:
    """Refuse what is planned for free carriers alone. Raises StandError, MotionError."""
    if stand.hold is None:
        return
    coordinates = coordinates_of(stand)
    if isinstance(required, Slew):
        raise MotionError([f"{required.name}: type: {NO_SLEW}"])
    if len(required.mean) != coordinates.count:
        raise MotionError([f"{required.name}: is of another carrier; expected rows of {coordinates.words}"])


def _fewer(problem: Problem) -> str:
    """What may help where a search finds nothing."""
    if problem.motion.periodic:
        return "another winding, a smaller motion or one more flywheel"
    few = problem.stand.hold is None and problem.N < 8  # two flywheels more than its rows keep I regular
    return f"a smaller or slower motion or {'eight flywheels' if few else 'one more flywheel'}"


def no_programme_message(search: Search, hint: str) -> str:
    """Message of a search without success, which proves nothing; `hint`: what else may help."""
    tried = ", ".join(f"{kind} {number}" for kind, number in search.tried.items())
    near = search.beyond[0].exceeded_bounds[:1] if search.beyond else ()
    bound = "".join(f"; the nearest attempt exceeds a bound, {exceeded.words}" for exceeded in near)
    return (
        f"no programme was found (this does not prove that there is none): {search.starts} starts tried"
        f"{f' ({tried})' if tried else ''}, best relative residual {search.best:.3g}, {search.end_reason}{bound}; "
        f"try {'wider bounds, ' if bound else ''}another seed, more time, {hint}"
    )


def _programme(problem: Problem, motion: RequiredMotion, chosen: Candidate, effort: Mapping[str, Any]) -> Programme:
    """The programme with its report."""
    report: dict[str, Any] = {
        "kind": chosen.kind if chosen.space is None else "finite",
        "objective": chosen.objective,
        "objective_parts": dict(chosen.parts),
        "bounds_used": chosen.utilisation if has_bounds(motion.bounds) else None,
        "exceeded": [bound.words for bound in chosen.exceeded_bounds],
        "residual": chosen.residual,
        **figures(problem, chosen.motion, chosen.space),
        "search": effort,
    }
    winding: tuple[int, ...] | None = None
    course: Fourier | Samples
    if chosen.space is None:
        periodic = repeat_motion(chosen.motion, round(motion.span / problem.motion.span))
        course = Fourier(periodic.mean, periodic.waves[:, 1::2].T.copy(), periodic.waves[:, 2::2].T.copy())
        winding, report["harmonics"] = tuple(int(n) for n in periodic.winding), periodic.H
    else:
        course, report["degree"] = table_of(problem, chosen.motion, chosen.space), chosen.space.degree
    return Programme.of(problem.stand, motion.name, motion.span, chosen.motion.bias, winding, course, report)


def figures(problem: Problem, motion: FlywheelMotion, space: SplineSpace | None = None) -> dict[str, Any]:
    """Peaks and regularity of a motion for a report, of a periodic one 20 times finer than its harmonics need."""
    if space is None:
        grid = problem.grid(20 * (2 * motion.H + 2), 2 * motion.H + 1, 0.5)
    else:
        grid = problem.grid_of(space, np.linspace(0.0, space.span, TIMES))
    angles = motion.at(grid.basis)
    tau = torques(prescribe(problem.mechanics, grid.course, motion.bias), *angles)
    result = {**peaks(angles, tau), **motor_shortage(problem.stand, angles.phi_dot, tau)}
    result |= regularity(problem.mechanics, angles.phi, periodic=space is None)
    return result if space is None else {**result, "end_speed": angles.phi_dot[-1]}
