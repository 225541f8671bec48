"""Natural frequencies against the speed of the flywheels."""

from __future__ import annotations

import math

import numpy as np

from mahovik.contract.quantities import RPM
from mahovik.core.stand.summary import summarize
from mahovik.errors import CheckError
from mahovik.out.report.plot.inline import charts
from mahovik.out.report.plot.panel import Array, Line, Mark, Panel
from mahovik.out.report.stand.markup import figure, message, paragraph, table
from mahovik.out.report.stand.material import Material, Section
from mahovik.use.study.campbell import Campbell, campbell, mean_equations
from mahovik.use.study.growth import compare_growth
from mahovik.use.study.response.held import HeldScene
from mahovik.use.study.response.periodic import scene_of
from mahovik.use.study.response.scene import Scene

POINTS = 121
"""Speeds in each diagram."""

NEAR, FAR = 1.6, 2.0
"""The near diagram ends at this many times the last crossing; it is drawn if the limit is this many times that."""

TOP = 1.15
"""End of the ordinate, in units of the highest natural frequency."""

ROOM = 0.15
"""Fraction of the axis kept free for labels."""

ROUNDING = 1e-12
"""Damping ratio that is rounding."""

STILL = 1e-6
"""Part of the largest eigenvalue below which one is zero."""

ANCHOR, TITLE = "campbell", "Campbell diagram: natural frequencies against speed"


def section(material: Material) -> Section | None:
    """The section; None without flywheels, and of a clamped carrier."""
    stand = material.stand
    if not stand.flywheels or (stand.hold is not None and not stand.hold.freedoms):
        return None
    try:
        scene = scene_of(stand)
    except CheckError as error:
        words = f"{message(error)}. So there is no pose to be linear about, and no natural frequency."
        return Section(ANCHOR, TITLE, paragraph(words))
    limit = max(row.speed for row in summarize(stand).unbalance)
    found = campbell(scene, np.linspace(0.0, limit, POINTS))
    if not np.isfinite(found.natural).any():
        return Section(ANCHOR, TITLE, paragraph(_nothing(scene, found)))
    last = max((each.speed for each in found.crossings), default=0.0) or _meeting(found)
    split = 0.0 < FAR * NEAR * last < limit
    wide = found
    if split:
        near = campbell(scene, np.linspace(0.0, NEAR * last, POINTS))
        found = _join_diagrams(near, wide)
    absent = int((~np.isfinite(found.natural).any(axis=0)).sum())
    shown = [panel(wide, "up to the limit of speed", absent)]
    if split:
        shown.insert(0, panel(near, "where the orders cross", absent))
    parts = [paragraph(_words(scene, found)), charts(shown), _table(found, absent)]
    still = found.natural[0][np.isfinite(found.natural[0])]
    summary = f"natural frequencies up to {float(np.nanmax(found.natural)):.3g} Hz"
    if still.size:
        summary = (
            "natural frequencies at rest " + " to ".join(dict.fromkeys(f"{x:.3g}" for x in still[[0, -1]])) + " Hz"
        )
    if found.crossings:
        summary += f"; {len(found.crossings)} crossings up to {RPM * found.crossings[-1].speed:.4g} rpm"
    return Section(ANCHOR, TITLE, "".join(parts), summary=summary)


def panel(found: Campbell, where: str, absent: int) -> Panel:
    """Natural frequencies, lines of orders, crossings; `absent`: the first columns that are nowhere."""
    speed, top = RPM * found.speed, TOP * float(np.nanmax(found.natural))
    lines = [
        Line(f"mode {k + 1}", speed, found.natural[:, absent + k], k) for k in range(found.natural.shape[1] - absent)
    ]
    lines += [_order(n, speed, top) for n in found.orders]
    marks = tuple(
        Mark(
            RPM * each.speed,
            each.frequency,
            f"{each.order}× meets mode {each.mode - absent} at {RPM * each.speed:.4g} rpm",
        )
        for each in found.crossings
    )
    return Panel(
        f"natural frequency, Hz: {where}", tuple(lines), abscissa="common speed, rpm", height=1.5, top=top, marks=marks,
        span=(float(speed[0]), float(speed[-1])), note="dashed: " + ", ".join(f"{n}×" for n in found.orders),
    )  # fmt: skip


def _order(n: int, speed: Array, top: float) -> Line:
    """n times the speed, up to where it leaves the frame; labelled by its number if there is room."""
    x = np.minimum(np.array([0.0, 1.0]) * speed[-1], 60.0 * top / n)
    tag = f"{n}×" if x[1] > ROOM * speed[-1] else ""
    return Line("", x, n * x / 60.0, None, dashed=True, tag=tag)


def _join_diagrams(near: Campbell, far: Campbell) -> Campbell:
    """Crossings of the near diagram, where the grid is finer, and those beyond it."""
    beyond = tuple(each for each in far.crossings if each.speed > near.speed[-1])
    growth = np.concatenate([near.growth, far.growth])
    speed = np.concatenate([near.speed, far.speed])
    order = np.argsort(speed, kind="stable")
    natural, damping = (
        np.concatenate([getattr(near, name), getattr(far, name)])[order] for name in ("natural", "damping")
    )
    return Campbell(speed[order], natural, damping, growth[order], far.orders, (*near.crossings, *beyond))


def _meeting(found: Campbell) -> float:
    """rad/s: at which 1x passes the highest natural frequency at rest."""
    still = found.natural[0]
    return 2.0 * math.pi * float(np.nanmax(still)) if np.isfinite(still).any() else 0.0


def _nothing(scene: Scene | HeldScene, found: Campbell) -> str:
    """Why nothing swings at any speed."""
    free, count, held = scene.free.shape[1], scene.count, isinstance(scene, HeldScene)
    if free == count:
        where, spin = "along or about any axis", "have no net momentum that would make it swing"
        if held:
            where, spin = "in any freedom of the hold", "make it swing in none"
        return (
            f"Nothing brings the carrier back {where}, and flywheels at one common speed {spin}: their spin inertias "
            f"add up as vectors to {_net(scene)}. There is no natural frequency. {_growth(scene, found)}"
        )
    values = np.linalg.eigvals(mean_equations(scene, np.zeros(1)))[0].real
    rates = [f"{x:.4g}" for x in sorted(values.tolist()) if abs(x) > STILL * np.abs(values).max()]
    where = f"in {count - free} of {count} directions" if free else "in every direction"
    return (
        f"The carrier has a stiffness {where}, but swings at no speed of this range: deviations change by exponentials "
        f"alone, as above critical damping, at rest with eigenvalues of {', '.join(rates)} 1/s. There is no frequency "
        f"of swinging that an order could meet. {_growth(scene, found)}"
    )


def _net(scene: Scene | HeldScene) -> str:
    tables = scene.chart.mechanics.tables
    net = tables.Theta_ff @ tables.axis
    size = float(np.linalg.norm(net))
    whole = float(tables.Theta_ff.sum())
    if size <= 1e-9 * whole:
        return "0"
    return f"{size:.3g} kg m2 of {whole:.3g} kg m2"


def _words(scene: Scene | HeldScene, found: Campbell) -> str:
    free, count = scene.free.shape[1], scene.count
    law = "(8)" if scene.stand.hold is None else "(8) along the freedoms of the hold"
    words = (
        f"Small motions of the carrier about rest, {law}, made linear, while all flywheels keep one common speed; "
        "means over a turn. What splits and bends the lines is gyroscopic: the flywheels' spin inertias, which add up "
        f"as vectors to {_net(scene)}. "
    )
    if free == count:
        words += "Nothing brings the carrier back: what swings here does so by spin alone. "
    elif free:
        words += f"{free} of {count} directions are free and have no natural frequency at rest. "
    twice = "at 2× asymmetric flywheels vary K" if 2 in found.orders else "no flywheel is asymmetric, so there is no 2×"
    words += f"1× is the order that unbalance drives; {twice}. "
    return words + _growth(scene, found)


def _growth(scene: Scene | HeldScene, found: Campbell) -> str:
    """What growth in the means says, by steady motions at the speeds that have it."""
    growth = compare_growth(scene, found)
    if growth is None:
        return ""
    if growth.unstable is not None:
        return (
            f"The stand is unstable at {RPM * growth.unstable:.4g} rpm, the lowest of the speeds tried at which "
            "deviations from steady motion grow. "
        )
    words = f"From {RPM * growth.first:.4g} rpm on a mode of the mean grows, by at most {growth.largest:.2g} 1/s, "
    if not growth.found:
        return words + "but no steady motion was found there that could be unstable, so that this shows nothing. "
    return (
        f"{words}which shows no instability, for rest is no steady motion where flywheels turn: deviations from the "
        f"steady motions at {growth.found} of these speeds have multipliers of at most "
        f"1 + {max(growth.multiplier - 1.0, 0.0):.1g} over a turn. "
    )


def _table(found: Campbell, absent: int) -> str:
    if not found.crossings:
        return paragraph("No order crosses a natural frequency in this range.")
    rows = [
        [
            f"{each.order}×",
            str(each.mode - absent),
            figure(RPM * each.speed),
            figure(each.frequency),
            figure(each.damping if abs(each.damping) > ROUNDING else 0.0, 3),
        ]
        for each in found.crossings
    ]
    return table(["order", "mode>", "speed, rpm>", "frequency, Hz>", "damping ratio>"], [rows], "Crossings")
