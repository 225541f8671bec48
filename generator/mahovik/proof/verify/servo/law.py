"""The law of servo and trim (docs/control.md), literally in NumPy: nothing of the code that makes the C is here.

Each function takes the arguments of its C by their names, of structs as mappings, and gives what the C must write,
members of the state by their own names, with the status.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Values = Mapping[str, Any]

WHOLE = 3.0
"""Argument of dry friction from which it is whole."""

MOST_ROUNDS = 2**31 - 1
"""Number of rounds at which the count stops."""


def reset(state: Values) -> dict[str, Any]:
    """Every member of the state is zero, whatever was in it."""
    return {name: 0 if isinstance(x, int) else np.zeros_like(x) for name, x in state.items()} | {"status": "OK"}


def dry_friction(x: Array) -> Array:
    """Share of the dry friction: y (27 + y^2) / (27 + 9 y^2) with y = x inside -3..3, within 0.024 of tanh x."""
    y = np.clip(x, -WHOLE, WHOLE)
    return np.asarray((27 * y + y**3) / (27 + 9 * y**2))


def servo_step(
    gains: Values, state: Values, phi_ref: Array, phi_dot_ref: Array, tau_ff: Array, phi: Array, phi_dot: Array,
    invalid: Array | None, tau: Array,
) -> dict[str, Any]:  # fmt: skip
    """One sample of all servos; `invalid` (N): other than 0 where there is no good reading. LIMITED: a limit cut."""
    lost = np.zeros(len(tau), dtype=bool) if invalid is None else invalid != 0
    turn, slip = np.where(lost, 0.0, phi_ref - phi), np.where(lost, 0.0, phi_dot_ref - phi_dot)
    e = np.array([math.remainder(x, math.tau) for x in turn])  # within half a turn
    f = (1 - gains["filter"]) * state["speed"] + gains["filter"] * slip
    friction = gains["viscous"] * phi_dot_ref + gains["coulomb"] * dry_friction(gains["coulomb_rate"] * phi_dot_ref)
    z, last, limit = state["integral"], state["torque"], gains["limit"]
    u = tau_ff + friction + gains["angle"] * e + gains["speed"] * f + z
    tau = np.clip(u, np.maximum(-limit, last - gains["change"]), np.minimum(limit, last + gains["change"]))
    integral = np.clip(z + gains["integral"] * e + gains["back"] * (tau - u), -limit, limit)
    status = "LIMITED" if np.any(tau != u) else "OK"
    return {"tau": tau, "torque": tau, "speed": f, "integral": integral, "status": status}


def waves(phase: Array, harmonics: int) -> Array:
    """1, cos 1, sin 1, cos 2, ... (1 + 2 H, M) of 2 pi k times phases (M)."""
    angles = 2 * math.pi * np.arange(1, harmonics + 1)[:, None] * phase
    pairs = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    return np.vstack([np.ones((1, len(phase))), pairs.reshape(-1, len(phase))])


def coefficients(values: Array, phase: Array, harmonics: int) -> Array:
    """Mean, cosine 1, sine 1, ... (1 + 2 H, ..) of values (M, ..) at phases (M), as averages of a whole period."""
    sums = np.tensordot(waves(phase, harmonics), values, 1) / len(phase)
    return np.concatenate([sums[:1], 2 * sums[1:]])


def trim_step(
    design: Values, state: Values, phase: float, q: Array, phi: Array, phi_dot: Array, tau: Array
) -> dict[str, Any]:
    """One sample of a round: settling, the window, then the correction of one flywheel a sample.

    `sum` (C, T), T = 1 + 2 H: sums of the window, at its end the error of the Fourier coefficients; `wanted`, `present`
    (N, T): corrections. LIMITED: a correction was cut.
    """
    (N, T), first, sample = np.shape(state["wanted"]), design["settling"], state["sample"]
    end, limit, status = first + design["window"], design["limit"], "OK"
    total, wanted = state["sum"], np.array(state["wanted"])
    if first <= sample < end:
        total = (0.0 if sample == first else total) + np.outer(q, waves(np.array([phase]), T // 2))
        if sample == end - 1:
            total = total / design["window"] * np.where(np.arange(T) > 0, 2.0, 1.0) - design["target"]
    elif sample >= end:
        s = sample - end
        free = wanted[s] - design["matrix"][s * T : (s + 1) * T] @ total.ravel()
        wanted[s] = np.clip(free, -limit, limit)
        status = "LIMITED" if np.any(np.abs(free) > limit) else "OK"
    present = state["present"] + design["smoothing"] * (wanted - state["present"])
    k = np.arange(1, T // 2 + 1)
    turn = k * design["omega"]  # a Fourier series and its derivatives by time
    vector = np.exp(2j * math.pi * k * phase) * (present[:, 1::2] - 1j * present[:, 2::2])
    ends = sample + 1 == end + N
    return {
        "phi": phi + present[:, 0] + vector.real.sum(axis=1),
        "phi_dot": phi_dot + (1j * turn * vector).real.sum(axis=1),
        "tau": tau + design["inertia"] * (-(turn**2) * vector).real.sum(axis=1),
        "sum": total,
        "wanted": wanted,
        "present": present,
        "sample": 0 if ends else sample + 1,
        "rounds": min(state["rounds"] + ends, MOST_ROUNDS),
        "status": status,
    }


def trim_coordinates(
    sequence: str, chosen: Sequence[int], position: Array, attitude: Array, q: Array
) -> dict[str, Any]:
    """The `chosen` of x, y, z of O1 in E0 and the angles of a quaternion, w first; `sequence`: axes of the turns."""
    from scipy.spatial.transform import Rotation

    angles = Rotation.from_quat(np.roll(attitude, -1)).as_euler(sequence)
    return {"q": np.concatenate([position, angles])[list(chosen)], "status": "OK"}
