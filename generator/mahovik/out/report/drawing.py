"""Three views of a stand, to scale, in third-angle projection: bodies, spin axes, unbalance, ties.

The file gives no shapes. A carrier or an instrument is drawn as the homogeneous ellipsoid of its mass, centre of mass
and inertia; a flywheel as the homogeneous cylinder of its mass and of its inertia along and across its axis.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.coordinates import places_of
from mahovik.core.stand.law import CarrierLaw
from mahovik.core.stand.masses import inertia_about_center, inertia_about_origin, pose
from mahovik.core.stand.model import Body, Flywheel, Stand
from mahovik.core.stand.summary import summarize
from mahovik.out.plots import COLOURS, GREY, STYLE, require

Array = NDArray[np.float64]

BARE, FAR = 0.04, 2.5
"""Radius of bodies without mass, length of a tie beyond which it is cut off, as shares of the stand's size."""

WIDTH, HEIGHT = 6.4, 4.6
"""Inches that the three views may take."""

STATIC, DYNAMIC, INK = "#b3261e", "#0550ae", "#1b1f24"

TURN = np.linspace(0.0, 2.0 * np.pi, 73)
CIRCLE = np.stack([np.cos(TURN), np.sin(TURN)])


@dataclass(frozen=True, eq=False)
class Disc:
    """A flywheel at phi = 0: the cylinder of its mass and inertia, in E1 about O1.

    center          3, m: on the axis, where the centre of mass is along it
    C               3x3: axes of Es as columns; the first is the spin axis
    radius, thickness   m; thickness 0 where the inertia is that of a flat disc or flatter
    static          3, kg m: first moment across the axis
    dynamic         3, kg m2: (-J12, -J13) about the origin of Es, along axes 2 and 3
    """

    name: str
    center: Array
    C: Array
    radius: float
    thickness: float
    static: Array
    dynamic: Array


def ellipsoid(body: Body) -> Array:
    """Semi-axes (columns, m, in the body's axes) of the homogeneous ellipsoid with the body's mass and inertia.

    a_i^2 = 5/(2 m) (J_j + J_k - J_i) of the principal moments about the centre of mass; zero without mass.
    """
    if not body.mass > 0.0:
        return np.zeros((3, 3))
    moments, axes = np.linalg.eigh(inertia_about_center(body))
    squares = 2.5 / body.mass * (moments.sum() - 2 * moments)
    return np.asarray(axes * np.sqrt(np.maximum(squares, 0.0)))


def disc(stand: Stand, flywheel: Flywheel, mark: float) -> Disc:
    """R^2 = 2 J11/m, h^2 = 12 Jt/m - 3 R^2 with the mean Jt of J22, J33, all about the centre of mass.

    `mark`: radius (m) of a flywheel without mass.
    """
    origin, C = pose(stand, flywheel)
    mass, center = flywheel.mass, np.array(flywheel.center_of_mass)
    central, J = inertia_about_center(flywheel), inertia_about_origin(flywheel)
    real = mass > 0.0 and bool(central[0, 0] > 0.0)
    square = 2 * float(central[0, 0]) / mass if real else mark**2
    across = 6 * float(central[1, 1] + central[2, 2]) / mass - 3 * square if real else 0.0
    return Disc(
        flywheel.name, origin + center[0] * C[:, 0], C, float(np.sqrt(square)), float(np.sqrt(max(across, 0.0))),
        mass * C[:, 1:] @ center[1:], -C[:, 1:] @ J[0, 1:],
    )  # fmt: skip


def draw_stand(stand: Stand) -> tuple[Any, str]:
    """A figure of matplotlib with the three views, and what its signs mean."""
    bodies = [stand.carrier, *stand.instruments]
    solids = []
    for body in bodies:
        at, C = pose(stand, body)
        solids.append((at + C @ np.array(body.center_of_mass), C @ ellipsoid(body)))
    reach = [float(np.linalg.norm(at) + np.abs(axes).max()) for at, axes in solids]
    reach += [float(np.linalg.norm(pose(stand, s)[0])) for s in stand.flywheels]
    discs = [disc(stand, s, BARE * (max(reach) or 1.0)) for s in stand.flywheels]
    size = max([*reach, *(float(np.linalg.norm(d.center) + d.radius) for d in discs)]) or 1.0
    gravity = np.array(stand.gravity)
    axis = int(np.argmax(np.abs(gravity))) if gravity.any() else 2
    up = (-np.sign(gravity[axis]) if gravity.any() else 1.0) * np.eye(3)[axis]
    right = np.eye(3)[1 if axis == 0 else 0]
    depth = np.cross(up, right)  # away from the eye of the front view
    matplotlib, figures = require()
    with matplotlib.rc_context(STYLE | {"svg.fonttype": "none", "axes.spines.left": False, "axes.grid": False}):
        figure = figures.Figure(figsize=(WIDTH, HEIGHT))
        views = [figure.add_axes((0.0, 0.0, 1.0, 1.0), label=name) for name in ("top", "front", "right side")]
        for frame, (x, y) in zip(views, ((right, depth), (right, up), (depth, up)), strict=True):
            _View(frame, np.stack([x, y]), np.cross(x, y), size).draw(stand, solids, discs)
        handles, names = views[1].get_legend_handles_labels()
        columns = 1 + (len(names) > 10)
        figure.legend(handles, names, loc="upper right", frameon=False, ncols=columns)
        _place(figure, views, 2.4 if columns == 1 else 3.4, 0.19 * -(-len(names) // columns))
    ties = [law.legend[1] for law in stand.laws if isinstance(law, CarrierLaw) and (law.ties or law.at_origin)]
    return figure, "; ".join(dict.fromkeys(ties))


def _place(figure: Any, views: list[Any], legend: float, rows: float) -> None:
    """Views in one scale, each beside the one that it continues; a bar of known length under the front view.

    legend, rows   inches that the legend at the upper right is wide and high
    """
    top, front, side = views
    ends = []
    for pair in (
        (top.dataLim.intervalx, front.dataLim.intervalx),
        (top.dataLim.intervaly, side.dataLim.intervalx),
        (front.dataLim.intervaly, side.dataLim.intervaly),
    ):
        low, high = float(np.min(pair)), float(np.max(pair))
        ends.append((low - 0.08 * (high - low), high + 0.08 * (high - low)))
    w, d, h = (high - low for low, high in ends)
    scale = min((WIDTH - legend - 0.2) / w, (WIDTH - 0.6) / (w + d), (HEIGHT - 1.0) / (d + h))  # inches per m
    lower = 0.45 + h * scale + 0.3
    figure.set_figheight(lower + max(d * scale, rows) + 0.3)
    across = 0.1 + w * scale + 0.4
    for axes, x, y, left, bottom in ((top, 0, 1, 0.1, lower), (front, 0, 2, 0.1, 0.45), (side, 1, 2, across, 0.45)):
        axes.set(xlim=ends[x], ylim=ends[y])
        width, height = (scale * (ends[k][1] - ends[k][0]) for k in (x, y))
        tall = figure.get_figheight()
        axes.set_position((left / WIDTH, bottom / tall, width / WIDTH, height / tall))
    bar = 10.0 ** np.floor(np.log10(0.4 * w))
    bar *= max(k for k in (1, 2, 5) if k * bar <= 0.4 * w)
    front.set_xlabel(f"bar: {bar:.4g} m", loc="left", color=GREY)
    front.plot([ends[0][0], ends[0][0] + bar], [ends[2][0]] * 2, color=INK, linewidth=3, clip_on=False)


@dataclass(frozen=True)
class _View:
    """One view: axes of matplotlib, rows right and up of the paper in E1 (2x3), unit vector to the eye, size, m."""

    axes: Any
    rows: Array
    eye: Array
    size: float

    def draw(self, stand: Stand, solids: list[tuple[Array, Array]], discs: list[Disc]) -> None:
        """All that is seen, from far to near."""
        for k, (at, semi) in enumerate(solids):
            U, s, _ = np.linalg.svd(self.rows @ semi)
            outline = (self.rows @ at)[:, None] + U @ (s[:2, None] * CIRCLE)
            name = "carrier" if k == 0 else stand.instruments[k - 1].name
            self.axes.fill(*outline, facecolor="#8881" if k == 0 else "#8882", edgecolor=GREY, label=name,
                           linestyle="-" if k == 0 else (0, (6, 2, 1, 2)), zorder=1)  # fmt: skip
        for k, disc in enumerate(discs):
            self._disc(disc, COLOURS[k % len(COLOURS)])
        self._unbalance(discs)
        self._ties(stand)
        for point in stand.points:
            self._mark(places_of(stand.instruments, stand.points)[point.name][0], "x", "points")
        middle = np.array(summarize(stand).center_of_mass)
        self._mark(middle, "$\\oplus$", "centre of mass of the whole")
        for k, name in enumerate("xyz"):
            tip = 0.3 * self.size * np.eye(3)[k]
            if np.linalg.norm(self.rows @ tip) > 0.1 * self.size:
                self._arrow(np.zeros(3), tip, INK)
                self.axes.annotate(name, self.rows @ tip, xytext=3 * np.sign(self.rows @ tip), style="italic",
                                   textcoords="offset points", ha="center", va="center")  # fmt: skip
        self.axes.set(xticks=[], yticks=[])
        self.axes.spines[:].set_visible(False)
        self.axes.set_title(self.axes.get_label(), loc="left", color=GREY, fontsize="medium")

    def _disc(self, disc: Disc, colour: str) -> None:
        from scipy.spatial import ConvexHull

        along = disc.C[:, 0] * disc.thickness / 2
        faces = [
            disc.center[:, None] + side * along[:, None] + disc.radius * disc.C[:, 1:] @ CIRCLE for side in (1, -1)
        ]
        seen = [self.rows @ face for face in faces]
        near = seen[0] if along @ self.eye >= 0 else seen[1]
        both = np.hstack(seen).T
        hull = both[ConvexHull(both, qhull_options="QJ").vertices].T
        self.axes.fill(*hull, facecolor=colour + "28", edgecolor=colour, label=disc.name, zorder=2)
        self.axes.plot(*near, color=colour, linewidth=0.7, zorder=2)
        self._arrow(disc.center, disc.center + (disc.thickness / 2 + 0.75 * disc.radius) * disc.C[:, 0], colour)

    def _arrow(self, start: Array, end: Array, colour: str, style: str = "-|>", dashed: bool = False) -> None:
        """A vector of the stand; a dot or a cross where it points at the eye or from it."""
        a, b = self.rows @ start, self.rows @ end
        if np.linalg.norm(b - a) < 0.2 * np.linalg.norm(end - start):
            self.axes.plot(*a, "." if (end - start) @ self.eye > 0 else "x", color=colour, markersize=4, zorder=4)
            return
        arrow = {"arrowstyle": style, "color": colour, "shrinkA": 0, "shrinkB": 0, "linestyle": "--" if dashed else "-"}
        self.axes.annotate("", b, a, arrowprops=arrow, zorder=4)

    def _unbalance(self, discs: list[Disc]) -> None:
        """Arrows along the unbalance, the largest of each kind as long as the largest disc is wide."""
        wide = max((1.2 * disc.radius for disc in discs), default=0.0)
        for kind, colour, dashed in (("static", STATIC, False), ("dynamic", DYNAMIC, True)):
            vectors = [getattr(disc, kind) for disc in discs]
            largest = max((float(np.linalg.norm(disc)) for disc in vectors), default=0.0)
            if largest > 0.0:
                self.axes.plot([], [], color=colour, linestyle="--" if dashed else "-", label=f"{kind} unbalance")
            for disc, vector in zip(discs, vectors, strict=True):
                if np.linalg.norm(vector) > 0.02 * largest:
                    self._arrow(disc.center, disc.center + wide / largest * vector, colour, dashed=dashed)

    def _ties(self, stand: Stand) -> None:
        """Springs to the ground, cut off where they are long; signs of what holds the carrier."""
        for law in stand.laws:
            if isinstance(law, CarrierLaw):
                for carrier, ground in law.ties:
                    start, along = np.array(carrier), np.array(ground) - np.array(carrier)
                    far = float(np.linalg.norm(along))
                    end = start + along * min(1.0, FAR * self.size / far if far else 1.0)
                    self.axes.plot(*self.rows @ np.stack([start, end], axis=1), "o-", color=GREY, markersize=2)
                if law.at_origin:
                    self._mark(np.zeros(3), "o", "held at O1")
        if stand.hold is not None and any(freedom.kind == "turn" for freedom in stand.hold.freedoms):
            self._mark(np.array(stand.hold.pivot), "^", "pivot of the hold")

    def _mark(self, place: Array, sign: str, name: str) -> None:
        known = self.axes.get_legend_handles_labels()[1]
        self.axes.plot(*self.rows @ place, marker=sign, color=INK, markersize=7, markerfacecolor="none", zorder=5,
                       linestyle="none", label=None if name in known else name)  # fmt: skip
