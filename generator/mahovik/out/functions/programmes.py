"""`plan`: motions of the flywheels that make the carrier move as required; `verify_programme`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, get_args

import numpy as np

from mahovik.core.motion.motion_file import motion_of_slew
from mahovik.core.motion.programme import Programme as CoreProgramme
from mahovik.core.motion.programme import programme_text
from mahovik.core.motion.required import RequiredMotion, Slew
from mahovik.core.stand.model import Stand as CoreStand
from mahovik.errors import UsageError
from mahovik.nearest import suggestion
from mahovik.out.api.stands import Stand
from mahovik.out.arguments import (
    Keys,
    Number,
    StandGiven,
    motion_of,
    programme_of,
    required_of,
    time_limit,
)
from mahovik.out.functions.table import Column, Table
from mahovik.out.notices import OnProgress, Progress, tell, warn
from mahovik.use.plan import Plan as CorePlan
from mahovik.use.plan import PlanOptions, plan_motion
from mahovik.use.plan.held import refuse_unplannable
from mahovik.use.plan.smoothing import smoothing_warnings

if TYPE_CHECKING:
    from mahovik.out.report.plots import Panel
    from mahovik.proof.verify.check import Check

_KINDS = (("phi", "rad"), ("phi_dot", "rad/s"), ("phi_ddot", "rad/s2"))

_FIGURES = (
    "residual", "simulation_error", "objective", "least_singular_value", "det_I_sign_changes", "least_duration",
    "strayed",
)  # fmt: skip
_EFFECT = (("angle", "rad"), ("shift", "m"))

ROWS = 400
"""Rows of a programme's table."""

Change = tuple[str, str, float, float]
Method = Literal["fourier", "ocp"]
MotionGiven = RequiredMotion | Keys | str | Path
ProgrammeGiven = CoreProgramme | Keys | str | Path


class Programme(Table):
    """The motion of the flywheels over one period, or over its duration: a row per time, 400 of them.

    `at(t)` gives phi, phi_dot, phi_ddot (M, N) at any times; `report` the figures of the search and the verification.
    """

    index = "t"

    def __init__(self, stand: CoreStand, motion: RequiredMotion | None, programme: CoreProgramme) -> None:
        self.stand, self.motion, self.programme = stand, motion, programme

    @property
    def columns(self) -> tuple[Column, ...]:
        t = np.linspace(0.0, self.programme.span, ROWS + 1)
        found = self.programme.at(t)
        columns = [Column("t", "s", t)]
        for s, name in enumerate(self.programme.flywheels):
            for (kind, unit), values in zip(_KINDS, found, strict=True):
                columns.append(Column(f"{kind} {name}", unit, values[:, s]))
        return tuple(columns)

    @property
    def report(self) -> Mapping[str, Any]:
        """Figures: residual, simulation error, peaks, objective."""
        return self.programme.report

    @property
    def figures(self) -> tuple[str, ...]:
        """The report in lines of text."""
        own = self.report
        first = f"slew, {own['goal']}, {own['duration']:.6g} s" if own["kind"] == "slew" else str(own["kind"])
        if self.programme.periodic:
            first += f", winding {list(self.programme.winding)}"
        lines = [first, ", ".join(f"{key} {own[key]:.3g}" for key in _FIGURES if own.get(key) is not None)]
        lines += own.get("hardest", ())
        if own.get("through_zero"):
            lines.append(f"passes zero speed: {', '.join(own['through_zero'])}")
        if (effect := own.get("unbalance")) is not None:
            shown = (f"{name} {key} {effect[name][key]:.3g} {unit}" for name, unit in _EFFECT for key in effect[name])
            lines.append(f"unbalance adds: {', '.join(shown)}")
        if (solved := own.get("ocp")) is not None:
            J = f"J {solved['objective_of_start']:.6g} of the start, {solved['objective']:.6g} now"
            lines.append(f"IPOPT: {solved['ipopt']}, {solved['iterations']} iterations; {J}")
        for key in ("runup", "rundown"):
            if "deviation" in own.get(key, {}):
                most = (f"{part} {x['largest']:.3g}" for part, x in own[key]["deviation"].items())
                lines.append(f"{key}: terminal error {own[key]['terminal_error']:.2g}, deviation {', '.join(most)}")
        return tuple(lines)

    def at(self, t: Any) -> tuple[Any, Any, Any]:
        """phi (rad), phi_dot, phi_ddot (M, N) at times t (M, s)."""
        phi, phi_dot, phi_ddot = self.programme.at(np.atleast_1d(np.asarray(t, dtype=np.float64)))
        return phi, phi_dot, phi_ddot

    def save(self, path: str | Path) -> None:
        """Write it as a programme file. Raises UsageError."""
        from mahovik.writing import write

        write(Path(path), programme_text(self.programme))

    def __repr__(self) -> str:
        own = self.programme
        size = f"{len(own.flywheels)} flywheels, {'period' if own.periodic else 'duration'} {own.span:g} s"
        return f"<Programme of {own.stand} for {own.motion}: {size}>"


class Plan(Table):
    """Outcome of planning: a row per flywheel with the peaks of the best programme; none without one.

    `status` is OK, OK_LIMIT (a bound is exceeded), NO_PROGRAM or SINGULAR_ATTITUDE; `reason` and `words` say why.
    `stand` is the one planned for, `changes` (path, unit, before, after) what is other than in the one given.
    """

    index = "flywheel"

    def __init__(
        self, stand: Stand, motion: RequiredMotion | Slew, result: CorePlan, changes: Sequence[Change] = ()
    ) -> None:
        self.stand, self.motion, self.result, self.changes = stand, motion, result, tuple(changes)

    @property
    def columns(self) -> tuple[Column, ...]:
        if not self.result.programmes:
            return ()
        best: Any = self.result.programmes[0]
        return (
            Column("flywheel", "", np.array(best.flywheels, dtype=object)),
            Column("peak_speed", "rad/s", np.asarray(best.report["peak_speed"])),
            Column("peak_acceleration", "rad/s2", np.asarray(best.report["peak_acceleration"])),
            Column("peak_torque", "N m", np.asarray(best.report["peak_torque"])),
        )

    @property
    def status(self) -> str:
        """OK, OK_LIMIT, NO_PROGRAM, SINGULAR_ATTITUDE."""
        return self.result.status

    @property
    def reason(self) -> str | None:
        """Why there is none: proven by the preflight, or SEARCH."""
        return self.result.reason

    @property
    def words(self) -> tuple[str, ...]:
        """The reason, or the exceeded bounds, a line each."""
        return self.result.words

    @property
    def warnings(self) -> tuple[str, ...]:
        """Further remarks, a line each."""
        return self.result.warnings

    @property
    def effort(self) -> Mapping[str, Any]:
        """Starts, steps, windings tried, best residual, seed."""
        return self.result.effort

    @property
    def interrupted(self) -> bool:
        """Whether Ctrl-C ended the search."""
        return self.result.interrupted

    @property
    def programme(self) -> Programme:
        """The programme. Raises UsageError without one."""
        if not self.result.programmes:
            raise UsageError(f"{self.status} {self.reason or ''}: {'; '.join(self.words)}")
        first = self.result.programmes[0]
        return Programme(self.stand, _of_course(self.motion, first), first)

    def _panels(self) -> Sequence[Panel]:
        return self.programme._panels()

    def __repr__(self) -> str:
        return f"<Plan of {self.stand.name} for {self.motion.name}: {self.status}>"


def plan(
    stand: StandGiven,
    motion: MotionGiven | Slew,
    *,
    free: Sequence[str] = (),
    seconds: Number | None = None,
    seed: int = 0,
    method: Method = "fourier",
    progress: OnProgress | None = None,
) -> Plan:
    """Plan a programme: motions of the flywheels that make the carrier move exactly as required; (12), (13).

    free       paths of numbers of the stand that move too, as "w*.position"; `stand` of the result has them
    seconds    limits the search, also as "1 min"; None: a budget of starts and steps alone
    method     "fourier", or from it "ocp" by IPOPT

    Numbers that are free stay within `free` of the motion, or 10 % of their value. A slew, a motion file of `type`
    slew, has one programme and no search: seconds and seed do nothing.

    Programmes are verified by the literal reference. Ctrl-C gives the best so far. Raises StandError, MotionError,
    UsageError.
    """
    from mahovik.use.plan.free import plan_free

    if method not in get_args(Method):
        raise UsageError(f'method: unknown "{method}"{suggestion(method, get_args(Method))}')
    own, options = Stand.of(stand), PlanOptions(seed, time_limit("seconds", seconds))
    required = required_of(motion, own)

    def on_progress(state: Any) -> None:
        tell(progress, Progress(state.words))

    if isinstance(required, Slew):
        from mahovik.use.plan.slew import plan_slew

        if method != "fourier" or free:
            raise UsageError("method, free: not for a slew, whose course is found with its programme")
        return Plan(own, required, plan_slew(own, required, tell=lambda words: tell(progress, Progress(words))))
    refuse_unplannable(own, required)
    for line in smoothing_warnings(own, required):  # before the search, which may be long
        warn(line)
    if free and method == "ocp":
        raise UsageError("method ocp: judges plans of a stand as it is; expected no free beside it")
    if free:
        found = plan_free(own, own.to_dict(), required, [free] if isinstance(free, str) else free, options, on_progress)
        made = own if found.document is None else Stand.from_dict(found.document, own.name)
        return Plan(made, required, found.plan, found.changes)
    if method == "ocp":
        from mahovik.use.plan.ocp import plan_ocp

        return Plan(own, required, plan_ocp(own, required, options, on_progress))
    return Plan(own, required, plan_motion(own, required, options, on_progress))


def _of_course(motion: RequiredMotion | Slew, programme: CoreProgramme) -> RequiredMotion:
    """The motion; of a slew, with the course that the programme keeps."""
    return motion_of_slew(motion, programme) if isinstance(motion, Slew) else motion


class Verdict(Table):
    """Verdict on a programme: a row per item, with what was found and what is accepted; `passed` if all are right."""

    index = "item"

    def __init__(self, stand: CoreStand, motion: RequiredMotion, findings: Sequence[Check]) -> None:
        self.stand, self.motion, self.findings = stand, motion, tuple(findings)

    @property
    def columns(self) -> tuple[Column, ...]:
        return (
            Column("item", "", np.array([item.quantity for item in self.findings], dtype=object)),
            Column("found", "", np.array([item.value for item in self.findings])),
            Column("accepted", "", np.array([item.limit for item in self.findings])),
            Column("passed", "", np.array([not item.failed for item in self.findings])),
            Column("words", "", np.array([item.words for item in self.findings], dtype=object)),
        )

    @property
    def passed(self) -> bool:
        """Whether every item is right."""
        return not any(item.failed for item in self.findings)

    def __repr__(self) -> str:
        failed = [item.quantity for item in self.findings if item.failed]
        return f"<Verdict on {self.motion.name}: {'passed' if self.passed else 'refused, ' + ', '.join(failed)}>"


def verify_programme(
    stand: StandGiven,
    motion: MotionGiven | Slew,
    programme: ProgrammeGiven | Programme | Plan,
    *,
    tolerance: float | None = None,
    against: str | Path | None = None,
    name: str = "programme",
    progress: OnProgress | None = None,
) -> Verdict:
    """Verify that a programme makes the carrier move as required, by the literal reference alone.

    tolerance  of the relative residual; None: 1e-6, with damping of V|V| 1e-5
    against    folder of the C that `generate --programme` wrote: each of its functions is judged too; `name`: of that C

    Raises StandError, MotionError, ProgrammeError, ToolchainError.
    """
    from mahovik.proof.verify.programme.verification import ProgrammeCase
    from mahovik.proof.verify.programme.verification import verify_programme as judged

    own = Stand.of(stand)
    found = given_programme(programme)
    required = _of_course(motion, found) if isinstance(motion, Slew) else motion_of(motion, own, found)
    tell(progress, Progress("by the reference"))
    findings = judged(own, required, found, tolerance=tolerance)
    if against is not None and not all(item.failed for item in findings):
        from mahovik.proof.verify.exported import verify_compiled

        findings += verify_compiled(own, ProgrammeCase.of(own, required, found, tolerance), Path(against), name)
    return Verdict(own, required, findings)


def given_programme(given: ProgrammeGiven | Programme | Plan) -> CoreProgramme:
    """The programme that a function is given; of a plan the best. Raises ProgrammeError, UsageError without one."""
    if isinstance(given, Plan):
        given = given.programme
    return given.programme if isinstance(given, Programme) else programme_of(given)
