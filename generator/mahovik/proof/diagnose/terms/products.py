"""The products of velocities, accelerations, phases and attitude that the equations are sums of, at many states."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations_with_replacement

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.hold import FREEDOMS, freedom_labels, freedom_names, wrenches
from mahovik.core.stand.model import TWIST_LETTERS, WRENCH_LETTERS, Stand
from mahovik.core.stand.state import State
from mahovik.proof.reference import Pieces
from mahovik.proof.reference.array import Array, vector
from mahovik.proof.reference.screw import T, twists

LEAST = 1e-12
"""Length below which a direction is none."""


@dataclass(frozen=True, eq=False)
class Frame:
    """Speeds that products are made of, and equations that are taken of the wrench on the carrier.

    letters     names of k speeds: letters of SNAME, or u_1, u_2, ... of freedoms without a name
    speeds      (k x 6) the speeds are this times V_r
    freedoms    (k x m) the speeds at V = S, that is at each freedom's u = 1
    components  c names of equations: letters of SNAME, or the number of a freedom without a name
    rows        (6 x c) equations = rows^T of a wrench on the carrier, in E1 about O1
    """

    letters: tuple[str, ...]
    speeds: Array
    freedoms: Array
    components: tuple[str, ...]
    rows: Array


def frame_of(stand: Stand, equations: str = "free") -> Frame:
    """Speeds and equations along what is `free`; or `all` six equations about the pivot, or what is `blocked` of them.

    In a stream the speeds are all six of the pivot, relative to the fluid.
    """
    hold, six = stand.hold, np.eye(6)
    if hold is None:
        return Frame(TWIST_LETTERS, six, six, WRENCH_LETTERS, six)
    S, W, names = twists(hold), wrenches(hold), freedom_names(hold)
    to_O1: Array = np.asarray(
        np.linalg.inv(T(vector(hold.pivot)).T), dtype=np.float64
    )  # V of a twist of the frame at the pivot with the axes of E1
    places = [list(FREEDOMS).index(name) if name in FREEDOMS else None for name in names]
    if any(stand.stream or ()) or stand.profile is not None:
        letters, speeds = tuple[str, ...](TWIST_LETTERS), np.asarray(np.linalg.inv(to_O1), dtype=np.float64)
    else:
        order = sorted(range(len(names)), key=lambda k: places[k] or 0)
        letters = tuple(f"u_{names[k]}" if (i := places[k]) is None else TWIST_LETTERS[i] for k in order)
        speeds = W[:, order].T
    if equations == "free":
        components = tuple(n if i is None else WRENCH_LETTERS[i] for n, i in zip(names, places, strict=True))
        return Frame(letters, speeds, speeds @ S, components, S)
    rows: Array = to_O1 if equations == "all" else (six - S @ W.T) @ to_O1
    there = [k for k in range(6) if np.linalg.norm(rows[:, k]) > LEAST]
    return Frame(letters, speeds, speeds @ S, tuple(WRENCH_LETTERS[k] for k in there), rows[:, there])


def frame_in_words(stand: Stand) -> tuple[str, str]:
    """The point that moments are about; and equations and speeds of a held carrier, "" of one without freedoms."""
    if stand.hold is None:
        return "O1", ""
    point, frame = "the pivot" if any(stand.hold.pivot) else "O1", frame_of(stand)
    if not stand.hold.freedoms:
        return point, ""
    labels = zip(frame.components, freedom_labels(stand.hold), strict=True)
    equations = "equations of what is free: " + ", ".join(f"{name} along {what}" for name, what in labels)
    if len(frame.letters) != len(frame.components):
        return point, f"{equations}; speeds are those of the pivot relative to the fluid"
    letters = (frame.letters[int(np.argmax(column))] for column in frame.freedoms.T)
    return point, f"{equations}; speeds: {', '.join(letters)}"


@dataclass(frozen=True, eq=False)
class Products:
    """Names of m products, their values (n, m), and which have the derivative of a velocity as a factor (m)."""

    names: tuple[str, ...]
    values: Array
    accelerate: NDArray[np.bool_]


def products(frame: Frame, states: Sequence[State], at: Sequence[Pieces], of_momentum: bool = False) -> Products:
    """All products at states, `at` their pieces: bilinear in velocities, linear in accelerations and attitude, with
    harmonics of phases; `of_momentum`: linear in velocities and stream."""
    wheels = [body.name for body in at[0].bodies.flywheels.bodies]
    phi, phi_dot, phi_ddot = (
        np.array([getattr(s, key) for s in states]).reshape(len(states), len(wheels)).T
        for key in ("phi", "phi_dot", "phi_ddot")
    )
    V = dict(zip(frame.letters, frame.speeds @ np.array([p.V_r for p in at]).T, strict=True))
    V_r_dot = np.array([p.V_r_dot(vector(s.V_dot)) for p, s in zip(at, states, strict=True)])
    V_dot = dict(zip((f"{a}_dot" for a in frame.letters), frame.speeds @ V_r_dot.T, strict=True))
    speeds = {f"{name}.speed": x for name, x in zip(wheels, phi_dot, strict=True)}
    waves = {"": np.ones(len(states))}
    for name, x in zip(wheels, phi, strict=True):
        for multiple in ("", "2 "):
            waves[f"cos {multiple}{name}"], waves[f"sin {multiple}{name}"] = (
                function((2 if multiple else 1) * x) for function in (np.cos, np.sin)
            )
    if of_momentum:
        stream = dict(zip(("stream_x", "stream_y", "stream_z"), np.array([p.u for p in at]).T, strict=True))
        return _products(_times_waves(V | speeds | (stream if any(x.any() for x in stream.values()) else {}), waves))
    g = np.array([p.gravity for p in at]).T
    size = np.linalg.norm(g, axis=0)
    down = dict(zip(("g_x", "g_y", "g_z"), g / size, strict=True)) if size.all() else {}
    two = {f"{a} {b}": V[a] * V[b] for a, b in combinations_with_replacement(frame.letters, 2)}
    table = {"1": waves[""]} | {wave: x for wave, x in waves.items() if wave} | V
    table |= {f"|{a}| {b}": np.abs(V[a]) * V[b] for a in V for b in V}
    table |= _times_waves(two | down | V_dot, waves) | speeds
    for (name, x), rate in zip(speeds.items(), phi_ddot, strict=True):
        wheel = name.removesuffix(".speed")
        of_wheel = {wave: value for wave, value in waves.items() if not wave or wave.split(" ", 1)[1] in
                    (wheel, f"2 {wheel}")}  # fmt: skip
        table |= _times_waves({f"{a} {name}": V[a] * x for a in V} | {f"{name} {name}": x * x}, of_wheel)
        table |= _times_waves(
            {f"{wheel}.acceleration": rate}, waves
        )  # of other flywheels as well: an index may be wrong
    return _products(table, V_dot)


def _times_waves(factors: Mapping[str, Array], waves: Mapping[str, Array]) -> dict[str, Array]:
    """Each factor times each harmonic."""
    return {f"{name} {wave}".strip(): x * y for wave, y in waves.items() for name, x in factors.items()}


def _products(table: Mapping[str, Array], rates: Mapping[str, Array] | None = None) -> Products:
    accelerate = np.array([name.split(" ")[0] in (rates or {}) for name in table])
    return Products(tuple(table), np.column_stack(list(table.values())), accelerate)


def count(stand: Stand) -> int:
    """How many products there are for a stand."""
    k, N = len(frame_of(stand).letters), len(stand.flywheels)
    waves, down = 1 + 4 * N, 3 if any(stand.gravity) else 0
    return waves + k + k**2 + waves * (k * (k + 1) // 2 + down + k) + N * (1 + 5 * (k + 1) + waves)
