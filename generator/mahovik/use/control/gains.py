"""Gains of the servos from the wanted bandwidth, as members of the structs of `core/lower/servo/form.py`.

With the torque of the programme as feedforward the errors of a rotor obey J e'' = -u, u = angle e + speed e' +
integral of e, so that the poles of (s^2 + 2 zeta omega s + omega^2)(s + omega_i) ask for

    speed = J (2 zeta omega + omega_i),   angle = J (omega^2 + 2 zeta omega omega_i),   integral = J omega^2 omega_i.

J_s = f^T Theta_s f is the rotor's inertia about its axis. use/control/stability.py judges the effect of sampling, delay
and a moving carrier on these poles.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mahovik.core.motion.servo import Servo
from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State, rest_state
from mahovik.errors import CheckError
from mahovik.proof.reference.bodies import bodies_of, spinning_bodies
from mahovik.proof.reference.mass import coupling, mass_matrix, spin_inertia

Array = NDArray[np.float64]

NONE = 1e9
"""Value that the C takes as no limit (N m)."""

PHASES, SEED = 32, 1986
"""Number and seed of random flywheel angles at which `lightness` is evaluated."""

LEAST_SAMPLES = 4
"""Least samples per period."""
MOST_TICKS = 2**31 - 1
"""Largest count of a programme's clock."""


@dataclass(frozen=True)
class Law:
    """The loop of one rotor per unit of inertia: gains over J (1/s2, 1/s, 1/s3), and the filter's share per sample."""

    angle: float
    speed: float
    integral: float
    filter: float


def law(servo: Servo, bandwidth: float | None = None) -> Law:
    """Gains per unit of inertia; with another bandwidth (rad/s) the integral gain scales with it."""
    omega = servo.bandwidth if bandwidth is None else bandwidth
    slow = 0.0 if servo.integral is None else servo.integral * (omega / servo.bandwidth)
    damping = 2.0 * servo.damping_ratio * omega
    share = 1.0 if servo.speed_filter is None else -math.expm1(-servo.speed_filter * servo.period)
    return Law(omega**2 + damping * slow, damping + slow, omega**2 * slow, share)


def rotor_inertia(stand: Stand) -> Array:
    """J_s = f^T Theta_s f (N, kg m2) of each flywheel about its axis."""
    return np.diag(spin_inertia(spinning_bodies(bodies_of(stand).mounted, rest_state(stand)))).copy()


def lightness(stand: Stand) -> float:
    """How much lighter rotors feel because the carrier moves: the largest eigenvalue of
    J^1/2 (J - I^T K^-1 I)^-1 J^1/2 (6) over random angles; 1 if the carrier does not move.

    All gains are proportional to J, so these eigenvalues multiply the loop's gain in its modes.
    """
    drawn = np.random.default_rng(SEED).uniform(-np.pi, np.pi, (PHASES, len(stand.flywheels)))
    bodies, largest = bodies_of(stand), 1.0
    for phi in drawn:
        rotors = spinning_bodies(bodies.mounted, _state_at(stand, phi))
        I, J = coupling(rotors), spin_inertia(rotors)
        root = np.sqrt(np.diag(J))
        mobility = np.linalg.inv(J - I.T @ np.linalg.solve(mass_matrix(bodies.fixed, rotors), I))
        largest = max(largest, float(np.linalg.eigvalsh(root[:, None] * mobility * root)[-1]))
    return largest


def samples(servo: Servo, span: float, source: str = "servo") -> tuple[int, int]:
    """(ticks, periods): `ticks` samples equal `periods` periods of `span` s, by the decimal numbers of both files.

    CheckError: fewer than LEAST_SAMPLES samples per period.
    """
    exact = Fraction(repr(span)) / Fraction(repr(servo.period))
    if exact < LEAST_SAMPLES:
        raise CheckError(
            f"{source}: sample_period {servo.period:g} s: {float(exact):.3g} samples in a period of {span:g} s, "
            f"expected at least {LEAST_SAMPLES}; nothing was written"
        )
    if exact.numerator > MOST_TICKS:
        exact = exact.limit_denominator(max(1, math.floor(MOST_TICKS / exact) - 1))
    return exact.numerator, exact.denominator


def gains(stand: Stand, servo: Servo, span: float | None = None) -> dict[str, Any]:
    """Members of `servo_gains` in SI; `span` is the programme's period, s; without it feedforward has no lead."""
    J, each = rotor_inertia(stand), law(servo)
    motors = [s.motor if servo.friction else None for s in stand.flywheels]
    back = 0.0 if servo.integral is None else -math.expm1(-servo.bandwidth * servo.period)
    lead = 0.0 if span is None else (servo.latency + servo.period / 2) / span % 1.0
    return {
        "angle": (J * each.angle).tolist(),
        "speed": (J * each.speed).tolist(),
        "integral": (J * each.integral * servo.period).tolist(),
        "back": [back] * len(J),
        "filter": each.filter,
        "limit": [min(limit, NONE) for limit in servo.torque_limit],
        "change": [min(rate * servo.period, NONE) for rate in servo.torque_rate],
        "viscous": [0.0 if m is None else m.viscous for m in motors],
        "coulomb": [0.0 if m is None else m.coulomb for m in motors],
        "coulomb_rate": [0.0 if m is None else 1.0 / m.coulomb_speed for m in motors],
        "lead": lead,
    }


def _state_at(stand: Stand, phi: Array) -> State:
    """The stand at rest with these angles (N, rad)."""
    return replace(rest_state(stand), phi=tuple(phi.tolist()))
