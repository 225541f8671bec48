"""Sections of the page on a stand: bodies, modes, vibration, limits, requirements, verification, cost."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import groupby
from typing import Any

import numpy as np
from markupsafe import Markup

from mahovik.contract.quantities import RPM
from mahovik.core.lower.program import lower
from mahovik.core.program.cost import cost
from mahovik.core.program.types import DOUBLE
from mahovik.core.stand.laws import body_laws, carrier_laws
from mahovik.core.stand.model import Carrier, Instrument, Stand
from mahovik.core.stand.summary import Summary, summarize
from mahovik.errors import CheckError, MahovikError, UsageError
from mahovik.out.report.drawing import draw_stand
from mahovik.out.report.page import Part, Row, figure, inline, table
from mahovik.out.report.plots import Line, Mark, Panel, column_panels
from mahovik.proof.verify.check import conclusion
from mahovik.proof.verify.harness import verify_c
from mahovik.use.study.linear import linear_model, modes
from mahovik.use.study.rest import rest
from mahovik.use.vibration.campbell import Campbell, campbell
from mahovik.use.vibration.requirement import read_requirements
from mahovik.use.vibration.scene import Scene
from mahovik.use.vibration.speeds import read_speeds
from mahovik.use.vibration.study import vibration
from mahovik.use.vibration.view import REACTION, find_view

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
    """What a page is about: the stand, points whose vibration is shown, limits of the angle of the first of them.

    at       points, instruments, "carrier" or "hold.reaction"; none: those of the stand
    require  "rms 0.1 arcsec"
    document keys of the stand's file, which the second derivation reads; None without one
    """

    stand: Stand
    at: tuple[str, ...] = ()
    require: tuple[str, ...] = ()
    document: dict[str, Any] | None = None


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
    drawn, ties = draw_stand(stand)
    words = (
        "To scale, flywheels at phase 0. The stand file has no shapes: bodies are homogeneous ones of the same mass "
        "and inertia; arrows from flywheels: spin axes, unbalance (the largest as long as the largest disc is wide)."
    ) + f" {ties}." * bool(ties)
    picture = inline(drawn, "three views of the stand") + Markup("<p>{}</p>").format(words)
    html = Markup('<div class="beside"><div>{}</div><div>{}</div></div>').format(tables, picture)
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
        found = modes(linear_model(stand, rest(stand).state, ["carrier"], locked=True))
    except (CheckError, UsageError) as error:
        return Part("Modes", f"{_sentence(error)}: there is no pose to be linear about.")
    swinging = [mode for mode in found.modes if mode.kind != "free" and mode.frequency > 0.0]
    rows = [
        [found.coordinates[int(np.abs(mode.shape).argmax())].name, figure(mode.frequency), figure(mode.damping, 3)]
        for mode in swinging[:MOST_ROWS]
    ]
    still = len(found.modes) - len(swinging)
    words = f"{still} of the {len(found.modes)} small motions about rest do not oscillate: free, or damped too much."
    words *= bool(still)
    head = ("moves most", "frequency, Hz>", "damping ratio>") if rows else ()
    ends = [figure(mode.frequency, 3) for mode in swinging[:1] + swinging[-1:]]
    summary = f"{' to '.join(dict.fromkeys(ends))} Hz at rest" if rows else ""
    panels: tuple[Panel, ...] = ()
    if stand.flywheels:
        scene = Scene.of(stand)
        diagram = campbell(scene, np.linspace(0.0, _fastest(stand), 4 * STEPS - 3))
        if np.isfinite(diagram.natural).any():
            panels = (campbell_panel(diagram),)
    return Part("Modes", words.strip(), head, tuple(rows), panels, summary=summary)


def _fastest(stand: Stand) -> float:
    """The speed (rad/s) up to which flywheels are shown."""
    return max((row.speed for row in summarize(stand).unbalance), default=0.0)


def campbell_panel(found: Campbell) -> Panel:
    """Natural frequencies, orders of the flywheels, dots where they meet; to somewhat beyond the last crossing."""
    absent = int((~np.isfinite(found.natural).any(axis=0)).sum())  # the first columns, which are nowhere
    speed, top = RPM * found.speed, 1.15 * float(np.nanmax(found.natural))
    last = 1.6 * RPM * max((each.speed for each in found.crossings), default=0.0)
    end = last if 0.0 < 2.0 * last < speed[-1] else float(speed[-1])
    columns = range(absent, found.natural.shape[1])
    lines = [Line(f"mode {k - absent + 1}", speed, found.natural[:, k], k - absent) for k in columns]
    for n in found.orders:
        x = np.minimum(np.array([0.0, 1.0]) * end, 60.0 * top / n)
        lines.append(Line("", x, n * x / 60.0, None, dashed=True, tag=f"{n}×" if x[1] > 0.15 * end else ""))
    return Panel(
        "natural frequency, Hz", tuple(lines), abscissa="common speed, rpm", height=1.3, top=top, span=(0.0, end),
        marks=tuple(Mark(RPM * each.speed, each.frequency, f"{each.order}×") for each in found.crossings),
        note="dashed: orders " + ", ".join(f"{n}×" for n in found.orders),
    )  # fmt: skip


def vibration_part(subject: Subject) -> Part | None:
    """Steady vibration of points against the common speed of the flywheels."""
    stand = subject.stand
    if not stand.flywheels:
        return None
    points = subject.at or _measured(stand)
    asked = read_speeds(stand, f"0..{_fastest(stand)!r} rad/s")
    shown, summaries, remarks = [], [], []
    for point in points:
        view = find_view(stand, point)
        unit, quantity = view.measure.unit, view.quantity
        try:
            found = vibration(stand, asked, view, steps=STEPS)
        except CheckError as error:
            return Part("Vibration", f"{_sentence(error)}: there is no steady vibration to show.")
        sums = found.sums()
        rms, worst = (np.linalg.norm(np.nan_to_num(each), axis=1) for each in (sums.rms, sums.worst))
        if rms.max() < STILL:
            remarks.append(f"Nothing shakes {point}: the flywheels are balanced.")
            continue
        columns = [("RMS", unit, rms), ("worst case over phases", unit, worst)]
        (panel,) = column_panels(("speed all", "rad/s", found.value), columns)
        words = f"{quantity} of {point}, {unit}"
        shown.append(replace(panel, quantity=words, height=1.8, abscissa="common speed, rpm"))
        speed = RPM * found.value[int(rms.argmax())]
        summaries.append(f"{point} at most {rms.max():.3g} {unit} RMS at {speed:.4g} rpm")
    words = (
        "All flywheels at one common speed, phases 0 at t = 0. `mahovik vibration` has other speeds, quantities and "
        "orders."
    )
    return Part(
        "Vibration", words if shown else "", panels=tuple(shown), notes=tuple(remarks), summary="; ".join(summaries)
    )


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
    limit = _fastest(stand)
    point = (subject.at or _measured(stand))[0]
    view = find_view(stand, point, None, "angle")
    limits = read_requirements(subject.require, view)
    bands = [each.band for each in limits]
    found = vibration(stand, read_speeds(stand, f"0..{limit!r} rad/s"), view, steps=4 * STEPS - 3, bands=bands)
    verdicts = [found.judge(each) for each in limits]
    rows = [
        [each.requirement.text, f"{figure(100.0 * each.value / each.requirement.limit, 4)} %",
         view.axes[min(each.axis, len(view.axes) - 1)], figure(RPM * found.value[each.step], 4),
         "met" if each.met else FAILED]
        for each in verdicts
    ]  # fmt: skip
    head = ("requirement", "largest, of it>", "axis", "at, rpm>", "")
    failures = tuple(f"{point}: {each.requirement.text} is not met" for each in verdicts if not each.met)
    words = f"{view.quantity} of {point}, all flywheels at any common speed up to {RPM * limit:.5g} rpm."
    met = sum(each.met for each in verdicts)
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
    file = f"{subject.stand.name}.toml"
    try:
        found = verify_c(subject.stand, seed=1, count=STATES, document=subject.document)
    except MahovikError as error:
        return Part("Verification", f"The C was not judged: {_sentence(error)}. `mahovik verify {file}`")
    checks = [check for check in found.rows if check.verdict != "not compared"]
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
    verdict = conclusion(found)
    failures = () if found.passed else (f"verification: {verdict}",)
    return Part("Verification", words, head, tuple(rows), summary=verdict, failures=failures)


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
    bodies_part, modes_part, vibration_part, limits_part, requirements_part, verification_part, cost_part,
)  # fmt: skip
"""The parts of a page in their order."""
