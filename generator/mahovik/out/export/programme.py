"""C files of a programme, beside those of its stand; refused if inaccurate or made for another stand.

They are written into a folder of `mahovik generate`, or any other; never over files of others.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass, replace
from functools import partial
from math import inf
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mahovik.contract.limits import OF_TABLE
from mahovik.core.emit.delivered import manifest_there, manifests_beside
from mahovik.core.emit.generate import PRECISIONS
from mahovik.core.emit.manifest import digest, read_header
from mahovik.core.emit.programme import Facts, ProgrammePrinter
from mahovik.core.lower.layout import Layout
from mahovik.core.lower.program import lower_layout
from mahovik.core.lower.programme import Course, Form, ProgrammeProgram, lower_programme
from mahovik.core.lower.programme_play import Player
from mahovik.core.motion.functions import Angles, Fourier
from mahovik.core.motion.programme import Programme, RunUpTable
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.program.types import NamedCount, Precision
from mahovik.core.stand.fields import name_problem
from mahovik.core.stand.model import Stand
from mahovik.core.stand.structure import identities, structure
from mahovik.errors import CheckError, StateError, UsageError
from mahovik.proof.verify.programme.compiled import deviations_of, spread_phases
from mahovik.proof.verify.programme.verification import (
    ProgrammeCase,
    bound_checks,
    motion_check,
    rocking_of,
    stand_check,
    tolerance_for,
)

NODES = {"double": 256, "float": 64}
"""Default number of nodes per period of a quintic table."""

ANGLE_LIMIT = 0.1
"""rad: an angle further from the programme is on another turn."""

WRONG = 10.0
"""Factor on the residual accepted by `verify`, or on the limit if larger, above which a file is refused."""

TIMES = 1024
"""Intervals at whose ends the bounds of a motion are looked at."""

_FINEST = 4096
"""Most nodes per period of a table that is refined."""

LEAST, MOST_NODES = 32, 1 << 14
"""Least nodes per period, and most nodes in all, of a run-up."""


_BESIDE = (
    "arrays", "batch", "default", "eva", "fuzz", "real", "record", "recorder", "selftest", "servo", "status", "tables",
    "trim", "wide", "word",
)  # fmt: skip
"""Words that other files of a stand have after its name, and so no programme of it."""


@dataclass(frozen=True)
class ProgrammeExport:
    """Files by name; messages, one line each; the tables and their program, to run it."""

    files: dict[str, str]
    lines: tuple[str, ...]
    program: ProgrammeProgram
    tables: tuple[Table, ...]
    errors: tuple[Errors, ...]


def export_programme(
    stand: Stand,
    programme: Programme,
    motion: RequiredMotion | None = None,
    kind: str = "quintic",
    nodes: int | None = None,
    real: str = "double",
    limit: float | None = None,
    source: str = "programme",
    called: str = "programme",
) -> ProgrammeExport:
    """C of a programme. With its motion, the tables include drive torques, and the residual that the tables add is
    measured; without it, the error of the accelerations. Without `nodes` a table has as many as the limit needs.
    `source` names the programme in messages, `called` in the names of the C.

    CheckError: programme, stand and motion do not belong together, the programme exceeds its bounds, or the error is
    above the limit. UsageError.
    """
    check_belongs(stand, programme, motion, source)
    if over := _exceeded_bounds(stand, programme, motion):
        raise CheckError(f"{source}: exceeds its bounds: {'; '.join(over)}: plan again; nothing was written")
    if kind == "fourier" and not programme.periodic:
        raise UsageError(f"{source}: a finite programme: a Fourier table needs a periodic one; give table=quintic")
    count, most = nodes or NODES[real], OF_TABLE[real] if limit is None else limit
    if not 0 < most < inf:
        raise UsageError(f"limit {most:g}: expected a number above 0, such as {OF_TABLE[real]:g}")
    layout = Layout(structure(stand), PRECISIONS[real])
    if called != "programme":
        check_name(stand, layout, called)
    prescribed = None if motion is None else ProgrammeCase.of(stand, motion, programme)
    table = _course(programme, layout, prescribed, kind, count)
    deviation = _measure_errors(layout, table, prescribed)
    finest = _FINEST if programme.periodic else MOST_NODES
    while nodes is None and kind == "quintic" and _is_coarse(deviation, most) and count < finest:
        count *= 2
        table = _course(programme, layout, prescribed, kind, count)
        deviation = _measure_errors(layout, table, prescribed)
    residual = deviation.given
    accepted = max(WRONG * tolerance_for(stand, None).residual, most)
    if residual is not None and residual > accepted:
        raise CheckError(
            f"{source}: its relative residual is {residual:.2e}, so it does not give the motion {programme.motion} "
            f"(below {accepted:g} it would): `mahovik verify` says more; nothing was written"
        )
    if deviation.decisive > most:
        raise CheckError(_too_coarse(source, table, deviation, most, real))
    tables, deviations = [table], [deviation]
    for part, finite in (("runup", programme.runup), ("rundown", programme.rundown)):
        if finite is not None:
            table = _finite(layout, part, finite, LEAST * finite.duration / programme.span, most, source)
            tables.append(_with_torques(table, finite, prescribed, source))
            deviations.append(_measure_errors(layout, tables[-1], None))
    made = lower_programme(layout, [t.form for t in tables])
    player = Player(made, {t.form.part: t.value for t in tables})
    measured = list(zip(tables, deviations, strict=True))
    lines = tuple(line for t, e in measured for line in table_messages(t, e, layout))
    numbers = tuple((t.form.part, t.span, t.value) for t in tables)
    facts = Facts(programme.motion, numbers, tuple(_table_facts(t, e) for t, e in measured), lines, most)
    files = ProgrammePrinter(stand, made, player.golden(), facts).files(called)
    return ProgrammeExport(
        files, (*lines, f"accepted error of the tables: {most:g}"), made, tuple(tables), tuple(deviations)
    )


def check_name(stand: Stand, layout: Layout, called: str) -> None:
    """Raises UsageError where a programme of that name would have names in C that the stand's C has."""
    problem = name_problem(called)
    if problem is not None:
        raise UsageError(f"name {called}: {problem}")
    program = lower_layout(layout)
    taken = {*_BESIDE, *(f.name for f in program.functions), *(s.name for s in program.structs)}
    bodies = [name.lower() for name in (*(b.name for b in stand.bodies), *(p.name for p in stand.points))]
    for name in sorted(taken) + bodies:
        if name == called.lower() or name.startswith(f"{called.lower()}_"):
            raise UsageError(
                f"name {called}: the C of {stand.name} has {stand.name}_{name}: choose another name, such as lap"
            )


def _is_coarse(errors: Errors, most: float) -> bool:
    """Whether a finite table needs more nodes: for what it adds to the residual, for its torques, or for turns lost."""
    torque = errors.tau is not None and errors.tau_peak is not None and errors.tau > most * errors.tau_peak
    return errors.decisive > most or torque or errors.phi > ANGLE_LIMIT


def check_belongs(stand: Stand, programme: Programme, motion: RequiredMotion | None, source: str) -> None:
    """Raise CheckError if a programme is for another stand, or was planned for another motion."""
    check = stand_check(stand, programme)
    if check.failed:
        raise CheckError(
            f"{source}: {check.words}: give the stand file that it was planned for, or plan again; nothing was written"
        )
    if motion is None:
        return
    wanted = motion_check(motion, programme)
    if wanted.failed:
        raise CheckError(f"{source}: {wanted.words}: give the motion that it was planned for; nothing was written")


def _exceeded_bounds(stand: Stand, programme: Programme, motion: RequiredMotion | None) -> list[str]:
    """Bounds that a programme exceeds: those that its planner reports, and with its motion as they are measured."""
    reports = [programme.report, *(programme.report.get(key) for key in ("runup", "rundown"))]
    exceeded_bounds = [
        str(words) for report in reports if isinstance(report, Mapping) for words in report.get("exceeded", ())
    ]
    if exceeded_bounds or motion is None:
        return exceeded_bounds
    t = np.arange(TIMES + (not programme.periodic), dtype=np.float64) * (programme.span / TIMES)
    angles = Angles(*programme.at(t))
    tau = np.zeros_like(angles.phi)
    if motion.bounds.torque is not None:
        tau = ProgrammeCase.of(stand, motion, programme).equations(t)[1]
    names, rocking = programme.flywheels, rocking_of(programme, t, angles.phi)
    items = bound_checks(motion.bounds, names, angles, tau, rocking)
    return [f"{item.quantity} {item.words}" for item in items if item.failed]


def _course(programme: Programme, layout: Layout, prescribed: ProgrammeCase | None, kind: str, count: int) -> Table:
    """The table of the programme itself."""
    torques = None if prescribed is None else partial(prescribed.torques, "")
    if kind == "fourier":
        return fourier_table(programme, layout.count, torques, layout.precision.name)
    form = Form("", "quintic", count, programme.periodic, torques is not None, layout.count)
    return quintic_table(form, programme.at, programme.span, programme.winding, torques)


def _measure_errors(layout: Layout, table: Table, prescribed: ProgrammeCase | None) -> Errors:
    """How far the table, as its C plays it, is from the course: angles, speeds and torques."""
    made = lower_programme(layout, [table.form])
    player = Player(made, {table.form.part: table.value})
    return errors(player, made.courses[0], table, layout.precision, prescribed)


def _finite(layout: Layout, part: str, finite: RunUpTable, least: float, most: float, source: str) -> Table:
    """A run-up or run-down without torques; the number of nodes is a power of two large enough for the limit."""
    rows = 8
    while rows < least:
        rows *= 2
    while True:
        form = Form(part, "quintic", rows, False, False, layout.count)
        table = quintic_table(form, finite.at, finite.duration, (0,) * int(layout.count), None)
        error = _measure_errors(layout, table, None).decisive
        if error <= most:
            return table
        if rows >= MOST_NODES:
            raise CheckError(
                f"{source}: {part}: with {rows} nodes the error of a table is {error:.2e} of the largest acceleration, "
                f"above {most:g}: nothing was written"
            )
        rows *= 2


def _with_torques(table: Table, finite: RunUpTable, prescribed: ProgrammeCase | None, source: str) -> Table:
    """A run-up or run-down with drive torques, for a carrier that moves freely meanwhile."""
    if prescribed is None:
        return table
    carrier, part = prescribed, table.form.part

    def torques(t: Array) -> Array:
        try:
            return carrier.torques(part, t)
        except StateError as error:
            raise CheckError(f"{source}: {part}: {error}; nothing was written") from None

    form = replace(table.form, torque=True)
    return quintic_table(form, finite.at, finite.duration, (0,) * int(form.count), torques)


def _too_coarse(source: str, table: Table, errors: Errors, most: float, real: str) -> str:
    what = "the relative residual that the table adds" if errors.added is not None else "the table's relative error"
    remedies = ["real=double"] * (real == "float") + ["table=quintic"] * (table.form.kind == "fourier")
    remedies = remedies or ["a programme of fewer harmonics"]
    return (
        f"{source}: {what} is {errors.decisive:.2e}, above {most:g}: give {' or '.join(remedies)}; nothing was written"
    )


def _table_facts(table: Table, errors: Errors) -> dict[str, Any]:
    """Size and errors of a table as data, without those not measured."""
    known = {name: value for name, value in asdict(errors).items() if value is not None}
    form = table.form
    return {"part": form.part or "programme", "kind": form.kind, "rows": form.rows, "span": table.span, "errors": known}


def table_messages(table: Table, errors: Errors, layout: Layout) -> list[str]:
    """Messages about a table, one line each: its size, then its errors."""
    form = table.form
    name = {"": "programme", "runup": "run-up", "rundown": "run-down"}[form.part]
    parts = f"{form.rows} {'intervals' if form.kind == 'quintic' else 'harmonics'}"
    lines = [f"{name}: {form.kind}, {parts}, {layout.precision.name}, {table.span:g} s"]
    lines.append(
        f"{name}: largest error: angle {errors.phi:.1e} rad, speed {errors.phi_dot:.1e} rad/s, "
        f"acceleration {errors.phi_ddot:.1e} rad/s2, together {errors.relative:.1e} of the largest acceleration"
    )
    if errors.tau is not None:
        lines.append(f"{name}: largest error of the drive torques {errors.tau:.1e} N m, of {errors.tau_peak:.3g} N m")
    else:
        lines.append(f"{name}: no drive torques: no motion was given")
    if errors.added is not None:
        lines.append(f"{name}: relative residual {errors.given:.1e}, the table adds {errors.added:.1e}")
    return lines


def element_type(folder: Path, stand: Stand, real: str | None, usual: str = "double") -> str:
    """Element type for the C in a folder: the given one, else that of the stand's header there, else the usual one.

    Raises UsageError if the two differ, CheckError if the header is of another stand.
    """
    header = read_header(folder, stand.name)
    if header is None or header.real is None:
        return real or usual
    hashes = identities(stand)
    if (header.structure, header.physics) != (hashes.structure, hashes.physics):
        raise CheckError(
            f"{folder / stand.name}.h: is of another stand (structure {header.structure}, physics {header.physics}; "
            f"the stand file has {hashes.structure}, {hashes.physics}): generate it again or choose another folder"
        )
    if real is not None and real != header.real:
        raise UsageError(f"real {real}: {folder / stand.name}.h has {header.real}; leave it out")
    return header.real


def files_in(folder: Path, stand: Stand) -> tuple[str, ...]:
    """Names of the files of the programmes and servos that a folder has beside the C of a stand, by their manifests."""
    known = [of["files"] for of in manifests_beside(folder, stand).values() if {"programme", "servo"} & of.keys()]
    return tuple(name for listed in known for name in listed if (folder / name).is_file())


def refuse_foreign(folder: Path, stand: Stand, what: str, files: Mapping[str, str], called: str = "") -> None:
    """Raise UsageError if one of the files would overwrite a file that mahovik has not written.

    Files that mahovik has written are listed in the manifest of the programme or servo, `what`, with their hash.
    """
    manifest = f"{stand.name}_{called or what}.json"
    there = manifest_there(folder, manifest)
    listed = there["files"] if there and what in there else None
    for name, text in files.items():
        path = folder / name
        if not path.is_file() or path.read_bytes() == text.encode("utf-8"):
            continue
        if name == manifest and listed is not None:
            continue
        if listed is None or listed.get(name) != digest(path.read_bytes()):
            why = "was changed by hand" if listed is not None and name in listed else "was not written by mahovik"
            raise UsageError(f"{path}: {why}: move it away or choose another folder, nothing was written")


MOST_HARMONICS = 120
"""Most harmonics of a Fourier table."""

TAIL = {"double": 1e-10, "float": 1e-6}
"""Harmonics are left out as long as their sum is below this part of the largest acceleration, or torque."""

FINE_MEAN = 2.0**20
"""Mean angles of a quintic table are multiples of 1/FINE_MEAN, which a float holds exactly."""

_FINE, _TORQUES = 1024, 256
"""Samples per period for the Fourier coefficients of angles and of torques."""

Array = NDArray[np.float64]
At = Callable[[Array], Angles]
Torques = Callable[[Array], Array]


@dataclass(frozen=True)
class Table:
    """A table's form and numbers, and its exact source: angles (and torques) at times 0..span (M, s)."""

    form: Form
    value: dict[str, Any]
    span: float
    at: At
    torques: Torques | None


def quintic_table(form: Form, at: At, span: float, winding: tuple[int, ...], torques: Torques | None) -> Table:
    """Nodes at equal times."""
    t = np.arange(float(form.rows + (0 if form.cyclic else 1))) * (span / form.rows)
    angles = at(t)
    turn = 2 * np.pi * np.array(winding, dtype=np.float64)
    if form.cyclic:
        phi = _near_zero(angles.phi - (t / span)[:, None] * turn)
        mean = np.round(np.mean(phi, axis=0) * FINE_MEAN) / FINE_MEAN
        phi = phi - mean
        phi_dot = angles.phi_dot - turn / span
    else:
        phi, phi_dot = _in_half_a_turn(angles.phi), angles.phi_dot
    columns = {"phi": phi, "phi_dot": phi_dot, "phi_ddot": angles.phi_ddot}
    if torques is not None:
        columns["tau"] = torques(t)
    value: dict[str, Any] = {"step": span / form.rows, "rate": form.rows / span}
    if form.cyclic:
        value |= _winding(winding, span) | {"mean": list(map(float, mean))}
    value["node"] = [{name: list(map(float, c[i])) for name, c in columns.items()} for i in range(len(t))]
    return Table(form, value, span, at, torques)


def fourier_table(programme: Programme, count: NamedCount, torques: Torques | None, real: str) -> Table:
    """Fourier coefficients of a periodic programme of `count` flywheels, without negligible harmonics."""
    span = programme.span
    mean, cos, sin = _angles(programme)
    order = np.arange(1.0, len(cos) + 1.0)[:, None]
    sizes = order**2 * np.hypot(cos, sin)
    rows = kept = _harmonic_count(sizes, float(np.max(sizes)) * TAIL[real])
    value: dict[str, Any] = {"omega": 2 * np.pi / span, "mean": list(map(float, mean))}
    if torques is not None:
        tau = torques(np.arange(float(_TORQUES)) / _TORQUES * span)
        tau_mean, tau_cos, tau_sin = coefficients(tau)
        rows = max(rows, _harmonic_count(np.hypot(tau_cos, tau_sin), float(np.max(np.abs(tau))) * TAIL[real]))
        value["tau_mean"] = list(map(float, tau_mean))
    rows = max(1, rows)
    cos, sin = (np.where(order <= kept, part, 0.0) for part in (cos, sin))
    form = Form("", "fourier", rows, True, torques is not None, count)
    columns = {"cos": cos, "sin": sin}
    if torques is not None:
        columns |= {"tau_cos": tau_cos, "tau_sin": tau_sin}
    value["harmonic"] = [{name: list(map(float, c[k])) for name, c in columns.items()} for k in range(rows)]
    return Table(form, value | _winding(programme.winding, span), span, programme.at, torques)


def _angles(programme: Programme) -> tuple[Array, Array, Array]:
    """mean, cos, sin of the periodic part of the angles: from the file, padded with zeros, or from samples.

    Coefficients of samples at the level of rounding become zero, since squares of high orders would amplify them.
    """
    if isinstance(programme.course, Fourier):
        parts = (programme.course.cos[:MOST_HARMONICS], programme.course.sin[:MOST_HARMONICS])
        cos, sin = (np.vstack([part, np.zeros((MOST_HARMONICS - len(part), part.shape[1]))]) for part in parts)
        return _near_zero(programme.course.mean[None, :])[0], cos, sin
    x = np.arange(float(_FINE)) / _FINE
    turn = 2 * np.pi * np.array(programme.winding, dtype=np.float64)
    mean, cos, sin = coefficients(_near_zero(programme.at(x * programme.span).phi - x[:, None] * turn))
    sizes = np.hypot(cos, sin)
    real = sizes > 1e-14 * max(1.0, float(np.max(sizes)))
    return mean, np.where(real, cos, 0.0), np.where(real, sin, 0.0)


def coefficients(samples: Array) -> tuple[Array, Array, Array]:
    """mean (N), cos, sin (H, N) of samples (M, N) of a period; H = MOST_HARMONICS."""
    result = np.fft.rfft(samples, axis=0) / len(samples)
    first = result[1 : MOST_HARMONICS + 1]
    return result[0].real, 2 * first.real, -2 * first.imag


def _harmonic_count(sizes: Array, least: float) -> int:
    """Number of harmonics after which the rest sum to less than `least`."""
    tails = np.cumsum(np.max(sizes, axis=1)[::-1])[::-1]
    above = np.flatnonzero(tails > least)
    return int(above[-1]) + 1 if len(above) else 0


def _winding(winding: tuple[int, ...], span: float) -> dict[str, Any]:
    return {"winding": list(winding), "speed": [2 * np.pi * n / span for n in winding]}


def _near_zero(phi: Array) -> Array:
    """Angles without whole turns in the means, so that a float keeps digits for the variation."""
    turns: Array = np.round(np.mean(phi, axis=0) / (2 * np.pi))
    return phi - 2 * np.pi * turns


def _in_half_a_turn(phi: Array) -> Array:
    return phi - 2 * np.pi * np.round(phi / (2 * np.pi))


POINTS = 1024
"""Times at which a table is compared."""

WRENCHES = 100
"""Times among them at which the reference is evaluated."""


@dataclass(frozen=True)
class Errors:
    """Largest differences between a table and its programme.

    phi, phi_dot, phi_ddot   rad, s
    relative   of the force of an unbalance, over its largest
    tau, tau_peak   of the drive torques, and the largest torque, N m; None without torques
    given, added    relative residual of the programme, and the part added by the table; None for a run-up, or without a
                    motion
    """

    phi: float
    phi_dot: float
    phi_ddot: float
    relative: float
    tau: float | None = None
    tau_peak: float | None = None
    given: float | None = None
    added: float | None = None

    @property
    def decisive(self) -> float:
        """The error that is compared with the limit."""
        return self.relative if self.added is None else self.added


def errors(
    player: Player, course: Course, table: Table, precision: Precision, prescribed: ProgrammeCase | None
) -> Errors:
    """Errors of one table; the wrench is evaluated for the programme only, whose carrier moves as prescribed."""
    phases = np.array([float(precision.scalar(x)) for x in spread_phases(POINTS)])
    t = phases * table.span
    played = player.many(course, list(phases))
    truth = table.at(t)
    of_angles = deviations_of(Angles(*(played[name] for name in Angles._fields)), truth)
    if table.torques is None:
        return Errors(*of_angles)
    some = np.linspace(0, POINTS - 1, WRENCHES).astype(int)
    tau = table.torques(t[some])
    wrong_tau, peak = float(np.max(np.abs(played["tau"][some] - tau))), float(np.max(np.abs(tau)))
    if prescribed is None:
        return Errors(*of_angles, wrong_tau, peak)
    exact, tabled = Angles(*(array[some] for array in truth)), Angles(*(played[name][some] for name in Angles._fields))
    R, added = (prescribed.equations(t[some], angles)[0] for angles in (exact, tabled))
    shares = (float(np.max(prescribed.scale.wrench_share(wrench))) for wrench in (R, added - R))
    return Errors(*of_angles, wrong_tau, peak, *shares)
