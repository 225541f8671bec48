"""Where every body is on the carrier, its mass and its inertia about its own mass centre: one column per body."""

from __future__ import annotations

import casadi as ca
import numpy as np

from mahovik.core.stand.model import Body, Stand
from mahovik.proof.second.chart import Chart, Expr, turn
from mahovik.proof.second.rotation import Array, elementary, fixed_rotation, mounting

Place = tuple[Array, Array]
"""Origin (3; m, from O1) and axes (3x3) in E1; a flywheel's at phi_s = 0."""

SIZE = 25
"""Numbers of a body: origin 3, axes 9, mass 1, mass centre 3, inertia 9."""


def places(stand: Stand) -> dict[str, Place]:
    """Place of the carrier, every instrument, flywheel and point, by name."""
    found: dict[str, Place] = {stand.carrier.name: (np.zeros(3), np.eye(3))}
    for p in stand.instruments:
        found[p.name] = (np.array(p.position), fixed_rotation(p.angles))
    for s in stand.flywheels:
        found[s.name] = place_in_E1(found[s.mount], (np.array(s.position), mounting(s.mounting)))
    for point in stand.points:
        found[point.name] = place_in_E1(found[point.mount], (np.array(point.position), fixed_rotation(point.angles)))
    return found


def place_in_E1(mount: Place, place: Place) -> Place:
    """A place in the mount's frame as a place in E1."""
    (at, axes), (position, rotation) = mount, place
    return at + axes @ position, axes @ rotation


def central_inertia(body: Body) -> Array:
    """Tensor of inertia about the mass centre (3x3; kg m2), on the body's axes."""
    J, c = np.array(body.inertia), np.array(body.center_of_mass)
    if body.inertia_about == "center_of_mass":
        return J
    return np.asarray(J - body.mass * (float(c @ c) * np.eye(3) - np.outer(c, c)))


def columns(stand: Stand) -> Array:
    """The numbers of all bodies (SIZE x bodies): carrier, instruments, flywheels."""
    where = places(stand)
    return np.column_stack([_column(body, where[body.name]) for body in stand.bodies])


def _column(body: Body, place: Place) -> Array:
    origin, axes = place
    J = central_inertia(body)
    return np.concatenate([origin, axes.ravel("F"), [body.mass], body.center_of_mass, J.ravel("F")])


class MovingBody:
    """One generic body as expressions in the coordinates of a chart; `numbers` is its column.

    A body fixed on the carrier is one whose phi stays 0.
    """

    def __init__(self, chart: Chart) -> None:
        self.chart = chart
        self.numbers = ca.SX.sym("body", SIZE)
        split = ca.vertsplit(self.numbers, [0, 3, 12, 13, 16, 25])
        self._origin, axes, self.mass, self.center_of_mass, J = split
        self.central_inertia = ca.reshape(J, 3, 3)
        self._turned = turn(chart.xi)
        self._axes = ca.reshape(axes, 3, 3) @ elementary(1, chart.phi)

    def place(self, own: Expr) -> Expr:
        """x = delta + E(xi) rho (3; m): where a point `own` of the body's frame is."""
        return self.chart.delta + self._turned @ (self._origin + self._axes @ own)

    def axes(self) -> Expr:
        """R = E(xi) G(phi) (3x3): the body's axes."""
        return self._turned @ self._axes
