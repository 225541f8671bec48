"""What a program is asked, at states at which faults look different from one another; its answers as one vector; their
scale, and the rounding of a program."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from decimal import Decimal
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.model import Stand, State
from mahovik.core.stand.random import in_layer, random_state, random_wrenches
from mahovik.errors import StateError
from mahovik.proof import reference
from mahovik.proof.reference import Pieces
from mahovik.proof.reference.algebra import Array, Values
from mahovik.proof.reference.evaluate import held_state
from mahovik.proof.verify.draw import with_angles, with_drawn_actuators, with_quaternion
from mahovik.proof.verify.foreign import Program
from mahovik.proof.verify.scales import Scales
from mahovik.proof.verify.states import Request, stand_at

Answers = Callable[[Request], Mapping[str, Any]]
"""Answer of a program to a request: empty if it refused."""

Model = Callable[[State, str], Mapping[str, Any]]
"""Values of a want at a state, by some equations: empty where they have none."""

Mask = NDArray[np.bool_]

NOT_COMPARED = ("status", "rank")

LEAST = 1e-290

ACCEPTED = {"double": 1e-11, "float": 1e-4}
"""Part of the scale to which rounding may add up in right equations of whatever form, by arithmetic."""

NINE_DIGITS = 5e-9
"""Relative rounding of a number written with nine digits; one of double lies up to 6e-8 from the next of float."""

MOST_DIGITS, MOST_DECIMALS = 15, 13
"""Digits, and places behind the point, up to which a program is taken to round its numbers as it prints them."""


@dataclass(frozen=True)
class Precision:
    """Precision of a program, read off its answers.

    name      "double", "float", with the digits that it prints if it prints few; or the tolerance that the user gave
    accepted  part of the scale that its arithmetic may leave
    digits    significant digits that it prints; decimals: most places behind the point
    """

    name: str
    accepted: float
    digits: int
    decimals: int

    @classmethod
    def of(cls, numbers: Array, tolerance: float = 0.0) -> Precision:
        """Precision of a program, read off the numbers of its answers; `tolerance`: the least that the user accepts."""
        there = numbers[np.isfinite(numbers) & (numbers != 0.0)]
        with np.errstate(over="ignore"):
            rounded = there.astype(np.float32).astype(np.float64)
        is_float = bool(there.size and (np.abs(there - rounded) <= NINE_DIGITS * np.abs(there)).all())
        written = [Decimal(repr(x)).normalize().as_tuple() for x in there.tolist()]
        digits = max((len(number.digits) for number in written), default=17)
        decimals = max((-int(number.exponent) for number in written), default=330)
        name = "float" if is_float else "double"
        accepted = ACCEPTED[name]
        if digits <= MOST_DIGITS or decimals <= MOST_DECIMALS:
            printed = f"{digits} digits" if digits <= MOST_DIGITS else f"{decimals} decimals"
            name = printed if not is_float else f"float, {printed}"
        if accepted < tolerance:
            name, accepted = f"tolerance {tolerance:.1g}", tolerance
        return cls(name, accepted, digits, decimals if min(digits, decimals + 2) <= MOST_DIGITS else 330)

    def noise(self, numbers: Array, scale: Array) -> Array:
        """Largest rounding error of numbers with a scale."""
        printed = 0.5 * 10.0 ** (1 - self.digits) * np.abs(numbers) if self.digits <= MOST_DIGITS else 0.0
        return np.asarray(self.accepted * scale + 2.0 * (printed + 0.5 * 10.0**-self.decimals))


class Reference:
    """The literal reference of one stand as a program. The pieces of the last state are kept, for its other wants."""

    def __init__(self, stand: Stand) -> None:
        self._stand = stand
        self._last: tuple[State, Stand, State, Pieces] | None = None

    def __call__(self, state: State, want: str) -> Values:
        """Values of a want; none where the reference refuses."""
        try:
            with np.errstate(all="ignore"):
                if self._last is None or self._last[0] is not state:
                    stand = stand_at(self._stand, state)
                    held = held_state(stand, state)
                    self._last = state, stand, held, reference.pieces(stand, held)
                _, stand, held, at = self._last
                return reference.evaluate(stand, held, (want,), at)
        except (StateError, np.linalg.LinAlgError, ArithmeticError, ValueError):
            return {}


@dataclass(frozen=True, eq=False)
class AnswerVector:
    """Requests of one want each and the answers of the reference, as vectors of the same length.

    block     of each number, the index in `quantities` of its (want, quantity)
    expected  of the reference
    scale     measured, see proof.verify.scales
    parts     of each request, its slices: (quantity as a path, shape, start)
    ranks     of each request, the rank that the reference answers; None where it answers none
    """

    requests: tuple[Request, ...]
    quantities: tuple[tuple[str, str], ...]
    block: NDArray[np.int64]
    expected: Array
    scale: Array
    parts: tuple[tuple[tuple[tuple[str, ...], tuple[int, ...], int], ...], ...]
    ranks: tuple[int | None, ...]

    @classmethod
    def of(cls, stand: Stand, requests: Sequence[Request]) -> AnswerVector:
        """The vector of one-want requests; those that the reference refuses are left out."""
        scales, quantities, kept = Scales(stand), dict[tuple[str, str], int](), []
        blocks, expected, scale, start = [np.zeros(0)], [np.zeros(0)], [np.zeros(0)], 0
        for request in requests:
            (want,) = request.want
            measured = scales.want(request.state, want)
            if measured is None:
                continue
            places, sizes = [], dict(_leaves(measured.scales))
            for path, value in _leaves(measured.values):
                name = path[0] if len(path) == 1 else f"{path[0]}.{path[-1]}"
                blocks.append(np.full(value.size, quantities.setdefault((want, name), len(quantities))))
                expected.append(value.ravel())
                scale.append(np.maximum(sizes[path].ravel(), LEAST))
                places.append((path, value.shape, start))
                start += value.size
            kept.append((request, tuple(places), measured.values.get("rank")))
        block, right, size = map(np.concatenate, (blocks, expected, scale))
        asked, parts, ranks = zip(*kept, strict=True) if kept else ((), (), ())
        return cls(asked, tuple(quantities), block.astype(np.int64), right, size, parts, ranks)

    def fill(self, answers: Answers, among: Collection[str] | None = None) -> Array:
        """The same numbers from other answers; NaN if missing, of another shape, or of no request `among` these ids.

        Where a rank is another one, rounding decides what the numbers are: they count as right.
        """
        result = np.full(self.expected.size, np.nan)
        for request, parts, rank in zip(self.requests, self.parts, self.ranks, strict=True):
            if among is not None and request.id not in among:
                continue
            values = answers(request)
            other_rank = rank is not None and values.get("rank", rank) != rank
            for path, shape, start in parts:
                place, numbers = slice(start, start + int(np.prod(shape))), numbers_at(values, path)
                if other_rank:
                    result[place] = self.expected[place]
                elif numbers is not None and numbers.shape == shape:
                    result[place] = numbers.ravel()
        return result

    def of_model(self, model: Model, among: Collection[str] | None = None) -> Array:
        """The numbers that other equations answer; NaN where they have none, and of other requests than these ids."""
        return self.fill(lambda request: model(request.state, request.want[0]), among)

    def places(self, among: Collection[str]) -> Mask:
        """Mask of the numbers that belong to the requests with these ids."""
        sizes = [sum(int(np.prod(shape)) for _, shape, _ in parts) for parts in self.parts]
        return np.repeat([request.id in among for request in self.requests], sizes)

    def words_of(self, places: Mask) -> tuple[str, ...]:
        """Quantities that some numbers belong to, as want: quantity."""
        return tuple(": ".join(self.quantities[i]) for i in sorted({int(i) for i in self.block[places]}))


def _leaves(values: Mapping[str, Any], path: tuple[str, ...] = ()) -> Iterator[tuple[tuple[str, ...], Array]]:
    for name, value in values.items():
        if isinstance(value, Mapping):
            yield from _leaves(value, (*path, name))
        elif name not in NOT_COMPARED:
            yield (*path, name), np.asarray(value, dtype=np.float64)


def numbers_at(values: Any, path: tuple[str, ...]) -> Array | None:
    """Numbers of a quantity in an answer, in whatever shape; None: missing, or no array of numbers."""
    for name in path:
        if not isinstance(values, Mapping) or name not in values:
            return None
        values = values[name]
    try:
        return np.array(values, dtype=np.float64)
    except (ValueError, TypeError, OverflowError):
        return None


# -- states ------------------------------------------------------------------------------------------------------------

FIRST = 3
"""Number of leading states with all features active: every visible fault shows in them, so they suffice to search."""

ALONE = 4
"""Largest number of flywheels that have a state in which they alone turn."""

STILL: Mapping[str, str] = {
    "all 1": "",
    "all 2": "",
    "all 3": "",
    "at rest": "V phi_dot phi_ddot V_dot tau",
    "flywheels turn": "V phi_ddot V_dot tau",
    "flywheels accelerate": "V phi_dot V_dot",
    "carrier moves": "phi_dot phi_ddot V_dot tau",
    "carrier accelerates": "V phi_dot phi_ddot",
    "no acceleration": "phi_ddot V_dot tau",
}
"""States, and what is zero there."""

BY_QUATERNION = ("all 2", "no acceleration")


def separating_states(stand: Stand, seed: int = 1, program: Program | None = None) -> list[tuple[str, State]]:
    """States with their names, the same for the same seed; without the extremes of `verify`, which rounding disturbs.

    `program`: that takes them, in the form in which it is given them.
    """
    rng = np.random.default_rng(seed)
    alone = {f"{k.name} turns": k.name for k in stand.flywheels[:ALONE]}
    result = []
    for number, name in enumerate((*STILL, *alone)):
        state = random_state(stand, rng)
        if name in BY_QUATERNION:
            state = with_quaternion(stand, state)
        else:
            while not 0.3 < abs(with_angles(stand, state).angles[1]) < 1.2:  # type: ignore[index]
                state = random_state(stand, rng)  # well off the singularity of the angles
            state = with_angles(stand, state)
        takes = [body.name for body in stand.bodies if body.wrench_input] if number < FIRST - 1 else []
        changes: dict[str, Any] = {"wrench": random_wrenches(rng, takes) if takes else MappingProxyType({})}
        for key in STILL.get(name, "").split():
            changes |= {rate: (0.0,) * len(getattr(state, rate)) for rate in (key, key.replace("V", "u"))}
        if name in alone:
            speeds = zip(stand.flywheels, state.phi_dot, strict=True)
            changes["phi_dot"] = tuple(x if k.name == alone[name] else 0.0 for k, x in speeds)
        state = replace(state, **changes)
        if stand.profile is not None:  # layer by layer from the lowest
            layers = len(stand.profile.depth) - 1
            state = in_layer(stand, state, layers - 1 - number % layers, (0.7, 0.4)[number % 2])
        if program is not None:
            state = with_drawn_actuators(stand, state, rng) if program.actuators else state
            state = program.state(stand, state)
        result.append((name, state))
    return result


def spread_rows(states: Sequence[tuple[str, State]], count: int) -> list[tuple[str, State]]:
    """At most `count` rows of a log, spread evenly."""
    return [states[k] for k in np.linspace(0, len(states) - 1, min(count, len(states))).astype(int)]
