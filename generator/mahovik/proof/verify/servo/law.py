"""The law of servo and trim (docs/control.md), literally in NumPy: nothing of the code that makes the C is here."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Values = Mapping[str, Array]

WHOLE = 3.0
"""Argument of dry friction from which it is whole."""


def dry_friction(x: Array) -> Array:
    """Share of the dry friction: y (27 + y^2) / (27 + 9 y^2) with y = x inside -3..3, within 0.024 of tanh x."""
    y = np.clip(x, -WHOLE, WHOLE)
    return np.asarray((27 * y + y**3) / (27 + 9 * y**2))


def servo_sample(g: Values, state: Values, inputs: Values, lost: Array) -> dict[str, Any]:
    """One sample of all servos: `tau`, the members of the state after it, and whether a limit cut a torque.

    g       members of the gains, (N) each or a number
    state   `integral`, `speed`, `torque` before the sample
    inputs  `phi_ref`, `phi_dot_ref`, `tau_ff`, and measured `phi`, `phi_dot`; `lost` (N): without a good reading
    """
    turn, slip = (np.where(lost, 0.0, inputs[f"{name}_ref"] - inputs[name]) for name in ("phi", "phi_dot"))
    e = np.array([math.remainder(each, math.tau) for each in turn])  # within half a turn
    f = (1 - g["filter"]) * state["speed"] + g["filter"] * slip
    viscous = g["viscous"] * inputs["phi_dot_ref"]
    dry = g["coulomb"] * dry_friction(g["coulomb_rate"] * inputs["phi_dot_ref"])
    z, last = state["integral"], state["torque"]
    u = inputs["tau_ff"] + viscous + dry + g["angle"] * e + g["speed"] * f + z
    low, high = np.maximum(-g["limit"], last - g["change"]), np.minimum(g["limit"], last + g["change"])
    tau = np.minimum(np.maximum(u, low), high)
    rest = z + g["integral"] * e + g["back"] * (tau - u)
    integral = np.clip(rest, -g["limit"], g["limit"])
    return {"tau": tau, "torque": tau, "speed": f, "integral": integral, "limited": bool(np.any(tau != u))}


def waves(phase: Array, harmonics: int) -> Array:
    """1, cos 1, sin 1, cos 2, ... (1 + 2 H, M) of 2 pi k times phases (M)."""
    angles = 2 * math.pi * np.arange(1, harmonics + 1)[:, None] * phase
    pairs = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    return np.vstack([np.ones((1, len(phase))), pairs.reshape(-1, len(phase))])


def coefficients(values: Array, phase: Array, harmonics: int) -> Array:
    """Mean, cosine 1, sine 1, ... (1 + 2 H, ..) of values (M, ..) at phases (M), as averages of a whole period."""
    sums = np.tensordot(waves(phase, harmonics), values, 1) / len(phase)
    return np.concatenate([sums[:1], 2 * sums[1:]])


class TrimLaw:
    """The trim as a whole: what the C must have after each sample, from all that was measured so far.

    design       members of the design: `settling`, `window` whole numbers, `matrix` (N T, C T), `target` (C, T) ...
    count        number of flywheels N
    wanted, present  corrections (N, T): mean, cosine 1, sine 1, ... of each flywheel
    """

    def __init__(self, design: Mapping[str, Any], count: int) -> None:
        self.design, self.count = design, count
        self.start, self.window = int(design["settling"]), int(design["window"])
        self.terms = np.shape(design["target"])[1]
        self.wanted, self.present = np.zeros((count, self.terms)), np.zeros((count, self.terms))
        self.error, self.rounds, self.sample = np.zeros(np.shape(design["target"])), 0, 0
        self._samples: list[tuple[float, Array]] = []

    def take(self, phase: float, q: Array, given: Values) -> dict[str, Any]:
        """The next sample: coordinates q measured at a phase; `given` are `phi`, `phi_dot`, `tau` of the programme.

        These as they are corrected, `wanted`, `present`, `error` (C, T), and whether a limit cut a correction.
        """
        limited, after = False, self.sample - self.start - self.window
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
        k = np.arange(1, self.terms // 2 + 1)
        turn = k * self.design["omega"]  # a Fourier series and its derivatives by time
        vector = np.exp(2j * math.pi * k * phase) * (self.present[:, 1::2] - 1j * self.present[:, 2::2])
        return {
            "phi": given["phi"] + self.present[:, 0] + vector.real.sum(axis=1),
            "phi_dot": given["phi_dot"] + (1j * turn * vector).real.sum(axis=1),
            "tau": given["tau"] + self.design["inertia"] * (-(turn**2) * vector).real.sum(axis=1),
            "wanted": self.wanted.copy(),
            "present": self.present,
            "error": self.error,
            "limited": limited,
        }

    @property
    def ends_window(self) -> bool:
        """Whether the last sample was the end of a window, so that the error of the round is known."""
        return self.sample == self.start + self.window

    def _compare(self) -> None:
        """The error of the round: Fourier coefficients of the window less the target."""
        phases, q = (np.array(each) for each in zip(*self._samples, strict=True))
        self.error = coefficients(q, phases, self.terms // 2).T - self.design["target"]
        self._samples.clear()

    def _correct(self, s: int) -> bool:
        """The corrections of flywheel s lose matrix times error, inside the limit, which may cut them."""
        limit = self.design["limit"]
        free = self.wanted[s] - self.design["matrix"][s * self.terms : (s + 1) * self.terms] @ self.error.ravel()
        self.wanted[s] = np.clip(free, -limit, limit)
        return bool(np.any(np.abs(free) > limit))


NEIGHBOURS = 6
"""How often inputs are changed to measure a scale: the largest change counts."""

CHANGE = {"double": 2.0**-36, "float": 2.0**-18}
"""Relative change of every input, by element type: far above its rounding."""


def changed(values: Mapping[str, Any], size: float, rng: np.random.Generator) -> dict[str, Any]:
    """Inputs with every number times 1 + size u, |u| <= 1; whole numbers stay."""
    return {
        name: value if isinstance(value, int) else value * (1 + size * rng.uniform(-1, 1, np.shape(value)))
        for name, value in values.items()
    }


def scales_of(answers: Sequence[Mapping[str, Any]], size: float) -> tuple[dict[str, Array], bool | None]:
    """The scale of each number in the first of answers, whose others have inputs changed by `size`; whether limited.

    A scale is the number itself, or its largest change over `size`. None: rounding decides whether a limit is met.
    """
    first, *others = answers
    scales = {
        name: np.max([np.abs(value), *(np.abs(other[name] - value) / size for other in others)], axis=0)
        for name, value in first.items()
        if name != "limited"
    }
    sure = all(other["limited"] == first["limited"] for other in others)
    return scales, first["limited"] if sure else None
