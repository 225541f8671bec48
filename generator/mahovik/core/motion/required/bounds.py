"""Bounds that a programme keeps to."""

from __future__ import annotations

from dataclasses import dataclass

Each = tuple[float, ...] | None
"""A number for every flywheel; None: no bound."""


@dataclass(frozen=True)
class Bounds:
    """Magnitudes that a programme keeps to, N numbers each in SI; None is no bound. E_x, E_u of (13).

    speed, speed_min   of phi', rad/s; no flywheel faster, none slower
    acceleration       of phi'', rad/s2
    torque             of tau, N m
    angle              of phi less its winding and its mean, rad
    bias               of each of the six of `bias`: m, rad
    deviation          of the carrier from its mean pose during run-up and run-down: O1 (m), angle of its turn (rad);
                       infinite where there is no bound
    start_phi, start_phi_dot   x(t0) of (13) of a finite motion, with sign: rad, rad/s
    """

    speed: Each = None
    speed_min: Each = None
    acceleration: Each = None
    torque: Each = None
    angle: Each = None
    bias: Each = None
    deviation: tuple[float, float] | None = None
    start_phi: Each = None
    start_phi_dot: Each = None
