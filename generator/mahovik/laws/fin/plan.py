"""Fins in planning: their wrench, and the derivative of it, for M twists at once."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.core.stand.model import Body
from mahovik.laws.fin.law import Fin, Fins
from mahovik.laws.fin.program import axes_of
from mahovik.use.plan.array import Array
from mahovik.use.plan.residual.slopes import BodyPlan


@dataclass(frozen=True)
class TwistLaw:
    """Lift and drag of the fins of one body by its twist v (M, 6) relative to the fluid, all in the body's frame."""

    fins: tuple[Fin, ...]

    def wrench(self, v: Array) -> Array:
        """Sum over the fins (M, 6; N, N m)."""
        return np.asarray(sum(_force(fin, v @ _map(fin).T)[0] @ _map(fin) for fin in self.fins))

    def rate(self, v: Array) -> Array:
        """dP/dv (M, 6, 6) of `wrench`."""
        return np.asarray(sum(_map(fin).T @ _force(fin, v @ _map(fin).T)[1] @ _map(fin) for fin in self.fins))


def _map(fin: Fin) -> Array:
    """(3, 6) Velocity of a fin along chord, span, normal from the twist."""
    axes = np.array(axes_of(fin))
    x, y, z = fin.position
    return np.asarray(axes @ np.hstack([np.eye(3), [[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]]]))


def _force(fin: Fin, velocity: Array) -> tuple[Array, Array]:
    """Force (M, 3) along chord, span, normal by the velocity (M, 3) along them, and its derivative (M, 3, 3)."""
    a, c = velocity[:, 0], velocity[:, 2]
    counted = {"along": (1.0, 0.0, 0.0), "across": (1.0, 0.0, 1.0), "whole": (1.0, 1.0, 1.0)}[fin.speed]
    size = 0.5 * fin.density * fin.area
    pressure, pressure_by = size * velocity**2 @ counted, 2.0 * size * velocity * counted
    square = a**2 + c**2
    turning = fin.incidence & (square > 0.0)
    safe = np.where(turning, square, 1.0)
    along, up = np.where(turning, a / np.sqrt(safe), 1.0), np.where(turning, c / np.sqrt(safe), 0.0)
    angle = np.where(turning, np.arctan2(c, a), 0.0) + fin.deflection
    angle_by = np.zeros_like(velocity)
    angle_by[:, 0], angle_by[:, 2] = np.where(turning, -c / safe, 0.0), np.where(turning, a / safe, 0.0)

    C_L, slope = _lift(fin, angle)
    C_D = fin.drag + fin.induced * C_L**2
    by_angle = np.column_stack([slope, 2.0 * fin.induced * C_L * slope])  # of C_L, C_D
    force, rate = np.zeros_like(velocity), np.zeros((*velocity.shape, 3))
    turn = float(fin.incidence)
    for row, (of_lift, of_drag, lift_by, drag_by) in (
        (0, (up, -along, along, up)),  # along the chord, and how it turns with the flow
        (2, (-along, -up, up, -along)),  # along the normal
    ):
        total = C_L * of_lift + C_D * of_drag
        total_by = by_angle[:, 0] * of_lift + by_angle[:, 1] * of_drag + turn * (C_L * lift_by + C_D * drag_by)
        force[:, row] = pressure * total
        rate[:, row] = total[:, None] * pressure_by + (pressure * total_by)[:, None] * angle_by
    return force, rate


def _lift(fin: Fin, angle: Array) -> tuple[Array, Array]:
    """C_L of angles (M), and its derivative."""
    size, slope = np.abs(angle), np.ones_like(angle)
    if fin.stall is not None:
        fade = fin.stall / (np.pi / 2 - fin.stall)
        slope = np.where(size <= fin.stall, 1.0, np.where(size < np.pi / 2, -fade, 0.0))
        size = np.where(size <= fin.stall, size, np.maximum(0.0, fade * (np.pi / 2 - size)))
    return fin.lift_slope * np.sign(angle) * size, fin.lift_slope * slope


def twist_law(body: Body) -> TwistLaw | None:
    """The fins of a body; None where there is none."""
    law = body.law(Fins)
    return None if law is None else TwistLaw(law.fins)


LAW = BodyPlan(twist_law)
