"""Gains of the servos from the wanted bandwidth, and stability of the sampled, delayed loop with its margins.

Gains are members of the structs of `core/lower/servo/form.py`. With the torque of the programme as feedforward the
errors of a rotor obey J e'' = -u, u = angle e + speed e' + integral of e, so that the poles of
(s^2 + 2 zeta omega s + omega^2)(s + omega_i) ask for

    speed = J (2 zeta omega + omega_i),   angle = J (omega^2 + 2 zeta omega omega_i),   integral = J omega^2 omega_i.

J_s = f^T Theta_s f is the rotor's inertia about its axis. Sampling, delay and a moving carrier change these poles.

A rotor under held torque is x = (phi, phi'), x' = (phi', lightness u / J), exactly discretised with a delay that need
not be a whole number of samples (Astrom and Wittenmark, Computer-Controlled Systems, 1997, section 3.2); torques on the
way are additional states. The servo's states are those of its C: integral, filtered speed error, and with encoders
the previous angle, since the speed is then a difference of angles. Stable: the spectral radius of the closed loop is
below 1; margins of gain: factors that keep it there. Margins of phase and delay: by the exact frequency response of the
open loop up to half the sample rate. All of this holds for every lightness between 1 and that of the stand.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from typing import Any

import numpy as np

from mahovik.contract.quantities import BOUNDS
from mahovik.core.motion.servo import Servo
from mahovik.core.stand.hold import twists
from mahovik.core.stand.model import Stand
from mahovik.errors import CheckError
from mahovik.proof.reference.pieces import bodies_of, coupling, mass_matrix, spin_inertia
from mahovik.use.numeric.se3 import Array, Complex

NONE = BOUNDS["MAX_WRENCH"].value
"""Value that the C takes as no limit (N m)."""

PHASES, SEED = 32, 1986
"""Number and seed of random flywheel angles at which `lightness` is evaluated."""

LEAST_SAMPLES = 4
"""Least samples per period."""
MOST_TICKS = 2**31 - 1
"""Largest count of a programme's clock."""


@dataclass(frozen=True)
class LoopGains:
    """The loop of one rotor per unit of inertia: gains over J (1/s2, 1/s, 1/s3), and the filter's share per sample."""

    angle: float
    speed: float
    integral: float
    filter: float


def loop_gains(servo: Servo, bandwidth: float | None = None) -> LoopGains:
    """Gains per unit of inertia; with another bandwidth (rad/s) the integral gain scales with it."""
    omega = servo.bandwidth if bandwidth is None else bandwidth
    slow = 0.0 if servo.integral is None else servo.integral * (omega / servo.bandwidth)
    damping = 2.0 * servo.damping_ratio * omega
    share = 1.0 if servo.speed_filter is None else -math.expm1(-servo.speed_filter * servo.period)
    return LoopGains(omega**2 + damping * slow, damping + slow, omega**2 * slow, share)


def rotor_inertia(stand: Stand) -> Array:
    """J_s = f^T Theta_s f (N, kg m2) of each flywheel about its axis."""
    return np.diag(spin_inertia(bodies_of(stand).flywheels)).copy()


def lightness(stand: Stand) -> float:
    """How much lighter rotors feel because the carrier moves: the largest eigenvalue of
    J^1/2 (J - I^T S (S^T K S)^-1 S^T I)^-1 J^1/2 (6) over random angles; 1 if the carrier does not move.

    S are the twists that a hold leaves free, all six without one. All gains are proportional to J, so these
    eigenvalues multiply the loop's gain in its modes.
    """
    drawn = np.random.default_rng(SEED).uniform(-np.pi, np.pi, (PHASES, len(stand.flywheels)))
    bodies, largest = bodies_of(stand), 1.0
    S = twists(stand.hold)
    for phi in drawn:
        placed = bodies.at_phases(phi.tolist(), [0.0] * len(phi))
        I, J = S.T @ coupling(placed.flywheels), spin_inertia(placed.flywheels)
        root = np.sqrt(np.diag(J))
        carried = I.T @ np.linalg.solve(S.T @ (mass_matrix(placed) + placed.Lambda.sum(axis=0)) @ S, I)
        mobility = np.linalg.inv(J - carried)
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
    J, loop = rotor_inertia(stand), loop_gains(servo)
    motors = [s.motor if servo.friction else None for s in stand.flywheels]
    back = 0.0 if servo.integral is None else -math.expm1(-servo.bandwidth * servo.period)
    lead = 0.0 if span is None else (servo.latency + servo.period / 2) / span % 1.0
    return {
        "angle": (J * loop.angle).tolist(),
        "speed": (J * loop.speed).tolist(),
        "integral": (J * loop.integral * servo.period).tolist(),
        "back": [back] * len(J),
        "filter": loop.filter,
        "limit": [min(limit, NONE) for limit in servo.torque_limit],
        "change": [min(rate * servo.period, NONE) for rate in servo.torque_rate],
        "viscous": [0.0 if m is None else m.viscous for m in motors],
        "coulomb": [0.0 if m is None else m.coulomb for m in motors],
        "coulomb_rate": [0.0 if m is None else 1.0 / m.coulomb_speed for m in motors],
        "lead": lead,
    }


LEAST_GAIN, LEAST_PHASE = 1.5, 25.0
"""Least accepted margins: factor of the loop's gain up (and down, with an integral), and degrees."""

_POINTS = 600
_FACTORS = 1000.0
_GAINS = 7
"""Points of the frequency response; largest factor of a gain margin; lightnesses tried between the ends."""


@dataclass(frozen=True)
class Loop:
    """Open loop of one rotor, cut where the torque is commanded: x_next = A x + B u; closed by u = C x."""

    A: Array
    B: Array
    C: Array
    period: float

    def radius(self, factor: float = 1.0) -> float:
        """Largest modulus of the closed loop's poles, its gain multiplied by a factor."""
        return float(np.max(np.abs(np.linalg.eigvals(self.A + factor * np.outer(self.B, self.C)))))

    def response(self, omega: Array) -> Complex:
        """-C (z - A)^-1 B at z = exp(i omega T): the loop's gain, to be kept away from -1."""
        z = np.exp(1j * omega * self.period)
        n = len(self.B)
        right = np.broadcast_to(self.B[:, None], (len(z), n, 1))
        states = np.linalg.solve(z[:, None, None] * np.eye(n) - self.A, right)[..., 0]
        return np.asarray(-states @ self.C, dtype=np.complex128)


@dataclass(frozen=True)
class Margins:
    """radius       largest modulus of the closed loop's poles; stable below 1
    gain, less      factors by which the loop's gain may rise, and fall; infinite without a limit
    phase           degrees that the phase may fall
    delay           s that may be added
    lightness       of the stand, over which all this is the worst
    """

    radius: float
    gain: float
    less: float
    phase: float
    delay: float
    lightness: float

    @property
    def are_sufficient(self) -> bool:
        """Whether it is stable with the least accepted margins."""
        return self.radius < 1.0 and min(self.gain, self.less) >= LEAST_GAIN and self.phase >= LEAST_PHASE


def delay(stand: Stand, servo: Servo) -> float:
    """Delay from measurement to torque, s: the servo's latency plus the largest of the encoders."""
    if servo.encoder == "ideal":
        return servo.latency
    return servo.latency + max((s.encoder.latency for s in stand.flywheels if s.encoder is not None), default=0.0)


def rotor_loop(loop_gains: LoopGains, period: float, late: float, light: float, difference: bool) -> Loop:
    """Loop of a rotor of inertia 1 / `light` with gains per unit of inertia, delayed by `late` s.

    `difference`: the speed is the difference of angles over a sample.
    """
    whole = max(1, math.ceil(late / period - 1e-9))
    part = late - (whole - 1) * period
    n = 4 + whole + (1 if difference else 0)  # angle, speed, integral, filter; torques on the way; previous angle
    A, B, C = np.zeros((n, n)), np.zeros(n), np.zeros(n)
    A[:2, :2] = [[1.0, period], [0.0, 1.0]]
    rest = period - part
    new = light * np.array([rest**2 / 2, rest])
    old = light * np.array([part**2 / 2 + part * rest, part])
    queue = 4  # A[queue + i]: torque from i + 1 samples ago
    A[:2, queue + whole - 1] += old
    if whole == 1:
        B[:2] += new
    else:
        A[:2, queue + whole - 2] += new
    B[queue] = 1.0
    for i in range(1, whole):
        A[queue + i, queue + i - 1] = 1.0
    slip = np.zeros(n)  # minus the measured speed
    if difference:
        slip[0], slip[n - 1] = -1.0 / period, 1.0 / period
        A[n - 1, 0] = 1.0
    else:
        slip[1] = -1.0
    filtered = loop_gains.filter * slip
    filtered[3] += 1.0 - loop_gains.filter
    A[3] = filtered
    A[2, 2] = 1.0 if loop_gains.integral else 0.0  # without an integral there is no integral state
    A[2, 0] = -loop_gains.integral * period
    C += loop_gains.speed * filtered
    C[0] -= loop_gains.angle
    C[2] = 1.0
    return Loop(A, B, C, period)


def margins(stand: Stand, servo: Servo, bandwidth: float | None = None, light: float | None = None) -> Margins:
    """Margins of a stand's servos, the worst over lightness 1 to that of the stand; with another bandwidth (rad/s)."""
    most = lightness(stand) if light is None else light
    loops = _loops(stand, servo, bandwidth, most)
    limits = [(_gain_limit(one, 1.0), _gain_limit(one, -1.0), *_phase_margin(one)) for one in (loops[0], loops[-1])]
    gain, less, phase, more = (min(values) for values in zip(*limits, strict=True))
    return Margins(max(one.radius() for one in loops), gain, less, phase, more, most)


def _loops(stand: Stand, servo: Servo, bandwidth: float | None, most: float) -> list[Loop]:
    """Loops from lightness 1 to the largest."""
    gain, late, encoders = loop_gains(servo, bandwidth), delay(stand, servo), servo.encoder == "stand"
    return [rotor_loop(gain, servo.period, late, float(light), encoders) for light in np.geomspace(1.0, most, _GAINS)]


def check_margins(stand: Stand, servo: Servo, source: str) -> Margins:
    """The margins if they are sufficient. Otherwise raises CheckError with the highest sufficient bandwidth."""
    result = margins(stand, servo)
    if result.are_sufficient:
        return result
    hertz, late = servo.bandwidth / (2 * math.pi), delay(stand, servo)
    what = (
        f"unstable, its poles reach {result.radius:.3f}"
        if result.radius >= 1.0
        else f"gain margin {min(result.gain, result.less):.2f}, phase margin {result.phase:.0f} deg"
    )
    highest = highest_bandwidth(stand, servo, result.lightness)
    remedy = (
        f"give at most {_round_down(highest / (2 * math.pi))} Hz"
        if highest is not None
        else "a lower bandwidth does not help: give another damping_ratio, speed_filter or sample_period"
    )
    raise CheckError(
        f"{source}: bandwidth {hertz:.4g} Hz at {servo.period * 1e3:.4g} ms per sample and "
        f"{late * 1e3:.4g} ms of delay: {what} (expected {LEAST_GAIN:g}, {LEAST_PHASE:g} deg): {remedy}; "
        "nothing was written"
    )


def highest_bandwidth(stand: Stand, servo: Servo, light: float) -> float | None:
    """The highest accepted bandwidth below the servo's, rad/s, by halving and bisection; None: there is none."""

    def enough(bandwidth: float) -> bool:
        loops = _loops(stand, servo, bandwidth, light)
        factors = np.geomspace(1.0 / LEAST_GAIN, LEAST_GAIN, _GAINS)
        ends = (loops[0], loops[-1])
        return all(one.radius(float(f)) < 1.0 for one in ends for f in factors) and all(
            _phase_margin(one)[0] >= LEAST_PHASE for one in ends
        )

    high = servo.bandwidth
    low = high / 2
    while not enough(low):
        high, low = low, low / 2
        if low < servo.bandwidth * 2.0**-8:
            return None
    return _bisect(low, high, 1.002, enough)


def _gain_limit(one: Loop, direction: float) -> float:
    """Factor by which the gain may rise (direction 1), or fall (-1), in a stable loop; infinite beyond _FACTORS."""

    def stable(factor: float) -> bool:
        return one.radius(factor**direction) < 1.0

    for low, high in pairwise(np.geomspace(1.0, _FACTORS, 41).tolist()):
        if not stable(high):
            return _bisect(low, high, 1.0005, stable)
    return math.inf


def _bisect(good: float, bad: float, ratio: float, is_good: Callable[[float], bool]) -> float:
    """The largest good value between a good one and a bad one above it, within a ratio."""
    while bad / good > ratio:
        middle = math.sqrt(good * bad)
        good, bad = (middle, bad) if is_good(middle) else (good, middle)
    return good


def _phase_margin(one: Loop) -> tuple[float, float]:
    """Margins of phase (degrees) and delay (s) of one stable loop, by its frequency response."""
    omega = np.geomspace(1e-5, 1.0, _POINTS) * np.pi / one.period
    L = one.response(omega)
    size, angle = np.abs(L), np.unwrap(np.angle(L))
    phase, more = 180.0, math.inf
    for i in np.flatnonzero(np.diff(size > 1.0)):
        share = math.log(size[i]) / (math.log(size[i]) - math.log(size[i + 1]))
        at = float(angle[i] + share * (angle[i + 1] - angle[i]))
        crossing = float(omega[i] * (omega[i + 1] / omega[i]) ** share)
        left = (at + 2 * np.pi) % (2 * np.pi) - np.pi  # from -180 degrees, within half a turn
        phase, more = min(phase, math.degrees(left)), min(more, left / crossing)
    return phase, more


def _round_down(value: float) -> str:
    """Three digits, rounded down, so that the advised value is accepted."""
    step = 10.0 ** (math.floor(math.log10(value)) - 2)
    return f"{math.floor(value / step) * step:.3g}"
