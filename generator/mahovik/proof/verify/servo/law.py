"""The law of servo and trim (docs/control.md), literally in NumPy, with the scale of each result.

A scale is the sum of the magnitudes of the terms. Nothing here comes from the code that makes the C.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Values = Mapping[str, Array]

WHOLE = 3.0
"""Argument of dry friction from which it is whole."""


class LawResult(NamedTuple):
    """Results by name, their scales, and whether a limit was met (None: rounding decides)."""

    values: dict[str, Array]
    scales: dict[str, Array]
    limited: bool | None


def dry_friction(x: Array) -> Array:
    """Share of the dry friction: y (27 + y^2) / (27 + 9 y^2) with y = x inside -3..3, within 0.024 of tanh x."""
    y = np.clip(x, -WHOLE, WHOLE)
    return np.asarray((27 * y + y**3) / (27 + 9 * y**2))


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
    turn, slip = wanted["phi_ref"] - phi, wanted["phi_dot_ref"] - phi_dot
    e, e_scale = np.array([math.remainder(each, math.tau) for each in turn]), np.abs(turn)  # within half a turn
    f = (1 - g["filter"]) * state["speed"] + g["filter"] * slip
    f_scale = np.abs(state["speed"]) + g["filter"] * (np.abs(slip) + np.abs(state["speed"]))
    viscous = g["viscous"] * wanted["phi_dot_ref"]
    dry = g["coulomb"] * dry_friction(g["coulomb_rate"] * wanted["phi_dot_ref"])
    z, last = state["integral"], state["torque"]
    u = wanted["tau_ff"] + viscous + dry + g["angle"] * e + g["speed"] * f + z
    u_scale = np.abs(wanted["tau_ff"]) + np.abs(viscous) + np.abs(dry)
    u_scale = u_scale + g["angle"] * e_scale + g["speed"] * f_scale + np.abs(z)
    low, high = np.maximum(-g["limit"], last - g["change"]), np.minimum(g["limit"], last + g["change"])
    tau = np.minimum(np.maximum(u, low), high)
    tau_scale = u_scale + np.where(tau == u, 0.0, np.minimum(g["limit"], np.abs(last) + g["change"]))
    rest = z + g["integral"] * e + g["back"] * (tau - u)
    z_scale = np.abs(z) + g["integral"] * e_scale + g["back"] * (tau_scale + u_scale)
    return LawResult(
        {"tau": tau, "torque": tau, "speed": f, "integral": np.clip(rest, -g["limit"], g["limit"])},
        {"tau": tau_scale, "torque": tau_scale, "speed": f_scale, "integral": z_scale},
        exceeds(np.maximum(low - u, u - high), tolerance * tau_scale),
    )


class TrimLaw:
    """The trim as a whole: what the C must have after each sample, from all that was measured so far.

    design       members of the design: `settling`, `window` whole numbers, `matrix` (N T, C T), `target` (C, T) ...
    count        number of flywheels N
    wanted, present  corrections (N, T): mean, cosine 1, sine 1, ... of each flywheel; `size`: scale of both
    error        (C, T) of the last round, known while `ends_window`
    """

    def __init__(self, design: Mapping[str, Array | int], count: int, tolerance: float) -> None:
        self.design, self.count, self.tolerance = design, count, tolerance
        self.start, self.window = int(design["settling"]), int(design["window"])
        self.terms = np.shape(design["target"])[1]
        self.wanted, self.present, self.size = (np.zeros((count, self.terms)) for _ in range(3))
        self.error, self.error_scale = (np.zeros(np.shape(design["target"])) for _ in range(2))
        self.rounds = self.sample = 0
        self._samples: list[tuple[float, Array]] = []

    @property
    def ends_window(self) -> bool:
        """Whether the last sample was the end of a window, so that the error of the round is known."""
        return self.sample == self.start + self.window

    def take(self, phase: float, q: Array, given: Values) -> LawResult:
        """The next sample: coordinates q measured at a phase; `given` are `phi`, `phi_dot`, `tau` of the programme."""
        limited: bool | None = False
        after = self.sample - self.start - self.window
        if self.start <= self.sample and after < 0:
            self._samples.append((phase, q))
            if after == -1:
                self._compare()
        elif after >= 0:
            limited = self._correct(after)
        self.sample += 1
        if after + 1 == self.count:
            self.sample, self.rounds = 0, self.rounds + 1
        self.present = self.present + self.design["smoothing"] * (self.wanted - self.present)
        return self._corrected_demand(phase, given, limited)

    def _compare(self) -> None:
        """The error of the round: Fourier coefficients of the window less the target."""
        target = np.asarray(self.design["target"])
        phases, q = (np.array(each) for each in zip(*self._samples, strict=True))
        self.error, self.error_scale = -target, np.abs(target)
        for i in range(self.terms):
            k, part = (i + 1) // 2, math.cos if i % 2 or i == 0 else math.sin
            wave = np.array([part(2 * math.pi * k * phase) for phase in phases]) * (1 if k == 0 else 2)
            self.error[:, i] += (wave[:, None] * q).mean(axis=0)
            self.error_scale[:, i] += np.abs(q).mean(axis=0) * (1 if k == 0 else 2)
        self._samples.clear()

    def _correct(self, s: int) -> bool | None:
        """The corrections of flywheel s lose matrix times error, inside the limit."""
        rows = np.asarray(self.design["matrix"])[s * self.terms : (s + 1) * self.terms]
        limit = np.asarray(self.design["limit"])
        free = self.wanted[s] - rows @ self.error.ravel()
        self.size[s] += np.abs(rows) @ self.error_scale.ravel()
        self.wanted[s] = np.clip(free, -limit, limit)
        return exceeds(np.abs(free) - limit, self.tolerance * self.size[s])

    def _corrected_demand(self, phase: float, given: Values, limited: bool | None) -> LawResult:
        """Angle, speed and torque with the corrections: a Fourier series and its derivatives by time."""
        k = np.arange(1, self.terms // 2 + 1)
        turn, inertia = k * self.design["omega"], np.asarray(self.design["inertia"])
        vector = np.exp(2j * math.pi * k * phase) * (self.present[:, 1::2] - 1j * self.present[:, 2::2])
        size = self.size[:, 1::2] + self.size[:, 2::2]
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
