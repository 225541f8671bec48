"""Bodies: masses, inertia and unbalance; drives; what acts on the stand."""

from __future__ import annotations

import math

import numpy as np
from markupsafe import Markup

from mahovik.contract.laws import of_bodies
from mahovik.contract.quantities import RPM
from mahovik.core.stand.inertia import inertia_about_center, inertia_about_origin
from mahovik.core.stand.model import Body, Carrier, Instrument, Stand
from mahovik.core.stand.summary import Summary, UnbalanceRow, forces_along_freedoms, summarize
from mahovik.out.report.stand.inertia import axes_table, inertia_table, products_table
from mahovik.out.report.stand.markup import Cell, definitions, figure, figures, paragraph, side_by_side, table, verdict
from mahovik.out.report.stand.material import Material, Section
from mahovik.out.report.stand.matrices import Side, matrix
from mahovik.out.report.stand.surroundings import surroundings
from mahovik.use.study.resolution import shortfalls


def section(material: Material) -> Section | None:
    """Tables of bodies, flywheels and drives; what acts on them, in words; warnings."""
    stand = material.stand
    summary = summarize(stand)
    blocks = [_bodies(stand, summary), products_table(stand), inertia_table(stand)]
    if stand.flywheels:
        blocks += [_flywheels(stand, summary), axes_table(stand), _drives(stand)]
    acting = Markup("<h3>What acts on it</h3>\n") + definitions(surroundings(stand))
    blocks += [_added_mass(stand), acting + _along_freedoms(stand)]
    parts = [side_by_side(blocks)]
    short = shortfalls(stand, [row.speed for row in summary.unbalance])
    for words in (*summary.warnings, *map(str, short)):
        parts.append(Markup("<p>{}: {}</p>\n").format(verdict("Warning", "warn"), words))
    return Section("bodies", "Bodies", Markup("").join(parts))


def _bodies(stand: Stand, summary: Summary) -> Markup:
    head: tuple[Cell, ...] = (
        "body", "kind", "on", "mass, kg>", "x, mm>", "y, mm>", "z, mm>", Markup("J<sub>11</sub>, kg m²>"),
        Markup("J<sub>22</sub>, kg m²>"), Markup("J<sub>33</sub>, kg m²>"),
    )  # fmt: skip
    places = [[_clean(1e3 * x) for x in row.center_of_mass] for row in summary.bodies]
    whole = [_clean(1e3 * x) for x in summary.center_of_mass]
    moments = np.array([np.diag(inertia_about_center(body)) for body in stand.bodies])
    columns = [
        figures([*(row.mass for row in summary.bodies), summary.mass]),
        *(figures([*(place[i] for place in places), whole[i]]) for i in range(3)),
        *([*figures(moments[:, i].tolist()), Markup("")] for i in range(3)),
    ]
    rows: list[list[Cell]] = []
    for title, cells in (column(stand) for column in of_bodies("report", "column")):
        if cells:
            head, columns = (*head, title), [*columns, cells]
    for number, row in enumerate(summary.bodies):
        rows.append([row.name, row.kind, row.mount, *(column[number] for column in columns)])
    foot: list[Cell] = ["all", "", "", *(column[-1] for column in columns)]
    kinds = [[row for row in rows if row[1] == kind] for kind in ("carrier", "instrument", "flywheel")]
    words = paragraph(
        "Centres of mass in axes of the carrier, `E_1`, about its origin `O_1`, flywheels at phase zero. Moments of "
        "inertia about the mass centre of each body, in its own axes; axis 1 of a flywheel is its spin axis."
    )
    return words + table(head, [group for group in kinds if group], foot=foot)


def _flywheels(stand: Stand, summary: Summary) -> Markup:
    head = (
        "flywheel", "spin inertia, kg m²>", "transverse, kg m²>", "static, g mm>", "dynamic, g mm²>",
        "dynamic about mass centre, g mm²>", Markup("J<sub>22</sub> − J<sub>33</sub>, g mm²>"),
        Markup("J<sub>23</sub>, g mm²>"), "at, rpm>", "force, N>", "moment, N m>", "e Ω, mm/s>",
    )  # fmt: skip
    numbers = [_flywheel(row, body) for row, body in zip(summary.unbalance, stand.flywheels, strict=True)]
    columns = [figures(column, 4) for column in zip(*numbers, strict=True)]
    rows = [[s.name, *cells] for s, *cells in zip(stand.flywheels, *columns, strict=True)]
    words = paragraph(
        "Inertias and unbalance about the origin of each flywheel, on its spin axis, and about its mass centre where "
        "the table says so. Transverse: the mean of `J_{22}` and `J_{33}`. Force and moment are those of the unbalance "
        "at the speed shown: of the motor without load, else 3000 rpm; e Ω is the eccentricity times that speed, "
        "compared with the balance grades G of ISO 21940-11."
    )
    reach = Markup("<p>All unbalance forces in one line, at these speeds: {} N.</p>\n").format(figure(summary.force))
    return Markup("<h3>Flywheels</h3>\n") + words + table(head, [rows]) + reach


def _flywheel(row: UnbalanceRow, body: Body) -> tuple[float, ...]:
    J = inertia_about_origin(body)
    transverse = 0.5 * float(J[1, 1] + J[2, 2])
    velocity = 1e3 * row.static / body.mass * row.speed if body.mass else math.nan
    return (
        row.spin_inertia, transverse, 1e6 * row.static, 1e9 * row.dynamic, 1e9 * row.dynamic_center,
        1e9 * row.asymmetry, 1e9 * row.product, row.speed * RPM, row.force, row.moment, velocity,
    )  # fmt: skip


def _drives(stand: Stand) -> Markup:
    """Motors and encoders, where there are any."""
    rows: list[list[Cell]] = []
    for s in stand.flywheels:
        motor, encoder = s.motor, s.encoder
        if motor is None and encoder is None:
            continue
        values: list[float | None] = [None] * 7
        if motor is not None:
            no_load = None if motor.speed is None else RPM * motor.speed
            values[:5] = [motor.torque, no_load, motor.constant, motor.coulomb, motor.viscous]
        if encoder is not None:
            values[5:] = [encoder.counts, 1e6 * encoder.latency]
        rows.append([s.name, *("–" if value is None else figure(value) for value in values)])
    if not rows:
        return Markup("")
    head = (
        "flywheel", "torque, N m>", "no-load speed, rpm>", "constant, N m/A>", "Coulomb, N m>", "viscous, N m s>",
        "counts per turn>", "latency, µs>",
    )  # fmt: skip
    return Markup("<h3>Drives and encoders</h3>\n") + table(head, [rows])


def _along_freedoms(stand: Stand) -> Markup:
    """Friction and stops of the freedoms of a hold, where there are any."""
    rows: list[list[Cell]] = []
    for each in forces_along_freedoms(stand):
        (value,), unit = each.printed
        rows.append([each.of, each.name.replace("_", " "), figure(value), _power(unit)])
    head = ("along the freedoms of the hold", "number", "value>", "unit")
    return table(head, [rows]) if rows else Markup("")


def _power(unit: str) -> str:
    """A unit with its squares raised; of a basis, whose numbers have none of their own, SI."""
    return unit.replace("^2", "²") or "SI"


def _added_mass(stand: Stand) -> Markup:
    """Lambda of carrier and instruments."""
    axes = Side((("force", ("1", "2", "3")), ("moment", ("1", "2", "3"))))
    twist = Side((("v∗, m/s²", ("1", "2", "3")), ("ω∗, rad/s²", ("1", "2", "3"))))
    found = Markup("")
    bearers: list[Carrier | Instrument] = [stand.carrier, *stand.instruments]
    for body in bearers:
        if body.added_mass is not None:
            values = np.array(body.added_mass)
            words = f"Added mass of {body.name}: kg, kg m, kg m²; about O₁ in axes of E₁"
            found += matrix(words, values, np.zeros_like(values), axes, twist)
    return Markup("<h3>Added mass</h3>\n") + found if found else found


def _clean(millimetres: float) -> float:
    """Without the rounding of a sum that is zero."""
    return 0.0 if abs(millimetres) < 1e-10 else millimetres
