"""Scales of differences, measured: every number of stand and state changes a little, and the answer with them.

There is no formula of a scale anywhere. The literal reference is evaluated at a state and at neighbours of it, whose
stands and states have every number times 1 + D u, |u| <= 1; the largest change over D is the scale.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, fields, is_dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from mahovik.contract.limits import PERTURBATION, PERTURBATIONS, RESTING
from mahovik.contract.quantities import BESIDE, FLOORS
from mahovik.core.lower.limits import THRESHOLDS
from mahovik.core.program.types import DOUBLE, FLOAT
from mahovik.core.stand.model import Stand, State
from mahovik.core.stand.random import random_state
from mahovik.errors import StateError
from mahovik.proof import reference
from mahovik.proof.reference.algebra import Array, Values, times, transpose, twists, vector
from mahovik.proof.reference.evaluate import held_state
from mahovik.proof.reference.inverse import Cuts, inverse_root, scaled_demand
from mahovik.proof.reference.pieces import Bodies, Pieces, bodies_of, coupling_bias, velocity_matrix
from mahovik.proof.verify.states import stand_at

ORDINARY = 2
"""Seed of the ordinary state whose scales are floors at all others."""

ROUNDINGS, LAST_PLACE = 16.0, {"double": 2.0**-53, "float": 2.0**-24}
"""Roundings of its scale by which a number may be off; a rounding, relative."""

KEPT = 256
"""States whose neighbours are kept: they are drawn first, and judged then."""

Equation = Callable[[Stand, State, Pieces], Values]
"""An answer of the reference: numbers and words by name."""


@dataclass(frozen=True)
class Measured:
    """An answer of the reference and the scale of each number in it.

    undecided  a word of the answer (rank, an active set), or whether there is one, changes among the neighbours
    in_doubt   bits of its status that change among the neighbours
    exact      balls that hold the exact numbers, where they are known; what is judged is compared with these
    """

    values: Values
    scales: Mapping[str, Any]
    undecided: bool = False
    in_doubt: frozenset[str] = frozenset()
    exact: Mapping[str, Any] = field(default_factory=dict)


class Scales:
    """Answers of the literal reference on one stand, with their scales."""

    def __init__(self, stand: Stand, real: str = "double", seed: int = 0, neighbours: int = PERTURBATIONS) -> None:
        self.stand, self.real = stand, real
        self.precision = FLOAT if real == "float" else DOUBLE
        threshold = THRESHOLDS[real]
        self.cuts = Cuts(threshold.rank, reached=threshold.unreachable)
        self._size, self._rng = PERTURBATION[real], np.random.default_rng(seed)
        changed_stands = (self.change(stand, self._size) for _ in range(neighbours))
        self._stands = [(near, bodies_of(near)) for near in (stand, *changed_stands)]
        self._kept: dict[int, tuple[State, list[tuple[Stand, State, Pieces]]]] = {}
        self._ordinary: dict[str, Mapping[str, Any]] = {}
        self._wants: dict[tuple[int, str], tuple[State, Measured | None]] = {}

    def want(self, state: State, want: str) -> Measured | None:
        """Answer to a want of `eval`; None where the reference refuses it."""
        known = self._wants.get((id(state), want))
        if known is None:
            known = state, self._try_want(state, want)
            self._wants[id(state), want] = known
        return known[1]

    def equation(self, want: str) -> Equation:
        """The reference's answer to a want of `eval`."""
        return lambda stand, state, at: reference.evaluate(stand, state, (want,), at, self.cuts)

    def _try_want(self, state: State, want: str) -> Measured | None:
        try:
            measured = self.measure(state, self.equation(want), want == "inverse")
        except (StateError, np.linalg.LinAlgError, ArithmeticError):
            return None
        if state.task:
            return measured
        if want == "inverse" and (rank := measured.values["rank"]):
            # a subnormal singular value has lost its digits, or is zero
            lost = measured.values["sigma"][rank - 1] < self.precision.smallest
            measured = replace(measured, undecided=measured.undecided or bool(lost))
        if want not in self._ordinary:
            self._ordinary[want] = self._ordinary_scales(want)
        return replace(measured, scales=_raised(measured.scales, self._ordinary[want]))

    def reach(self, state: State, inverse: Measured, residual: Any) -> bool | None:
        """Whether UNREACHABLE is due of an answer to `inverse` by its own residual (m); None where it must be that of
        the reference, as rounding of the element type does not decide it.

        Neighbours do not show that it does: each has its own answer, with its own residual. That of one answer is what
        is left of terms that cancel, and these may be far above the demand, of which the bound is a part.
        """
        expected, scale = inverse.values["residual"], inverse.scales["residual"]
        if np.shape(residual) != np.shape(expected) or not np.isfinite(residual).all():
            return None
        _, near, at = self.neighbours(state)[0]
        scaled = scaled_demand(at, vector(near.V_dot))
        with np.errstate(over="ignore"):
            left, bound = np.linalg.norm(scaled.root @ expected), self.cuts.reached * np.linalg.norm(scaled.r)
            if abs(left - bound) > ROUNDINGS * LAST_PLACE[self.real] * np.linalg.norm(scaled.root * scale):
                return None
            return bool(np.linalg.norm(scaled.root @ vector(residual)) > bound)

    def _ordinary_scales(self, want: str) -> Mapping[str, Any]:
        """Scales at an ordinary state; none where the reference refuses it."""
        try:
            return self.measure(self._ordinary_state, self.equation(want), want == "inverse").scales
        except (StateError, np.linalg.LinAlgError, ArithmeticError):
            return {}

    @cached_property
    def _ordinary_state(self) -> State:
        state = random_state(self.stand, np.random.default_rng(ORDINARY))
        return replace(state, quaternion=None, angles=(0.3, 0.6, -0.4)) if self.stand.hold is None else state

    def measure(self, state: State, equation: Equation, least_squares: bool = False) -> Measured:
        """The answer of an equation at a state and its scales. Raises what the equation raises there.

        `least_squares`: what K, I and F change by in their norms counts as well.
        """
        with np.errstate(all="ignore"):
            neighbours = self.neighbours(state)
            values, answers, undecided, in_doubt = equation(*neighbours[0]), [], False, set[str]()
            words, bits = words_of(values), bits_of(values.get("status", ""))
            for neighbour in neighbours[1:]:
                try:
                    other = equation(*neighbour)
                except (StateError, np.linalg.LinAlgError, ArithmeticError):
                    undecided = True
                    continue
                undecided = undecided or words_of(other) != words
                in_doubt |= bits_of(other.get("status", "")) ^ bits
                answers.append(other)
            stand, held, at = neighbours[0]
            shaken = list(self._shaken(at)) if least_squares and len(at.flywheels) else []
            for pieces in shaken:
                with suppress(StateError, np.linalg.LinAlgError, ArithmeticError):
                    answers.append(equation(stand, held, pieces))
            scales = {
                name: self._scale(name, value, [answer[name] for answer in answers]) for name, value in values.items()
            }
            for name in FLOORS.keys() & scales.keys():
                scales[name] = scales[name] + self._floor(name, state, values, scales, shaken)
        return Measured(values, scales, undecided, frozenset(in_doubt))

    def at(self, state: State) -> Pieces:
        """Pieces of the reference at a state."""
        return self.neighbours(state)[0][2]

    def neighbours(self, state: State) -> list[tuple[Stand, State, Pieces]]:
        """The stand, the state and its pieces, and those of the neighbours; kept for other equations at the state."""
        known = self._kept.get(id(state))
        if known is None:
            with np.errstate(all="ignore"):
                known = state, list(self._draw_neighbours(state))
            self._kept[id(state)] = known
            if len(self._kept) > KEPT:
                del self._kept[next(iter(self._kept))]
        return known[1]

    def _draw_neighbours(self, state: State) -> Iterator[tuple[Stand, State, Pieces]]:
        for number, (stand_near, bodies_near) in enumerate(self._stands):
            moved = self.moved(state, self._size) if number else state
            stand = stand_at(stand_near, moved) if moved.actuators else stand_near
            bodies: Bodies | None = None if moved.actuators else bodies_near
            moved = held_state(stand, moved)
            yield stand, moved, reference.pieces(stand, moved, bodies)

    def moved(self, state: State, size: float) -> State:
        """The state with every number times 1 + size u, |u| <= 1, and a quaternion of unit length."""
        return self._unit(self.change(state, size))

    def change(self, data: Any, size: float) -> Any:
        """Nested data with every number times 1 + size u, |u| <= 1."""
        return changed(data, size, self._rng)

    @staticmethod
    def _unit(state: State) -> State:
        """The state with a quaternion of unit length."""
        if state.quaternion is None:
            return state
        q = np.array(state.quaternion)
        w, x, y, z = (q / np.sqrt(q @ q)).tolist()
        return replace(state, quaternion=(w, x, y, z))

    def _scale(self, name: str, value: Any, answers: list[Any]) -> Any:
        """Scale of a value; None of a word."""
        if isinstance(value, Mapping):
            return {key: self._scale(key, part, [other[key] for other in answers]) for key, part in value.items()}
        if is_word(value):
            return None
        number = np.asarray(value, dtype=np.float64)
        nearby = np.array(answers, dtype=np.float64).reshape(len(answers), *number.shape)
        largest = np.maximum(np.abs(number), np.max(np.abs(nearby - number), axis=0, initial=0.0) / self._size)
        largest = share(largest, BESIDE.get(name))
        return np.maximum(largest, RESTING * np.max(largest, initial=0.0))

    def _floor(
        self, name: str, state: State, values: Values, scales: Mapping[str, Any], shaken: Sequence[Pieces]
    ) -> Any:
        """What the contract declares to be added to a scale; terms of least squares round as their norms do."""
        kind, (_, held, at) = FLOORS[name], self.neighbours(state)[0]
        if kind == "own":
            return 0.0
        if kind == "largest":
            return np.max(scales[name], initial=0.0)
        if kind == "spin":
            squares = RESTING * at.phi_dot**2
            return np.diag(at.Theta_ff) * squares if name == "tau" else squares
        if kind == "turning":
            return np.reshape(share(turning(at), 0), np.shape(scales[name]))
        if state.task and name == "residual":
            return np.abs(vector(state.demand)) + np.max(scales["V_dot"], initial=0.0)
        if kind == "motion":
            return self._motion_floor(name, held, at)
        moved = values.get("V_dot", vector(held.V_dot)), values.get("phi_ddot", vector(held.phi_ddot))
        near = [*(other for _, _, other in self.neighbours(state)[1:]), *shaken]
        terms = self._scale("", _terms(at, *moved), [_terms(other, *moved) for other in near]).sum(axis=0)
        if name == "reaction" or self.stand.hold is None:
            return terms
        return np.abs(twists(self.stand.hold)).T @ terms

    def _motion_floor(self, name: str, state: State, at: Pieces) -> Any:
        """RESTING of what the terms of (8) accelerate together: |x_i| <= sqrt((K^-1)_ii) |terms|, in the norm of K^-1.

        Where nothing acts along a freedom, or all that acts cancels, solving leaves rounding of what the hold bears. In
        M V_r products cancel for any numbers, such as those of v x m v: it counts by the size of these.
        """
        S = twists(self.stand.hold)
        if not S.size:
            return 0.0
        root = inverse_root(at.K)
        V, _, M, _ = _velocity_terms(at)
        terms = [*_terms(at, vector(state.V_dot), vector(state.phi_ddot)), np.abs(M) @ np.abs(V)]
        size = sum(np.linalg.norm(root @ term) for term in terms)
        along = RESTING * size * np.sqrt(np.diag(np.linalg.inv(S.T @ at.K @ S)))
        if name == "V_dot":
            return np.abs(S) @ along
        if name == "u_dot" or self.stand.hold is not None:
            return along
        return np.repeat([np.max(along[:3]), np.max(along[3:])], 3)

    def _shaken(self, at: Pieces) -> Iterator[Pieces]:
        """Pieces whose K, I and F have all elements changed by D of their norms, with masses and inertias as units.

        A solver of least squares rounds relative to these norms, not to each element.
        """
        L, Theta, rng = np.linalg.cholesky(at.K), np.sqrt(np.diag(at.Theta_ff)), self._rng
        root = np.linalg.inv(L)
        X = root @ at.I / Theta
        size = sum(float(np.linalg.norm(root @ term)) for term in _terms(at, np.zeros(6), np.zeros(len(Theta))))
        of_I, of_F = (self._size * number for number in (float(np.linalg.norm(X)), size))
        for _ in range(PERTURBATIONS):
            R = self._size * rng.uniform(-1.0, 1.0, (6, 6))
            I = at.I + L @ (of_I * rng.uniform(-0.4, 0.4, X.shape)) * Theta
            F = at.F + L @ (of_F * rng.uniform(-0.4, 0.4, 6))
            yield replace(at, K=L @ (np.eye(6) + (R + R.T) / 2.0) @ L.T, I=I, F=F)


class Laws:
    """Laws in the place of the equations of a reference, at inputs by name in the place of states."""

    def __init__(self, real: str, rng: np.random.Generator) -> None:
        self._size, self._rng = PERTURBATION[real], rng

    def measure(self, inputs: Mapping[str, Any], law: Callable[..., Values], least_squares: bool = False) -> Measured:
        """What a law gives of inputs; a scale is the number itself, or its largest change over that of every input."""
        values = law(**inputs)
        nearby = [law(**changed(dict(inputs), self._size, self._rng)) for _ in range(PERTURBATIONS)]
        scales = {
            name: None if is_word(value) else
            np.max([np.abs(value), *(np.abs(near[name] - value) / self._size for near in nearby)], axis=0)
            for name, value in values.items()
        }  # fmt: skip
        in_doubt = {bit for near in nearby for bit in bits_of(near["status"]) ^ bits_of(values["status"])}
        return Measured(values, scales, any(words_of(near) != words_of(values) for near in nearby), frozenset(in_doubt))


def changed(data: Any, size: float, rng: np.random.Generator) -> Any:
    """Nested data with every number times 1 + size u, |u| <= 1; whole numbers stay."""
    if isinstance(data, float):
        return data * (1.0 + size * rng.uniform(-1.0, 1.0))
    if data is None or isinstance(data, str | int):
        return data
    if isinstance(data, np.ndarray):
        return data * (1.0 + size * rng.uniform(-1.0, 1.0, data.shape)) if data.dtype.kind == "f" else data
    if isinstance(data, tuple):
        if all(isinstance(element, float) for element in data):
            parts = rng.uniform(-1.0, 1.0, len(data)).tolist()
            return tuple([x * (1.0 + size * part) for x, part in zip(data, parts, strict=True)])
        return tuple(changed(element, size, rng) for element in data)
    if is_dataclass(data) and not isinstance(data, type):
        return replace(data, **{f.name: changed(getattr(data, f.name), size, rng) for f in fields(data) if f.init})
    if isinstance(data, Mapping):
        return type(data)({name: changed(value, size, rng) for name, value in data.items()})  # type: ignore
    return data


def scales_of(stand: Stand, state: State, want: str) -> Mapping[str, Any]:
    """Scales of what a want of `eval` gives. Raises what the reference raises at this state."""
    scales = Scales(stand)
    return scales.measure(state, scales.equation(want)).scales


def _raised(scales: Mapping[str, Any], ordinary: Mapping[str, Any]) -> dict[str, Any]:
    """Scales that are at least RESTING of those at an ordinary state: at rest nothing has a size of its own."""
    result: dict[str, Any] = {}
    for name, scale in scales.items():
        other = ordinary.get(name)
        if isinstance(scale, Mapping):
            result[name] = _raised(scale, other or {})
        else:
            result[name] = scale if scale is None or other is None else np.maximum(scale, RESTING * other)
    return result


def turning(at: Pieces) -> Array:
    """|phi_s' Theta_s Ls^T V| (Nx6; N, N m): in (4) both terms have it, with opposite signs, since Es turns."""
    wheels = at.bodies.flywheels
    return np.abs(at.phi_dot[:, None] * times(wheels.Theta, transpose(wheels.L) @ at.V))


def _velocity_terms(at: Pieces) -> tuple[Array, Array, Array, Array]:
    """V_r of (8), what its rate is beside V*, M and J; of rigid bodies alone those of V."""
    if at.Lambda.any() or not at.u.any():
        return at.V_r, at.stream_rate, at.M, at.J
    return at.V, np.zeros(6), velocity_matrix(at.K_bodies, at.K_dot, at.V), coupling_bias(at.bodies.flywheels, at.V)


def _terms(at: Pieces, V_dot: Array, phi_ddot: Array) -> Array:
    """F, K V*, M V, J phi', I phi'' of (8), one below the other (5x6)."""
    V, drift, M, J = _velocity_terms(at)
    return np.stack([at.F, at.K @ (V_dot + drift), M @ V, J @ at.phi_dot, at.I @ phi_ddot])


def is_word(value: Any) -> bool:
    """Whether a value is a word or counts something: only equality is right."""
    return isinstance(value, str | int) or (isinstance(value, np.ndarray) and value.dtype.kind in "ib")


def words_of(values: Values) -> dict[str, Any]:
    """Words of an answer by name, but its status."""
    return {name: np.asarray(value).tolist() for name, value in values.items() if is_word(value) and name != "status"}


def bits_of(status: str) -> set[str]:
    """Names of the bits of a status in words."""
    return {*status.split("|")} - {"OK", ""}


def share(scale: Array, beside: int | None) -> Array:
    """The largest in each block of three along every axis of three or six: components that a rotation mixes.

    `beside`: the axis along which flywheels or freedoms stand, each with its own scale.
    """
    for axis, count in enumerate(scale.shape):
        if count in (3, 6) and axis != beside:
            blocks = (*scale.shape[:axis], count // 3, 3, *scale.shape[axis + 1 :])
            largest = scale.reshape(blocks).max(axis=axis + 1, keepdims=True)
            scale = np.broadcast_to(largest, blocks).reshape(scale.shape)
    return scale
