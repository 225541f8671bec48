"""`report`: the page on a stand: its motion, bodies, modes, vibration, limits, requirements, verification, cost."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from html import escape
from itertools import groupby
from pathlib import Path

import numpy as np
from markupsafe import Markup

from mahovik.contract.quantities import RPM
from mahovik.core.lower.program import lower
from mahovik.core.motion.motion_file import load_motion
from mahovik.core.motion.programme import Programme, load_programme
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.program.cost import cost
from mahovik.core.program.types import DOUBLE
from mahovik.core.stand.laws import body_laws, carrier_laws
from mahovik.core.stand.model import Carrier, Instrument
from mahovik.core.stand.summary import Summary, summarize
from mahovik.errors import CheckError, MahovikError, StateError, UsageError
from mahovik.out.api.stands import Stand
from mahovik.out.arguments import StandGiven
from mahovik.out.commands.modes import modes
from mahovik.out.functions.evidence import verify
from mahovik.out.functions.jitter import jitter
from mahovik.out.notices import OnProgress, Progress, tell
from mahovik.out.report.page import Part, Row, figure, page, table
from mahovik.out.report.plot.campbell import panel as campbell_panel
from mahovik.out.report.plot.draw import require as require_drawing
from mahovik.out.report.plot.programme import panels as programme_panels
from mahovik.out.report.plot.response import orders_panel
from mahovik.out.report.plot.run import SUFFIXES, identity, read
from mahovik.out.report.plot.run import panels as run_panels
from mahovik.out.report.stand.drawing import drawing
from mahovik.out.report.stand.run import Run, refuse_foreign_run
from mahovik.out.result import Result
from mahovik.proof.verify.programme.verification import motion_check, stand_check
from mahovik.use.vibration.campbell import campbell
from mahovik.use.vibration.growth import compare_growth
from mahovik.use.vibration.scene import Scene
from mahovik.use.vibration.speeds import read_speeds
from mahovik.use.vibration.sweep import sweep_outputs
from mahovik.use.vibration.view import ARCSEC, REACTION, find_view
from mahovik.writing import format_of, write

STATES = 16
"""Random and extreme states at which the C is judged; `mahovik verify` takes more."""

STEPS = 31
"""Speeds of a sweep, rest among them."""

MOST_POINTS = 3
"""Points whose vibration is shown where none is asked for."""

STILL = 1e-10
"""m/s2, N: less than this is rounding."""

MOST_ROWS = 12
"""Rows of a table of modes or of verdicts; of more the worst are shown."""

FAILED = Markup('<span class="bad">failed</span>')

COSTLY = ("forward", "torque", "coupled", "inverse", "inverse_fast", "momentum", "step", "prepare")
"""Functions whose operations are shown, where the stand has them."""


@dataclass(frozen=True)
class Subject:
    """What a page is about: the stand, its file's name, and what was given besides; `""` and None: nothing.

    at       points, instruments, "carrier" or "hold.reaction" whose vibration is shown
    require  limits of the angle of the first of them, "rms 0.1 arcsec"
    """

    stand: Stand
    file: str
    run: Run | None = None
    programme: Programme | None = None
    programme_file: str = ""
    motion: RequiredMotion | None = None
    motion_file: str = ""
    at: tuple[str, ...] = ()
    require: tuple[str, ...] = ()

    @property
    def files(self) -> list[tuple[str, str]]:
        """Kind and name of each file that the page is made from."""
        run = "" if self.run is None else self.run.source
        given = (("stand", self.file), ("run", run), ("programme", self.programme_file), ("motion", self.motion_file))
        return [(kind, name) for kind, name in given if name]


def gather(
    stand: Stand,
    file: str,
    run: Path | None = None,
    programme: Path | None = None,
    motion: Path | None = None,
    at: Sequence[str] = (),
    require: Sequence[str] = (),
) -> Subject:
    """What a page is about, read from files; nothing is computed yet.

    Raises UsageError, ProgrammeError, MotionError: a file that cannot be read, or of another stand or motion.
    """
    if motion is not None and programme is None:
        raise UsageError(f"--motion {motion}: goes with --programme P.json, which is missing")
    course = None if programme is None else load_programme(programme)
    required = None if motion is None else load_motion(motion, stand, course)
    if course is not None:
        checks = [stand_check(stand, course), *([] if required is None else [motion_check(required, course)])]
        for check in checks:
            if check.failed:
                raise UsageError(f"--programme {programme}: {check.words}")
    named = ("" if path is None else path.name for path in (programme, motion))
    return Subject(
        stand, file, None if run is None else _run(run, stand), course, next(named), required, next(named),
        tuple(at), tuple(require),
    )  # fmt: skip


def _run(path: Path, stand: Stand) -> Run:
    if format_of(path, SUFFIXES) is None:
        raise UsageError(f"--run {path}: expected a name that ends in {' or '.join(SUFFIXES)}")
    run = Run(path.name, tuple(s.name for s in stand.flywheels), read(path))
    refuse_foreign_run(stand, run, identity(path), f"--run {path}")
    return run


def stand_parts(subject: Subject, on_part: Callable[[int], None] = lambda done: None) -> list[Part]:
    """The parts of the page in their order; `on_part` gets the number of those done, of all SECTIONS."""
    parts = []
    for done, section in enumerate(SECTIONS, start=1):
        part = section(subject)
        parts += [] if part is None else [part]
        on_part(done)
    return parts


# -- what moves --------------------------------------------------------------------------------------------------------


def run_part(subject: Subject) -> Part | None:
    """Time histories of a run; None without one."""
    run = subject.run
    if run is None:
        return None
    words = f"{len(run.t)} rows, {run.t[0]:.6g} to {run.t[-1]:.6g} s. Of many rows every peak is drawn."
    summary = f"{run.t[-1] - run.t[0]:.6g} s in {len(run.t)} rows"
    return Part("Run", words, panels=tuple(run_panels(run.columns)), summary=summary)


def programme_part(subject: Subject) -> Part | None:
    """Speeds of a programme, and what its carrier does; None without one."""
    programme = subject.programme
    if programme is None:
        return None
    span = "period" if programme.periodic else "duration"
    words = f"{programme.motion}: {span} {programme.span:.6g} s"
    if programme.periodic:
        turns = zip(programme.flywheels, programme.winding, strict=True)
        words += f", turns a {span}: " + ", ".join(f"{name} {n}" for name, n in turns)
    words += ". " + (
        "With `--motion` its carrier's motion, torques and the residual of (12) are shown as well."
        if subject.motion is None
        else "The carrier as (8) moves it from the required state at t = 0, and as it is required."
    )
    try:
        shown, failures = programme_panels(programme, subject.stand, subject.motion, 200), tuple[str, ...]()
    except StateError as error:
        shown, failures = programme_panels(programme), (f"programme: {error}",)
    return Part("Programme", words, panels=tuple(shown), summary=f"{programme.motion}, {span} {programme.span:.6g} s",
                failures=failures)  # fmt: skip


# -- what there is -----------------------------------------------------------------------------------------------------


def bodies_part(subject: Subject) -> Part:
    """Masses, unbalances, what acts on the stand, the drawing, warnings."""
    stand, summary = subject.stand, summarize(subject.stand)
    rows: list[Row] = [
        [row.name, row.kind, row.mount, figure(row.mass), *_millimetres(row.center_of_mass)] for row in summary.bodies
    ]
    rows.append(["all", "", "", figure(summary.mass), *_millimetres(summary.center_of_mass)])
    head = ("body", "kind", "on", "mass, kg>", "x, mm>", "y, mm>", "z, mm>")
    tables = table(head, rows, "Centres of mass in E1 about O1, flywheels at phase zero")
    if summary.unbalance:
        tables += _unbalances(summary)
    tables += Markup("<dl>{}</dl>").format(
        Markup("").join(Markup("<dt>{}</dt><dd>{}</dd>").format(*pair) for pair in _surroundings(stand, summary))
    )
    html = Markup('<div class="beside"><div>{}</div><div>{}</div></div>').format(tables, drawing(stand))
    return Part("Bodies", html=html, notes=tuple(f"Warning: {line}" for line in summary.warnings))


def _millimetres(place: Sequence[float]) -> list[Markup]:
    return [figure(0.0 if abs(x) < 1e-13 else 1e3 * x) for x in place]


def _unbalances(summary: Summary) -> Markup:
    head = (
        "flywheel", "spin inertia, kg cm²>", "static, g mm>", "dynamic, g mm²>", "J22 − J33, g mm²>", "at, rpm>",
        "force, N>", "moment, N m>", "grade",
    )  # fmt: skip
    rows = [
        [row.name, *(figure(x, 4) for x in (1e4 * row.spin_inertia, 1e6 * row.static, 1e9 * row.dynamic,
         1e9 * row.asymmetry, RPM * row.speed, row.force, row.moment)), row.grade]
        for row in summary.unbalance
    ]  # fmt: skip
    words = f"Unbalance about each origin, grades of ISO 21940-11; all forces in one line make {summary.force:.5g} N"
    return table(head, rows, words)


def _surroundings(stand: Stand, summary: Summary) -> Iterator[tuple[str, str]]:
    """What acts on the stand, in words."""
    if summary.hold:
        yield "Hold", summary.hold
    yield "Attitude angles", stand.angles
    if any(stand.gravity):
        yield "Gravity", f"{_vector(stand.gravity)} m/s², axes of E0"
    if stand.stream is not None:
        yield "Stream", f"{_vector(stand.stream)} m/s, axes of E0"
    if stand.profile is not None:
        stations = zip(stand.profile.velocity, stand.profile.depth, strict=True)
        yield "Stream by depth", ", ".join(f"{_vector(u)} m/s at {depth:.6g} m" for u, depth in stations)
    acting = [law.short(stand) for law in carrier_laws()]
    bearers = ((law.name, law.bearers(stand)) for law in body_laws())
    acting += [f"{name} of {', '.join(names)}" for name, names in bearers if names]
    bodies: list[Carrier | Instrument] = [stand.carrier, *stand.instruments]
    added = [body.name for body in bodies if body.added_mass is not None]
    acting += [f"added mass of {', '.join(added)}"] if added else []
    if any(acting):
        yield "What acts on it", "; ".join(filter(None, acting))
    if places := [*(p.name for p in stand.instruments), *(p.name for p in stand.points)]:
        yield "Instruments, points", ", ".join(places)
    if wrenches := [body.name for body in stand.bodies if body.wrench_input]:
        yield "Wrenches at run time", ", ".join(wrenches)


def _vector(numbers: Sequence[float]) -> str:
    return f"({', '.join(f'{x:.6g}' for x in numbers)})"


# -- how it swings and shakes ------------------------------------------------------------------------------------------


def modes_part(subject: Subject) -> Part | None:
    """Natural frequencies at rest, and against the common speed of the flywheels."""
    stand = subject.stand
    if stand.hold is not None and not stand.hold.freedoms:
        return None
    try:
        found = modes(stand)
    except (CheckError, UsageError) as error:
        return Part("Modes", f"{_sentence(error)}: there is no pose to be linear about.")
    frequency, damping = np.nan_to_num(found["frequency"]), found["damping"]
    swinging = np.flatnonzero(frequency > 0.0).tolist()[:MOST_ROWS]
    rows = [[_largest_part(found, k), figure(frequency[k]), figure(damping[k], 3)] for k in swinging]
    still = int(np.sum(frequency == 0.0))
    words = f"{still} of the {found.count} small motions about rest do not oscillate: free, or damped too much." * bool(
        still
    )
    head = ("moves most", "frequency, Hz>", "damping ratio>") if rows else ()
    ends = [figure(frequency[k], 3) for k in (swinging[:1] + swinging[-1:])]
    part = Part(
        "Modes", words, head, tuple(rows), summary=f"{' to '.join(dict.fromkeys(ends))} Hz at rest" if rows else ""
    )
    if not stand.flywheels:
        return part
    scene, limit = Scene.of(stand), max(row.speed for row in summarize(stand).unbalance)
    diagram = campbell(scene, np.linspace(0.0, limit, 4 * STEPS - 3))
    if not np.isfinite(diagram.natural).any():
        return part
    growth = compare_growth(scene, diagram)
    if growth is not None and growth.unstable is not None:
        words += f" Deviations from steady motion grow at {RPM * growth.unstable:.4g} rpm: the stand is unstable there."
    return Part("Modes", words.strip(), head, tuple(rows), (campbell_panel(diagram),), summary=part.summary)


def _largest_part(found: Result, k: int) -> str:
    """The coordinate that a mode moves most, by its row of the table."""
    return str(found["coordinates"][int(np.abs(found["shape"][k]).argmax())]).partition(" [")[0]


def vibration_part(subject: Subject) -> Part | None:
    """Steady vibration of points against the common speed of the flywheels."""
    stand = subject.stand
    if not stand.flywheels:
        return None
    limit = max(row.speed for row in summarize(stand).unbalance)
    points = subject.at or _measured(stand)
    try:
        sweeps = sweep_outputs(
            stand, read_speeds(stand, [f"all=0..{limit!r} rad/s"]), STEPS, [find_view(stand, p) for p in points]
        )
    except CheckError as error:
        return Part("Vibration", f"{_sentence(error)}: there is no steady vibration to show.")
    if any(found.interrupted for found in sweeps):
        raise KeyboardInterrupt  # a part of a sweep makes no section
    shown, summaries, remarks = [], [], []
    for point, found in zip(points, sweeps, strict=True):
        sizes = np.linalg.norm(np.nan_to_num(found.rms()), axis=1)
        if sizes.max() < STILL:
            remarks.append(f"Nothing shakes {point}: the flywheels are balanced.")
            continue
        shown.append(orders_panel(found))
        speed = RPM * found.values[int(sizes.argmax())]
        summaries.append(f"{point} at most {sizes.max():.3g} {found.unit} RMS at {speed:.4g} rpm")
    words = (
        f"Amplitudes by order, exact for the full equations; all flywheels at one of {STEPS} common speeds, phases 0 "
        "at t = 0. `mahovik response` has other speeds, quantities and spectra."
    )
    said = words if shown else ""
    return Part("Vibration", said, panels=tuple(shown), notes=tuple(remarks), summary="; ".join(summaries))


def _measured(stand: Stand) -> list[str]:
    """The stand's first points, else its instruments, else O1; of a held carrier the reaction before them."""
    points = [each.name for each in (stand.points or stand.instruments)[:MOST_POINTS]]
    if stand.hold is not None:
        return [REACTION, *(points if stand.hold.freedoms else [])]
    return points or [stand.carrier.name]


def requirements_part(subject: Subject) -> Part | None:
    """Limits of the angle of the first point, over all common speeds."""
    if not subject.require:
        return None
    stand = subject.stand
    limit = max((row.speed for row in summarize(stand).unbalance), default=0.0)
    point = (subject.at or _measured(stand))[0]
    found = jitter(stand, {"all": f"0..{limit!r} rad/s"}, point, steps=4 * STEPS - 3, require=subject.require)
    arcsec = found.study.measure.arcsec
    scale, unit = (ARCSEC, arcsec) if arcsec else (1.0, found.unit)
    rows = [
        [each.requirement.text, figure(scale * each.requirement.limit, 4), figure(scale * each.value, 4),
         found.study.axes[each.axis], figure(RPM * found.study.value[each.step], 4), "met" if each.met else FAILED]
        for each in found.verdicts
    ]  # fmt: skip
    head = ("requirement", f"limit, {unit}>", f"largest, {unit}>", "axis", "at, rpm>", "")
    failures = tuple(f"{point}: {each.requirement.text} is not met" for each in found.verdicts if not each.met)
    words = f"{found.study.quantity} of {point}, all flywheels at any common speed up to {RPM * limit:.5g} rpm."
    met = sum(each.met for each in found.verdicts)
    summary = f"{met} of {len(rows)} met at {point}"
    return Part("Requirements", words, head, tuple(rows), summary=summary, failures=failures)


def limits_part(subject: Subject) -> Part | None:
    """Momentum and torque that the motors reach together."""
    summary = summarize(subject.stand)
    given = [
        (f"{name}, {unit}>", of)
        for name, unit, of in (("momentum", "N m s", summary.momentum), ("torque", "N m", summary.torque))
        if any(each is not None for each in of.each)
    ]
    if not given:
        return None
    names = ("along x", "along y", "along z", "in every direction")
    rows = [[name, *(figure([*of.axes, of.direction][k]) for _, of in given)] for k, name in enumerate(names)]
    summaries = [f"{of.direction:.4g} {head.partition(', ')[2].rstrip('>')} in every direction" for head, of in given]
    head = ("all motors", *(head for head, _ in given))
    return Part("Limits and reach", head=head, rows=tuple(rows), summary="; ".join(summaries))


# -- whether it is right, and what it costs ----------------------------------------------------------------------------


def verification_part(subject: Subject) -> Part:
    """The C by the reference and the second derivation, now, at few states."""
    file = subject.file or f"{subject.stand.name}.toml"
    try:
        found = verify(subject.stand, states=STATES)
    except MahovikError as error:
        return Part("Verification", f"The C was not judged: {_sentence(error)}. `mahovik verify {file}`")
    checks = [check for check in found.result.rows if check.verdict != "not compared"]
    worst = [max(rows, key=lambda check: check.share) for _, rows in groupby(checks, key=lambda check: check.judged)]
    shown = sorted(worst, key=lambda check: -check.share)[: MOST_ROWS - 2]
    rows = [
        [each.judged or "whole", each.quantity, str(each.states), figure(each.value, 2), figure(each.limit, 2),
         each.verdict if not each.failed else FAILED]
        for each in shown
    ]  # fmt: skip
    head = ("function", "worst quantity", "states>", "difference>", "accepted>", "")
    words = (
        f"Three derivations that share no formula code, at {STATES} states: the C, the literal equations in NumPy, "
        f"Lagrange's equations in CasADi. The worst of {len(worst)} lines; `mahovik verify {file}` has all, at more "
        f"states, `mahovik evidence {file}` everything else that speaks for the C."
    )
    failures = () if found.passed else (f"verification: {found.conclusion}",)
    return Part("Verification", words, head, tuple(rows), summary=found.conclusion, failures=failures)


def cost_part(subject: Subject) -> Part:
    """Operations of the usual functions."""
    program = lower(subject.stand, DOUBLE)
    rows = []
    for function in program.functions:
        if function.name in COSTLY:
            count = cost(function, program.functions)
            numbers = (count.additions, count.multiplications, count.divisions, count.total)
            rows.append(
                [Markup("<code>{}</code>").format(function.name), *(f"{n:,}".replace(",", "\u202f") for n in numbers)]
            )
    words = "Operations of one call at most. `mahovik cost` measures instructions, stack and code on processors."
    return Part("Cost", words, ("function", "additions>", "products>", "divisions>", "all>"), tuple(rows))


def _sentence(error: Exception) -> str:
    """The words of an error, without the backticks of commands, with a capital letter."""
    words = str(error).replace("`", "")
    return words[:1].upper() + words[1:]


SECTIONS = (
    run_part, programme_part, bodies_part, modes_part, vibration_part, requirements_part, limits_part,
    verification_part, cost_part,
)  # fmt: skip
"""The parts of a page in their order."""


class Page:
    """The report of a stand: `html`, one page that opens offline; `failures` are what it shows as failed."""

    def __init__(self, stand: Stand, html: str, failures: Sequence[str]) -> None:
        self.stand, self.html, self.failures = stand, html, tuple(failures)

    def save(self, path: str | Path) -> None:
        """Write the page. Raises UsageError."""
        write(Path(path), self.html)

    def _repr_html_(self) -> str:
        return f'<iframe srcdoc="{escape(self.html)}" style="width: 100%; height: 40em; border: 0"></iframe>'

    def __repr__(self) -> str:
        return f"<Page on {self.stand.name}: {len(self.html) // 1000} kB, {len(self.failures)} failures>"


def report(
    stand: StandGiven,
    *,
    at: Sequence[str] = (),
    require: Sequence[str] = (),
    run: str | Path | None = None,
    programme: str | Path | None = None,
    motion: str | Path | None = None,
    progress: OnProgress | None = None,
) -> Page:
    """Report on a stand, on one page: bodies, modes, vibration, limits, verification, cost, a run or a programme.

    at       points, instruments, "carrier" or "hold.reaction" whose vibration is shown; none: the stand's first points
    require  limits of the angle of the first of them over all common speeds, as "rms 0.1 arcsec"
    run, programme, motion   files of `simulate`, `plan` and its motion

    Raises StandError, UsageError where matplotlib is missing or a file is of another stand.
    """
    require_drawing("report")
    own = Stand.of(stand)
    source = Path(stand).name if isinstance(stand, str | Path) else f"{own.name}.toml"
    read, planned, required = (None if path is None else Path(path) for path in (run, programme, motion))
    subject = gather(own, source, read, planned, required, at, require)
    parts = stand_parts(subject, lambda done: tell(progress, Progress("sections of the report", done, len(SECTIONS))))
    failures = [line for part in parts for line in part.failures]
    return Page(own, page(own.name, parts, own, subject.files), failures)
