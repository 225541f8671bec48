"""`report`: one page on a stand and its proof, made of the results of other commands; or its derivation."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import numpy as np
from markupsafe import Markup

from mahovik.contract.quantities import RPM
from mahovik.errors import CheckError, MahovikError, UsageError
from mahovik.nearest import names_in
from mahovik.out.arguments import FilePath, Names, Progressing, StandGiven, command, file_name
from mahovik.out.commands.check import check
from mahovik.out.commands.modes import modes
from mahovik.out.commands.verify import verify
from mahovik.out.commands.vibration import vibration
from mahovik.out.notices import Progress, notify
from mahovik.out.plots import require as require_drawing
from mahovik.out.report.page import Part, inline, page, table
from mahovik.out.result import Result, column, columns_of
from mahovik.writing import format_of, probe, write

if TYPE_CHECKING:
    from mahovik.out.api.stands import Stand

STATES, STEPS = 16, 31
"""Random and extreme states at which the C is judged, `mahovik verify` takes more; speeds of a sweep."""

MOST_POINTS, MOST_ROWS = 3, 10
"""Points whose vibration is shown where none is asked for; rows of a table of verdicts, the worst."""

STILL = 1e-10
"""m/s2, N: less than this is rounding."""

COSTLY = ("forward", "torque", "coupled", "inverse", "inverse_fast", "momentum", "step", "prepare")
"""Functions whose operations are shown, where the stand has them."""


@command(excludes={"derivation": ("at", "require")})
def report(
    stand: StandGiven,
    *,
    output: FilePath,
    at: Names | None = None,
    require: Annotated[str | Sequence[str], "LIMIT"] = (),
    derivation: bool = False,
    progress: Progressing = None,
) -> Result:
    """Write one page on a stand and its proof, or its derivation.

    The page opens offline in any browser, and prints: bodies and a drawing, modes, vibration, limits of the motors,
    requirements, verification, cost. The exit status is 1 if a comparison fails or a requirement is not met; the page
    is written and shows it.

    Args:
        stand: the stand file.
        output: write the page to this file, .html.
        at: points, instruments, carrier or hold.reaction whose vibration is shown; default the first points.
        require: limit of the angle of the first point over all common speeds, "rms 0.1 arcsec".
        derivation: write the matrices of (8)-(11) instead, in symbols, then with the numbers of the stand.

    Raises:
        UsageError: matplotlib is missing, an unknown point, a file that cannot be written.
    """
    from mahovik.out.api.stands import Stand
    from mahovik.out.report.derivation import derivation_parts

    machine = Stand.of(stand)
    format_of(Path(output), (".html",))
    require_drawing()
    probe(Path(output))
    source = file_name(stand, f"{machine.name}.toml")
    made: list[Part] = []
    if derivation:
        text = page(f"{machine.name}: equations of motion", derivation_parts(machine), machine, [("stand", source)])
    else:
        points = _measured(machine) if at is None else names_in("at", at)
        checked = check(machine)
        sections: tuple[Callable[[], Part | None], ...] = (
            lambda: bodies_part(machine, checked), lambda: modes_part(machine), lambda: vibration_part(machine, points),
            lambda: limits_part(checked), lambda: requirements_part(machine, points[0], require),
            lambda: verification_part(machine, source), lambda: cost_part(machine),
        )  # fmt: skip
        for done, section in enumerate(sections, start=1):
            part = section()
            made += [] if part is None else [part]
            notify(progress, Progress("sections of the report", done, len(sections)))
        text = page(machine.name, made, machine, [("stand", source)])
    write(Path(output), text)
    failures = [f"error: {line}" for part in made for line in part.failures]
    return Result("", meta={"file": str(output)}, messages=failures, ok=not failures)


def _measured(stand: Stand) -> Sequence[str]:
    """The stand's first points, else its instruments, else O1; of a held carrier the reaction before them."""
    points = [place.name for place in (stand.points or stand.instruments)[:MOST_POINTS]]
    if stand.hold is not None:
        return ["hold.reaction", *(points if stand.hold.freedoms else [])]
    return points or [stand.carrier.name]


def _fastest(stand: Stand) -> float:
    """The speed (rad/s) up to which flywheels are shown."""
    from mahovik.core.stand.summary import summarize

    return max((row.speed for row in summarize(stand).unbalance), default=0.0)


def bodies_part(stand: Stand, checked: Result) -> Part:
    """Masses, unbalances, what acts on the stand, the drawing, warnings."""
    from mahovik.core.stand.laws import body_laws, carrier_laws
    from mahovik.out.report.drawing import draw_stand

    title = "centres of mass in E1 about O1, flywheels at phase zero"
    html = table(checked.take(slice(None), ("name", "kind", "mount", "mass", "center_of_mass"), title))
    if stand.flywheels:
        effects = replace(checked["effects"], columns=[*checked["unbalance"].columns, *checked["effects"].columns[1:]])
        shown = ("name", "spin_inertia", "static", "dynamic", "asymmetry", "speed", "force", "moment", "grade")
        html += table(effects.take(slice(None), shown, "unbalance about each origin, grades of ISO 21940-11"))
    bearers = ((law.name, law.bearers(stand)) for law in body_laws())
    acting = [f"attitude {stand.angles}", *(law.short(stand) for law in carrier_laws())]
    acting += [f"{name} of {', '.join(names)}" for name, names in bearers if names]
    acting += [f"gravity {_vector(stand.gravity)} m/s² in E0"] if any(stand.gravity) else []
    acting += [f"stream {_vector(stand.stream)} m/s in E0"] if stand.stream is not None else []
    if stand.profile is not None:
        stations = zip(stand.profile.velocity, stand.profile.depth, strict=True)
        acting += [f"stream {_vector(u)} m/s at {depth:.6g} m" for u, depth in stations]
    places = ", ".join([*(body.name for body in stand.instruments), *(point.name for point in stand.points)])
    acting += [f"instruments and points: {places}"] if places else []
    drawn, ties = draw_stand(stand)
    words = (
        "To scale, flywheels at phase 0. The stand file has no shapes: bodies are homogeneous ones of the same mass "
        "and inertia; arrows from flywheels: spin axes, unbalance (the largest as long as the largest disc is wide)."
    ) + f" {ties}." * bool(ties)
    facts = Markup("<p>{}</p>").format("; ".join(filter(None, acting)))
    picture = inline(drawn, "three views of the stand") + Markup("<p>{}</p>").format(words)
    html = Markup('<div class="beside"><div>{}{}</div><div>{}</div></div>').format(html, facts, picture)
    return Part("Bodies", html=html, notes=tuple(checked.messages))


def _vector(numbers: Sequence[float]) -> str:
    return f"({', '.join(f'{x:.6g}' for x in numbers)})"


def modes_part(stand: Stand) -> Part | None:
    """Natural frequencies at rest, and against the common speed of the flywheels."""
    if stand.hold is not None and not stand.hold.freedoms:
        return None
    try:
        result = modes(stand)
    except (CheckError, UsageError) as error:
        return Part("Modes", f"{error}: there is no pose to be linear about.")
    swinging = np.flatnonzero(np.nan_to_num(result["frequency"]) > 0.0)
    still = result.count - len(swinging)
    words = f"{still} of the {result.count} small motions about rest do not oscillate: free, or damped too much."
    frequency = result["frequency"][swinging]
    ends = " to ".join(dict.fromkeys(f"{value:.3g}" for value in (*frequency[:1], *frequency[-1:])))
    panels: tuple[Any, ...] = ()
    if stand.flywheels:
        end, steps = _fastest(stand), 4 * STEPS - 3
        diagram = modes(stand, speed=f"0..{end!r} rad/s", steps=steps)
        last = 1.6 * float(max(diagram["crossings"]["speed"], default=0.0))
        if 0.0 < 2.0 * last < end:  # somewhat beyond the last crossing
            diagram = modes(stand, speed=f"0..{last!r} rad/s", steps=steps)
        drawings = diagram.drawings if diagram["frequency"].size else ()
        panels = tuple(replace(drawing, height=1.6) for drawing in drawings)
    tables = (result.take(swinging, ("frequency", "damping", "motion"), ""),) if len(swinging) else ()
    summary = f"{ends} Hz at rest" if ends else ""
    return Part("Modes", words * bool(still), tables, panels, summary=summary)


def vibration_part(stand: Stand, points: Sequence[str]) -> Part | None:
    """Steady vibration of points against the common speed of the flywheels."""
    if not stand.flywheels:
        return None
    shown: list[Any] = []
    summaries, remarks = [], []
    for point in points:
        quantity: Literal["acceleration"] | None = None if point.startswith("hold.") else "acceleration"
        try:
            result = vibration(stand, speed=f"0..{_fastest(stand)!r} rad/s", at=point, quantity=quantity, steps=STEPS)
        except CheckError as error:
            return Part("Vibration", f"{error}: there is no steady vibration to show.")
        rms, unit = np.nan_to_num(result["length", "rms"]), result["largest"]["unit"]
        if rms.max() < STILL:
            remarks.append(f"Nothing shakes {point}: the flywheels are balanced.")
            continue
        shown += [replace(drawing, height=1.6) for drawing in result.drawings]
        speed = RPM * result["speeds"][int(rms.argmax())]
        summaries.append(f"{point} at most {rms.max():.3g} {unit} RMS at {speed:.4g} rpm")
    words = "All flywheels at one common speed. `mahovik vibration` has other speeds, quantities and orders."
    summary = "; ".join(summaries)
    return Part("Vibration", words * bool(shown), panels=tuple(shown), notes=tuple(remarks), summary=summary)


def requirements_part(stand: Stand, point: str, require: str | Sequence[str]) -> Part | None:
    """Limits of the angle of a point, over all common speeds."""
    if not require:
        return None
    result = vibration(stand, speed=f"0..{_fastest(stand)!r} rad/s", at=point, require=require, steps=4 * STEPS - 3)
    verdicts = result["requirements"]
    listed = Result(
        "",
        (
            column("requirement", "", [verdict["text"] for verdict in verdicts]),
            column("largest, of it", "%", [100.0 * verdict["value"] / verdict["limit"] for verdict in verdicts]),
            *columns_of(verdicts, {"axis": "", "speed": "rad/s"}, shown={"speed": "rpm"}),
            column("verdict", "", ["met" if verdict["met"] else "FAILED" for verdict in verdicts]),
        ),
    )
    failures = tuple(f"{point}: {verdict['text']} is not met" for verdict in verdicts if not verdict["met"])
    words = f"{result['quantity']} of {point}, all flywheels at any common speed up to {RPM * _fastest(stand):.5g} rpm."
    summary = f"{len(verdicts) - len(failures)} of {len(verdicts)} met at {point}"
    return Part("Requirements", words, (listed,), summary=summary, failures=failures)


def limits_part(checked: Result) -> Part | None:
    """Momentum and torque that the motors reach together."""
    capacity = checked["capacity"]
    if not capacity.count:
        return None
    rows = zip(capacity["in every direction"], capacity["unit"], strict=True)
    summary = "; ".join(f"{reach:.4g} {unit} in every direction" for reach, unit in rows)
    shown = capacity.take(slice(None), ("of", "along", "in every direction", "unit"))
    return Part("Limits and reach", tables=(shown,), summary=summary)


def verification_part(stand: Stand, file: str) -> Part:
    """The C by the reference and the second derivation, now, at few states; `file` of the stand is what to judge."""
    try:
        result = verify(stand, states=STATES)
    except MahovikError as error:
        return Part("Verification", f"The C was not judged: {error}. `mahovik verify {file}`")
    words = (
        f"Three derivations that share no formula code, at {STATES} states: the C, the literal equations in NumPy, "
        f"Lagrange's equations in CasADi. The lines nearest to their limits; `mahovik verify {file}` has all, at more "
        f"states, `mahovik evidence {file}` everything else that speaks for the C."
    )
    verdict = result.messages[-1]
    failures = () if result.ok else (f"verification: {verdict}",)
    shown = result.take(slice(MOST_ROWS), [one.name for one in result.columns], "")
    return Part("Verification", words, (shown,), summary=verdict, failures=failures)


def cost_part(stand: Stand) -> Part:
    """Operations of the usual functions."""
    from mahovik.core.lower.program import lower
    from mahovik.core.program.cost import cost
    from mahovik.core.program.types import DOUBLE

    functions = lower(stand, DOUBLE).functions
    counted = {lowered.name: cost(lowered, functions) for lowered in functions if lowered.name in COSTLY}
    kinds = {"additions": "additions", "products": "multiplications", "divisions": "divisions", "all": "total"}
    columns = [column(head, "", [getattr(lowered, key) for lowered in counted.values()]) for head, key in kinds.items()]
    words = "Operations of one call at most. `mahovik verify --cost` measures instructions, stack and code."
    return Part("Cost", words, (Result("", [column("function", "", [*counted]), *columns]),))
