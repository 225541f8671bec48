"""Singular values of the scaled coupling: how well the flywheels can move the carrier along their way."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.model import Stand
from mahovik.out.report.plot.inline import charts
from mahovik.out.report.plot.panel import Array, Panel, family
from mahovik.out.report.stand.markup import paragraph
from mahovik.out.report.stand.material import Material, Section
from mahovik.out.report.stand.run import some_rows
from mahovik.use.plan.certificate import singular_values
from mahovik.use.plan.residual import Mechanics

MOST = 3000
"""Times or angles looked at."""

POINTS = 720
"""Points along a turn or a programme."""

NEAR = 1e-2
"""Part of the largest singular value below which the least one is shaded."""

SCALED, HELD_SCALED = "K^-1/2 I Theta_ff^-1/2", "(S^T K S)^-1/2 S^T I Theta_ff^-1/2"
"""The scaled I of (12), of a free and of a held carrier."""

LEAST = 1e-12
"""Value drawn for a singular value of zero."""


def section(material: Material) -> Section | None:
    """The section; None without flywheels, and of a clamped carrier."""
    hold = material.stand.hold
    if not material.stand.flywheels or (hold is not None and not hold.freedoms):
        return None
    x, abscissa, phi, where = course(material)
    sigma, _ = singular_values(Mechanics.of(material.stand), phi)
    shown = panels(x, abscissa, sigma)
    found = condition(sigma)
    worst = int(np.argmax(found))
    extremes = f"condition number {_number(found.min())} to {_number(found[worst])}"
    place = f"largest at {abscissa.split(',')[0]} = {x[worst]:.4g} {abscissa.split(', ')[1]}"
    words = (
        f"Of ``{SCALED if hold is None else HELD_SCALED}`` in (12), as ``inverse`` scales it: the same for any units, "
        f"origin and axes, and always below 1. {where} The {extremes}, {place}. "
    )
    words += _rank(sigma, material.stand)
    return Section(
        "singular",
        "Singular values of the scaled I",
        "".join([paragraph(words), charts(shown)]),
        summary=extremes,
    )


def course(material: Material) -> tuple[Array, str, Array, str]:
    """Abscissa (M), its name, angles (M, N; rad), and where these are from, in words: run, programme or one turn."""
    run, programme = material.run, material.programme
    if run is not None:
        rows = some_rows(len(run.t), MOST)
        words = "Along the run." if len(rows) == len(run.t) else f"Along the run, at {len(rows)} of its rows."
        return run.t[rows], "t, s", run.phi[rows], words
    if programme is not None:
        t = np.linspace(0.0, programme.span, POINTS + 1)
        return t, "t, s", programme.at(t).phi, "Along the programme."
    turn = np.linspace(0.0, 360.0, POINTS + 1)
    phi = np.tile(np.radians(turn)[:, None], len(material.stand.flywheels))
    return turn, "angle, deg", phi, "Over one turn of all flywheels together; other angles give other values."


def panels(x: Array, abscissa: str, sigma: Array) -> list[Panel]:
    """Singular values, and their condition number."""
    names = [f"σ{k + 1}" for k in range(sigma.shape[1])]
    shaded = stretches(x, sigma[:, -1] < NEAR * sigma[:, 0])
    note = f"shaded: least below {NEAR:g} of the largest" if shaded else ""
    ratio = np.where(np.isfinite(found := condition(sigma)), found, np.nan)
    shown = [
        Panel(
            "singular values of the scaled I", family(names, x, np.maximum(sigma, LEAST)), log=True, abscissa=abscissa,
            height=1.3, shaded=shaded, note=note,
        )
    ]  # fmt: skip
    if sigma.shape[1] > 1:
        lines = family(["largest over least"], x, ratio[:, None])
        shown.append(Panel("condition number", lines, log=True, abscissa=abscissa, height=1.3, shaded=shaded))
    return shown


def condition(sigma: Array) -> Array:
    """Largest over least (M); infinite where the least is zero."""
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(np.where(sigma[:, -1] > LEAST * sigma[:, 0], sigma[:, 0] / sigma[:, -1], np.inf))


def stretches(x: Array, flags: NDArray[np.bool_]) -> tuple[tuple[float, float], ...]:
    """Intervals where flags (M) are set, up to the middle of the neighbours."""
    if not len(x):
        return ()
    edges = np.concatenate([x[:1], (x[1:] + x[:-1]) / 2.0, x[-1:]])
    change = np.flatnonzero(np.diff(np.concatenate([[False], flags, [False]]).astype(int)))
    return tuple((float(edges[a]), float(edges[b])) for a, b in zip(change[::2], change[1::2], strict=True))


def _rank(sigma: Array, stand: Stand) -> str:
    """Sentences about the number of flywheels and of zeros."""
    columns = sigma.shape[1]
    directions = 6 if stand.hold is None else len(stand.hold.freedoms)
    if columns < directions:
        who = "1 flywheel moves" if columns == 1 else f"{columns} flywheels move"
        return f"{who} the carrier in at most {columns} of its {directions} directions at once. "
    lost = float((sigma[:, -1] < NEAR * sigma[:, 0]).mean())
    if lost:
        return f"For {100.0 * lost:.3g} % of it the least is below {NEAR:g} of the largest: accelerations grow there. "
    return ""


def _number(x: float) -> str:
    return f"{x:.4g}" if math.isfinite(x) else "infinite"
