"""Raw data of the cross-flow drag of one body, as the stand file gives them, in SI."""

from __future__ import annotations

from dataclasses import dataclass

from mahovik.core.stand.model import LawData


@dataclass(frozen=True)
class CrossFlow(LawData):
    """Drag of the motion across the first axis of a body: -(density/2) integral (C_y h |v| v, C_z b |w| w) dx.

    v, w        velocity of the place x of the axis relative to the fluid, along y and z of the body
    x           stations, m, rising; between them all tables are linear
    height      h (m) of the body along z at the stations, which meets v; `breadth`: b along y, which meets w
    drag_y      C_y at the stations, and `drag_z` C_z
    points      points of Gauss and Legendre between two stations
    together    the drag is along the whole velocity across: (C_y h v^2 + C_z b w^2) (v, w)/sqrt(v^2 + w^2)
    """

    density: float
    x: tuple[float, ...]
    height: tuple[float, ...]
    breadth: tuple[float, ...]
    drag_y: tuple[float, ...]
    drag_z: tuple[float, ...]
    points: int
    together: bool

    @property
    def nonlinear(self) -> bool:
        """True: it is quadratic."""
        return True

    @property
    def has_kinks(self) -> bool:
        """True: it depends on magnitudes."""
        return True
