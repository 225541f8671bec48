"""Item 7: Floquet multipliers of the carrier along the programme, by differences of (8) and (10)."""

from __future__ import annotations

import numpy as np

from mahovik.core.motion.programme import Programme
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.stand.model import Stand
from mahovik.errors import StateError
from mahovik.proof.reference.array import Array
from mahovik.proof.verify.programme.along import twist
from mahovik.proof.verify.programme.finding import Finding
from mahovik.proof.verify.programme.simulation import rate

STEPS = 12
"""A period at least, two for every turn and harmonic of the motion: the carrier is slow beside what shakes it.

Ten to a period leave the multipliers of the example stands right to 1e-5.
"""

STEP = 1e-6
"""Step of a difference, over 1 + the number itself: multipliers are right to about five digits."""


def multipliers(stand: Stand, motion: RequiredMotion, programme: Programme) -> tuple[complex, ...]:
    """The 12 eigenvalues of the monodromy matrix, the largest modulus first, of a pair that with Im > 0.

    x' = A(t) x along the required motion, y = (q, V), over a period by Magnus's fourth-order steps with A at the
    two points of Gauss. StateError at a singular attitude.
    """
    from scipy.linalg import expm

    steps = max(STEPS, 2 * max([*motion.harmonics, *map(abs, programme.winding)], default=0))
    h = programme.span / steps
    monodromy = np.eye(12)
    for step in range(steps):
        early, late = ((step + 0.5 + side * np.sqrt(3) / 6) * h for side in (-1, 1))
        A1, A2 = (_linear(stand, motion, programme, t) for t in (early, late))
        exponent = h / 2 * (A1 + A2) + np.sqrt(3) / 12 * h**2 * (A2 @ A1 - A1 @ A2)
        monodromy = expm(exponent) @ monodromy
    found = [complex(z) for z in np.linalg.eigvals(monodromy)]
    # moduli of a pair may differ in the last digits
    return tuple(sorted(found, key=lambda z: (-round(abs(z), 12), -round(z.real, 12), -z.imag)))


def _linear(stand: Stand, motion: RequiredMotion, programme: Programme, t: float) -> Array:
    """A (12x12): derivatives of (q', V*) by (q, V) at t, by differences."""
    course, angles = motion.at(np.array([t]), programme.bias), programme.at(np.array([t]))
    y = np.concatenate([course.q[0], twist(stand, course.q[0], course.q_dot[0])])
    phi, phi_dot, phi_ddot = (each[0] for each in angles)
    here = rate(stand, y, phi, phi_dot, phi_ddot)
    A = np.zeros((12, 12))
    for i in range(12):
        aside = y.copy()
        aside[i] += STEP * (1.0 + abs(y[i]))
        A[:, i] = (rate(stand, aside, phi, phi_dot, phi_ddot) - here) / (aside[i] - y[i])
    return A


def finding(stand: Stand, motion: RequiredMotion, programme: Programme, limit: float) -> Finding:
    """The largest multiplier. Above 1 the motion is right, but something must hold it: a warning, no failure."""
    try:
        found = multipliers(stand, motion, programme)
    except StateError as error:
        return Finding("Floquet", np.inf, limit, False, str(error))
    value = abs(found[0])
    if value > limit:
        words = "largest multiplier: the motion is right, but not stable without feedback"
    elif value > 2 - limit:
        words = "largest multiplier: neutral, the carrier is free to drift"
    else:
        words = f"largest multiplier: stable, disturbances decay by {value:.3g} a period"
    return Finding("Floquet", value, limit, bool(np.isfinite(value)), words, found)
