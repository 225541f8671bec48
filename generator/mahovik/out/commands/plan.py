"""`plan`: flywheel motions that make the carrier move as required, of a stand whose numbers may move too."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import numpy as np

from mahovik.contract.quantities import RPM
from mahovik.errors import UsageError
from mahovik.out.arguments import (
    FileGiven,
    FilePath,
    Progressing,
    Seconds,
    StandGiven,
    command,
    output_format,
    programme_of,
    required_of,
    text_of_keys,
    time_limit,
)
from mahovik.out.notices import Progress, notify
from mahovik.out.plots import Line, Panel
from mahovik.out.result import Column, Result, column
from mahovik.writing import write

if TYPE_CHECKING:
    from mahovik.core.motion.required import RequiredMotion, Slew
    from mahovik.out.api.stands import Stand
    from mahovik.use.plan.outcome import Plan

_FIGURES = (
    "residual", "simulation_error", "objective", "least_singular_value", "det_I_sign_changes", "duration",
    "least_duration", "strayed",
)  # fmt: skip
FORMATS = (".json", ".csv", ".parquet", ".svg", ".png")
"""Ends of names that `output` may have: .json takes the programme, the others its figures."""

_UNITS = {"duration": "s", "least_duration": "s", "strayed": "m"}


@command(needs={"free": ("stand_",)}, excludes={"method=ocp": ("free",)})
def plan(
    stand: StandGiven,
    *,
    motion: FileGiven,
    free: Annotated[str | Sequence[str], "KEYS"] = (),
    stand_: FilePath | None = None,
    method: Literal["fourier", "ocp"] = "fourier",
    time: Seconds | None = None,
    seed: int = 0,
    output: FilePath | None = None,
    progress: Progressing = None,
) -> Result:
    """Find a programme that moves the carrier as required.

    Flywheel motions that make the carrier move exactly as required, (12), (13). A motion out of reach is refused at
    once, with what is missing. Programmes are verified by the literal reference. Ctrl-C gives the best so far. A slew
    has one programme and no search.

    With --free numbers of the stand move too, inside `free` of the motion file, others by 10 % of their value. In
    Python `programme` and `stand` of the result are the keys of their files, which every function takes.

    Exit status: 0 a programme inside the bounds; 1 none, or a bound is exceeded; 2 bad input; 130 Ctrl-C.

    Args:
        stand: the stand file.
        motion: read the required motion, or a slew, from this file.
        free: move numbers of the stand too: paths, as w*.position; commas part several.
        stand_: write the stand that results of free numbers to this file, .toml; needed beside a programme's file.
        method: plan by fourier; or solve (13) from there as it is printed, by IPOPT, as its judge.
        time: limit the search, s or "1 min"; run-ups after it, if any, have half of the time.
        seed: draw the starts from this seed.
        output: write the programme to this file, .json; or its figures, .csv or .parquet, or a picture, .svg or .png.

    Raises:
        MotionError: the motion file is refused, or a free number has no bounds.
        UsageError: a path leads to no number; the method does not apply to the stand.
    """
    from mahovik.out.api.stands import Stand
    from mahovik.out.identify.free import stand_text
    from mahovik.use.plan.outcome import PlanOptions

    keys = [key for text in ([free] if isinstance(free, str) else free) for key in text.split(",")]
    read = [source for source in (stand, motion) if isinstance(source, str | Path)]
    if stand_ is not None:
        output_format("stand_", stand_, read, (".toml",))
    form = "" if output is None else output_format("output", output, read, FORMATS)
    if keys and form == ".json" and stand_ is None:
        raise UsageError(
            "stand_: missing, expected a file for the stand with the moved numbers: the programme is of it"
        )
    machine, options = Stand.of(stand), PlanOptions(seed, time_limit("time", time))
    required = required_of(motion, machine)
    result, made, changes = _planned(
        machine, required, keys, method, options, lambda words: notify(progress, Progress(words))
    )
    programme = _programme(result)
    answer = _result(made, required, result, programme, changes)
    if programme is None:
        return answer
    if stand_ is not None:
        write(Path(stand_), stand_text(stand, machine, made, [change[0] for change in changes]))
    if output is not None and form == ".json":
        write(Path(output), json.dumps(programme, indent=1) + "\n")
    elif output is not None:
        answer.save(output)
    return answer


def _planned(
    stand: Stand, required: RequiredMotion | Slew, keys: Sequence[str], method: str, options: Any, say: Any
) -> tuple[Plan, Stand, Sequence[tuple[str, str, float, float]]]:
    """The plan, the stand that it is for, and the numbers that moved."""
    from mahovik.core.motion.required import Slew
    from mahovik.use.plan.planner import plan_motion, refuse_unplannable

    def on_progress(state: Any) -> None:
        say(state.words)

    refuse_unplannable(stand, required)
    if isinstance(required, Slew):
        from mahovik.use.plan.slew import plan_slew

        if method != "fourier" or keys:
            raise UsageError("method, free: not for a slew, whose course is found with its programme")
        return plan_slew(stand, required, say=say), stand, ()
    if keys:
        from mahovik.use.plan.free import plan_free

        free_plan = plan_free(stand, stand.to_dict(), required, keys, options, on_progress)
        made = stand if free_plan.document is None else type(stand).from_dict(free_plan.document, stand.name)
        return free_plan.plan, made, free_plan.changes
    if method == "ocp":
        from mahovik.use.plan.ocp import plan_ocp

        return plan_ocp(stand, required, options, on_progress), stand, ()
    return plan_motion(stand, required, options, on_progress), stand, ()


def _programme(plan: Plan) -> dict[str, Any] | None:
    """Keys of the programme file; None: there is none."""
    from mahovik.core.motion.programme import programme_text

    return dict(json.loads(programme_text(plan.programmes[0]))) if plan.programmes else None


def _result(
    stand: Stand,
    required: RequiredMotion | Slew,
    plan: Plan,
    programme: Mapping[str, Any] | None,
    changes: Sequence[tuple[str, str, float, float]],
) -> Result:
    """A row a flywheel, the figures of the programme, and the numbers that moved."""
    report: Mapping[str, Any] = {} if programme is None else programme["report"]
    columns: list[Column] = []
    if programme is not None:
        torque = "peak_motor_torque" if report["kind"] == "slew" else "peak_torque"
        units = {"peak_speed": "rad/s", "peak_acceleration": "rad/s2", torque: "N m"}
        columns = [column("flywheel", "", programme["flywheels"])]
        columns += [column(name, unit, report[name]) for name, unit in units.items()]
    moved = [column(name, "", [change[k] for change in changes]) for k, name in enumerate(_MOVED)] if changes else []
    kind = {"kind": report.get("kind"), "winding": None if programme is None else programme.get("winding")}
    cut = ["warning: the time cut the search: another run may find more"] if plan.effort.get("cut_by_time") else []
    keys = json.loads(text_of_keys(stand.to_dict(), schema=False)) if changes else None
    return Result(
        f"programme of {stand.name} for {required.name}",
        columns,
        rows="flywheels",
        meta={
            "status": plan.status, "reason": plan.reason, **kind,
            **{name: report.get(name) for name in _FIGURES}, "through_zero": report.get("through_zero"),
            "changes": Result("numbers of the stand", moved, rows="changes"), "interrupted": plan.interrupted,
            "effort": dict(plan.effort), "programme": programme, "stand": keys,
        },
        units=_UNITS,
        messages=[*(f"warning: {line}" for line in plan.warnings), *cut, *plan.words, *_details(report)],
        ok=plan.status == "OK",
        details=("interrupted", "effort", "programme", "stand", *(["winding"] if kind["kind"] == "slew" else [])),
        drawings=[] if programme is None else [_speeds(programme)],
    )  # fmt: skip


_MOVED = ("path", "unit", "before", "after")


def _details(report: Mapping[str, Any]) -> list[str]:
    """What a slew takes of the limits, how (13) was solved, and the run-ups."""
    lines = list(report.get("hardest", ()))
    if (solved := report.get("ocp")) is not None:
        J = f"J {solved['objective_of_start']:.6g} of the start, {solved['objective']:.6g} now"
        lines.append(f"IPOPT: {solved['ipopt']}, {solved['iterations']} iterations; {J}")
    for key in ("runup", "rundown"):
        if "deviation" in report.get(key, {}):
            most = (f"{part} {x['largest']:.3g}" for part, x in report[key]["deviation"].items())
            lines.append(f"{key}: terminal error {report[key]['terminal_error']:.2g}, deviation {', '.join(most)}")
    return lines


def _speeds(keys: Mapping[str, Any]) -> Panel:
    """The speeds of the flywheels over the period, or the duration."""
    programme = programme_of(keys)
    t = np.linspace(0.0, programme.span, 401)
    speeds = zip(programme.flywheels, RPM * programme.at(t).phi_dot.T, strict=True)
    lines = [Line(name, t, y, k) for k, (name, y) in enumerate(speeds)]
    return Panel("speed of the flywheels, rpm", tuple(lines), height=1.6)
