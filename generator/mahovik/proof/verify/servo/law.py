"""The law of servo and trim (docs/control.md), literally in NumPy, with the scale of each result.

A scale is the sum of the magnitudes of the terms. Nothing here comes from the code that makes the C.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Values = Mapping[str, Array]

WHOLE = 3.0
"""Argument of dry friction from which it is whole."""


@dataclass(frozen=True)
class LawResult:
    """Results by name, their scales, and whether a limit was met (None: rounding decides)."""

    values: dict[str, Array]
    scales: dict[str, Array]
    limited: bool | None


def dry_friction(x: Array) -> Array:
    """Share of the dry friction: y (27 + y^2) / (27 + 9 y^2) with y = x inside -3..3, within 0.024 of tanh x."""
    y = np.clip(x, -WHOLE, WHOLE)
    return np.asarray((27 * y + y**3) / (27 + 9 * y**2))


def within_half_a_turn(angle: Array) -> Array:
    """The angles (rad) less whole turns, within half a turn of zero."""
    return np.array([math.remainder(each, math.tau) for each in angle])


def exceeds(excess: Array, doubt: Array) -> bool | None:
    """Whether any excess is above zero; None if one is nearer to zero than its doubt and the others are below."""
    if np.any(excess > doubt):
        return True
    return None if np.any(excess >= -doubt) else False


def servo_sample(g: Values, state: Values, wanted: Values, phi: Array, phi_dot: Array, tolerance: float) -> LawResult:
    """One sample of all servos.

    g         members of the gains, (N) each or a number
    state     `integral`, `speed`, `torque` before the sample
    wanted    `phi_ref`, `phi_dot_ref`, `tau_ff`
    phi, phi_dot  measured; the wanted ones where there is no good reading
    """
    turn = wanted["phi_ref"] - phi
    e, e_scale = within_half_a_turn(turn), np.abs(turn)
    slip = wanted["phi_dot_ref"] - phi_dot
    f = (1 - g["filter"]) * state["speed"] + g["filter"] * slip
    f_scale = np.abs(state["speed"]) + g["filter"] * (np.abs(slip) + np.abs(state["speed"]))
    viscous = g["viscous"] * wanted["phi_dot_ref"]
    dry = g["coulomb"] * dry_friction(g["coulomb_rate"] * wanted["phi_dot_ref"])
    z, last = state["integral"], state["torque"]
    u = wanted["tau_ff"] + viscous + dry + g["angle"] * e + g["speed"] * f + z
    u_scale = np.abs(wanted["tau_ff"]) + np.abs(viscous) + np.abs(dry)
    u_scale = u_scale + g["angle"] * e_scale + g["speed"] * f_scale + np.abs(z)
    low = np.maximum(-g["limit"], last - g["change"])
    high = np.minimum(g["limit"], last + g["change"])
    tau = np.minimum(np.maximum(u, low), high)
    reached = np.where(tau == u, 0.0, np.minimum(g["limit"], np.abs(last) + g["change"]))
    tau_scale = u_scale + reached
    rest = z + g["integral"] * e + g["back"] * (tau - u)
    z_scale = np.abs(z) + g["integral"] * e_scale + g["back"] * (tau_scale + u_scale)
    return LawResult(
        {"tau": tau, "torque": tau, "speed": f, "integral": np.clip(rest, -g["limit"], g["limit"])},
        {"tau": tau_scale, "torque": tau_scale, "speed": f_scale, "integral": z_scale},
        exceeds(np.maximum(low - u, u - high), tolerance * tau_scale),
    )


@dataclass
class TrimLaw:
    """The trim as a whole: what the C must have after each sample, from all that was measured so far.

    design       members of the design: `settling`, `window` whole numbers, `matrix` (N T, C T), `target` (C, T) ...
    count        number of flywheels N
    wanted, present  corrections (N, T): mean, cosine 1, sine 1, ... of each flywheel
    """

    design: Mapping[str, Array | int]
    count: int
    tolerance: float
    wanted: Array = field(init=False)
    present: Array = field(init=False)
    size: Array = field(init=False)
    rounds: int = field(default=0, init=False)
    sample: int = field(default=0, init=False)
    error: Array = field(init=False)
    error_scale: Array = field(init=False)
    _samples: list[tuple[float, Array]] = field(default_factory=list, init=False)

    def __post_init__(self) -> None:
        shape = (self.count, self.terms)
        self.wanted, self.present, self.size = np.zeros(shape), np.zeros(shape), np.zeros(shape)
        self.error = np.zeros(np.shape(self.design["target"]))
        self.error_scale = np.zeros(np.shape(self.design["target"]))

    @property
    def terms(self) -> int:
        """Coefficients of a coordinate: the mean, then cosine and sine of each harmonic."""
        return int(np.shape(self.design["target"])[1])

    @property
    def ends_window(self) -> bool:
        """Whether the last sample was the end of a window, so that the error of the round is known."""
        return self.sample == self._start + self._window

    @property
    def _start(self) -> int:
        return int(self.design["settling"])

    @property
    def _window(self) -> int:
        return int(self.design["window"])

    def take(self, phase: float, q: Array, given: Values) -> LawResult:
        """The next sample: coordinates q measured at a phase; `given` are `phi`, `phi_dot`, `tau` of the programme."""
        limited: bool | None = False
        if self._start <= self.sample < self._start + self._window:
            self._samples.append((phase, q))
            if len(self._samples) == self._window:
                self._compare()
        elif self.sample >= self._start + self._window:
            limited = self._correct(self.sample - self._start - self._window)
        self.sample += 1
        if self.sample == self._start + self._window + self.count:
            self.sample, self.rounds = 0, self.rounds + 1
        self.present = self.present + self.design["smoothing"] * (self.wanted - self.present)
        return self._corrected_demand(phase, given, limited)

    def _compare(self) -> None:
        """The error of the round: Fourier coefficients of the window less the target."""
        phases = np.array([phase for phase, _ in self._samples])
        q = np.array([each for _, each in self._samples])
        self.error, self.error_scale = np.zeros_like(self.error), np.abs(np.asarray(self.design["target"]))
        for k in range(self.terms // 2 + 1):
            spun = np.exp(-2j * math.pi * k * phases)
            found = (spun[:, None] * q).mean(axis=0) * (1 if k == 0 else 2)
            size = np.abs(q).mean(axis=0) * (1 if k == 0 else 2)
            parts = {0: found.real} if k == 0 else {2 * k - 1: found.real, 2 * k: -found.imag}
            for i, part in parts.items():
                self.error[:, i] = part
                self.error_scale[:, i] += size
        self.error = self.error - self.design["target"]
        self._samples.clear()

    def _correct(self, s: int) -> bool | None:
        """The corrections of flywheel s lose matrix times error, inside the limit."""
        rows = np.asarray(self.design["matrix"])[s * self.terms : (s + 1) * self.terms]
        limit = np.asarray(self.design["limit"])
        free = self.wanted[s] - rows @ self.error.ravel()
        scale = self.size[s] + np.abs(rows) @ self.error_scale.ravel()
        self.wanted[s] = np.clip(free, -limit, limit)
        self.size[s] = scale
        return exceeds(np.abs(free) - limit, self.tolerance * scale)

    def _corrected_demand(self, phase: float, given: Values, limited: bool | None) -> LawResult:
        """Angle, speed and torque with the corrections: a Fourier series and its derivatives by time."""
        k = np.arange(1, self.terms // 2 + 1)
        turn = k * self.design["omega"]
        vector = np.exp(2j * math.pi * k * phase) * (self.present[:, 1::2] - 1j * self.present[:, 2::2])
        size = self.size[:, 1::2] + self.size[:, 2::2]
        inertia = np.asarray(self.design["inertia"])
        added = {
            "phi": self.present[:, 0] + vector.real.sum(axis=1),
            "phi_dot": (1j * turn * vector).real.sum(axis=1),
            "tau": inertia * (-(turn**2) * vector).real.sum(axis=1),
        }
        scales = {
            "phi": self.size[:, 0] + size.sum(axis=1),
            "phi_dot": (turn * size).sum(axis=1),
            "tau": inertia * (turn**2 * size).sum(axis=1),
        }
        return LawResult(
            {name: given[name] + added[name] for name in added},
            {name: np.abs(given[name]) + scales[name] for name in added},
            limited,
        )
