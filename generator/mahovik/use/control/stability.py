"""Stability of the sampled, delayed loop of a rotor, and its margins.

A rotor under held torque is x = (phi, phi'), x' = (phi', lightness u / J), exactly discretised with a delay that need
not be a whole number of samples (Astrom and Wittenmark, Computer-Controlled Systems, 1997, section 3.2); torques on the
way are additional states. The servo's states are those of its C: integral, filtered speed error, and with encoders
the previous angle, since the speed is then a difference of angles. Stable: the spectral radius of the closed loop is
below 1; margins of gain: factors that keep it there. Margins of phase and delay: by the exact frequency response of the
open loop up to half the sample rate. All of this holds for every lightness between 1 and
that of the stand (use/control/gains.py).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mahovik.core.motion.servo import Servo
from mahovik.core.stand.model import Stand
from mahovik.errors import CheckError
from mahovik.use.control.gains import Law, law, lightness

Array = NDArray[np.float64]

GAIN, PHASE = 1.5, 25.0
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

    def response(self, omega: Array) -> NDArray[np.complex128]:
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
    def accepted(self) -> bool:
        """Whether it is stable with the least accepted margins."""
        return self.radius < 1.0 and min(self.gain, self.less) >= GAIN and self.phase >= PHASE


def delay(stand: Stand, servo: Servo) -> float:
    """Delay from measurement to torque, s: the servo's latency plus the largest of the encoders."""
    if servo.encoder == "ideal":
        return servo.latency
    return servo.latency + max((s.encoder.latency for s in stand.flywheels if s.encoder is not None), default=0.0)


def loop(each: Law, period: float, late: float, light: float, difference: bool) -> Loop:
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
    filtered = each.filter * slip
    filtered[3] += 1.0 - each.filter
    A[3] = filtered
    A[2, 2] = 1.0 if each.integral else 0.0  # without an integral there is no integral state
    A[2, 0] = -each.integral * period
    C += each.speed * filtered
    C[0] -= each.angle
    C[2] = 1.0
    return Loop(A, B, C, period)


def margins(stand: Stand, servo: Servo, bandwidth: float | None = None, light: float | None = None) -> Margins:
    """Margins of a stand's servos, the worst over lightness 1 to that of the stand; with another bandwidth (rad/s)."""
    most = lightness(stand) if light is None else light
    loops = _loops(stand, servo, bandwidth, most)
    found = [(*_gain_limits(one), *_phase_margin(one)) for one in (loops[0], loops[-1])]
    gain, less, phase, more = (min(values) for values in zip(*found, strict=True))
    return Margins(max(one.radius() for one in loops), gain, less, phase, more, most)


def _loops(stand: Stand, servo: Servo, bandwidth: float | None, most: float) -> list[Loop]:
    """Loops from lightness 1 to the largest."""
    each, late, encoders = law(servo, bandwidth), delay(stand, servo), servo.encoder == "stand"
    return [loop(each, servo.period, late, float(light), encoders) for light in np.geomspace(1.0, most, _GAINS)]


def check(stand: Stand, servo: Servo, source: str) -> Margins:
    """The margins if they are sufficient. Otherwise raises CheckError with the highest sufficient bandwidth."""
    found = margins(stand, servo)
    if found.accepted:
        return found
    hertz, late = servo.bandwidth / (2 * math.pi), delay(stand, servo)
    what = (
        f"unstable, its poles reach {found.radius:.3f}"
        if found.radius >= 1.0
        else f"gain margin {min(found.gain, found.less):.2f}, phase margin {found.phase:.0f} deg"
    )
    highest = highest_bandwidth(stand, servo, found.lightness)
    remedy = (
        f"give at most {_round_down(highest / (2 * math.pi))} Hz"
        if highest is not None
        else "no lower bandwidth is better: give another damping_ratio, speed_filter or sample_period"
    )
    raise CheckError(
        f"{source}: bandwidth {hertz:.4g} Hz at {servo.period * 1e3:.4g} ms a sample and "
        f"{late * 1e3:.4g} ms of delay: {what} (expected {GAIN:g}, {PHASE:g} deg): {remedy}; nothing was written"
    )


def highest_bandwidth(stand: Stand, servo: Servo, light: float) -> float | None:
    """The highest accepted bandwidth below the servo's, rad/s, by halving and bisection; None: there is none."""

    def enough(bandwidth: float) -> bool:
        loops = _loops(stand, servo, bandwidth, light)
        factors = np.geomspace(1.0 / GAIN, GAIN, _GAINS)
        ends = (loops[0], loops[-1])
        return all(one.radius(float(f)) < 1.0 for one in ends for f in factors) and all(
            _phase_margin(one)[0] >= PHASE for one in ends
        )

    high = servo.bandwidth
    low = high / 2
    while not enough(low):
        high, low = low, low / 2
        if low < servo.bandwidth * 2.0**-8:
            return None
    while high / low > 1.002:
        middle = math.sqrt(high * low)
        if enough(middle):
            low = middle
        else:
            high = middle
    return low


def _gain_limits(one: Loop) -> tuple[float, float]:
    """Factors by which the gain may rise, and fall, before the closed loop is unstable; infinite beyond _FACTORS."""
    found = []
    for direction in (1.0, -1.0):
        stable, unstable = 1.0, math.inf
        for factor in np.geomspace(1.0, _FACTORS, 41)[1:]:
            if one.radius(factor**direction) >= 1.0:
                unstable = float(factor)
                break
            stable = float(factor)
        while math.isfinite(unstable) and unstable / stable > 1.0005:
            middle = math.sqrt(stable * unstable)
            if one.radius(middle**direction) < 1.0:
                stable = middle
            else:
                unstable = middle
        found.append(stable if math.isfinite(unstable) else math.inf)
    return found[0], found[1]


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
