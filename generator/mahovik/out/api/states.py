"""States of a stand: one, or many with a batch axis, in the memory that the batch C reads; and how they are made."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, TypedDict, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mahovik.contract.quantities import UNIT_LENGTH
from mahovik.core.stand.hold import freedom_names, twists
from mahovik.core.stand.model import TWIST_LETTERS, Stand
from mahovik.errors import InputError
from mahovik.nearest import suggestion
from mahovik.out.api import held_states
from mahovik.out.api.inputs import Given, batch_size, by_component, is_count, numbers, read
from mahovik.out.result import Column, Result
from mahovik.proof.verify.held import blocked_twist
from mahovik.proof.verify.states import ROUNDING

Array = NDArray[Any]

ARRAYS = ("position", "attitude", "V", "phi", "phi_dot")


class States:
    """States of one stand: `position`, `attitude`, `V`, `phi`, `phi_dot`, arrays of shape (n, k), or (k,) of one state.

    position  m; of O1 in E0
    attitude  unit quaternion, w first: x0 = C x1
    V         m/s, rad/s; twist of the carrier relative to E0, in E1 about O1
    phi       rad; phases of the flywheels
    phi_dot   rad/s; their speeds relative to the mount

    The arrays are views: writing into them writes the states, and so does `x.V = ...` or `x["phi_dot", "w1"] = 100.0`.
    `dict(x)` has them by name. Made by `Model.state` and `Model.states`.
    """

    position: Array
    attitude: Array
    V: Array
    phi: Array
    phi_dot: Array

    def __init__(self, stand: str, columns: Sequence[Column], memory: Array, single: bool) -> None:
        """`columns`: one of no state, of each array; `memory`: (components, n), contiguous."""
        self._stand, self._columns, self._memory, self._single = stand, columns, memory, single

    @property
    def array(self) -> Array:
        """All numbers of a state side by side, shape (n, 13 + 2 N): position, attitude, V, phi, phi_dot. A view."""
        return self._memory[:, 0] if self._single else self._memory.T

    @property
    def batch(self) -> int | None:
        """Number of states; None: a single state, arrays without batch axis."""
        return None if self._single else self._memory.shape[1]

    def keys(self) -> tuple[str, ...]:
        """Names of the arrays."""
        return ARRAYS

    def __getitem__(self, key: str | tuple[Any, ...]) -> Array:
        name, *labels = key if isinstance(key, tuple) else (key,)
        first = 0
        for one in self._columns:
            size = one.values.shape[1]
            if one.name == name:
                result: Array = self.array[..., first : first + size]
                return result[one.part(*labels)] if labels else result
            first += size
        if name in ARRAYS:  # no flywheels
            return self.array[..., :0]
        raise InputError(f'"{name}": no such name{suggestion(str(name), ARRAYS)}')

    def __setitem__(self, key: str | tuple[Any, ...], value: ArrayLike) -> None:
        name = str(key[0] if isinstance(key, tuple) else key)
        target, array = self[key], numbers(value, name)
        try:
            target[...] = array
        except ValueError:
            raise InputError(f"{name}: expected shape {target.shape}, found {array.shape}") from None

    def __getattr__(self, name: str) -> Array:
        if name not in ARRAYS:
            raise AttributeError(f"{name}: states have no such array{suggestion(name, ARRAYS)}")
        return self[name]

    def __setattr__(self, name: str, value: Any) -> None:
        if name.startswith("_"):
            super().__setattr__(name, value)
        elif name in ARRAYS:
            self[name] = value
        else:
            raise InputError(f"{name}: states have no such array{suggestion(name, ARRAYS)}")

    def __len__(self) -> int:
        if self._single:
            raise InputError("a single state has no length")
        return int(self._memory.shape[1])

    def take(self, which: int | slice | ArrayLike) -> States:
        """A copy of some of the states: of one by its number, of several by a slice, numbers or flags."""
        if self._single:
            raise InputError("take: a single state, expected a batch")
        try:
            part = self._memory[:, cast(Any, which)]  # NumPy itself says what is no index
        except (IndexError, ValueError, TypeError) as error:
            raise InputError(f"take: {error}") from None
        if part.ndim > 2:
            raise InputError(f"take: expected a number, a slice or one list, found {which!r:.60}")
        single = part.ndim == 1
        memory = np.array(part[:, np.newaxis] if single else part, order="C")
        return States(self._stand, self._columns, memory, single)

    def copy(self) -> States:
        """States with memory of their own."""
        return States(self._stand, self._columns, self._memory.copy(), self._single)

    def is_like(self, columns: Sequence[Column]) -> bool:
        """Whether the arrays are these: of a stand with the same flywheels."""
        return self._columns is columns or [x[::3] for x in self._columns] == [x[::3] for x in columns]

    def __repr__(self) -> str:
        of = "a state" if self._single else f"{len(self)} states"
        return f"<States: {of} of {self._stand}; {', '.join(one.name for one in self._columns)}>"

    def _repr_html_(self) -> str:
        columns = [one._replace(values=self[one.name][np.newaxis]) for one in self._columns]
        return Result(repr(self).strip("<>"), columns, single=True)._repr_html_()


# -- making states -----------------------------------------------------------------------------------------------------


class StateNumbers(TypedDict, total=False):
    """Numbers of states, those left out zero: see `Model.states`."""

    position: ArrayLike | None
    attitude: ArrayLike | None
    angles: ArrayLike | None
    V: Given
    u: Given | None
    phi: Given
    phi_dot: Given


Parts = dict[str, tuple[Array, int]]
"""Arrays of shape (), (count,), (n, count) and their counts, by name."""


class StateMaker:
    """Makes states of a stand. `quaternions`: of angles (3, or n x 3) of its sequence; `columns` as in `States`."""

    def __init__(
        self, stand: Stand, columns: Sequence[Column], element: np.dtype[Any], quaternions: Callable[[Array], Array]
    ) -> None:
        self.stand, self.columns, self.element, self.quaternions = stand, columns, element, quaternions
        self.flywheels = tuple(s.name for s in stand.flywheels)
        self.components = sum(one.values.shape[1] for one in columns)

    def states(self, n: int | None, state_numbers: StateNumbers) -> States:
        """See `Model.states`."""
        if unknown := state_numbers.keys() - StateNumbers.__annotations__.keys():
            name = min(unknown)
            raise InputError(f"states: unknown {name}{suggestion(name, StateNumbers.__annotations__)}")
        place, turn = self._pose(
            state_numbers.get("position"), state_numbers.get("attitude"), state_numbers.get("angles")
        )
        parts: Parts = {"position": (place, 3), "attitude": (turn, 4)}
        parts |= {
            "V": (self._twist(state_numbers.get("V", 0.0), state_numbers.get("u")), 6),
            **self._flywheel_parts(state_numbers),
        }
        return self._stacked(parts, n)

    def from_coordinates(
        self, q: Given, q_dot: Given, orientation: ArrayLike | None, wheel_numbers: Mapping[str, Given]
    ) -> States:
        """See `Model.state_from_coordinates`."""
        names, hold = held_states.coordinate_names(self.stand), self.stand.hold
        assert hold is not None
        m = len(hold.freedoms)
        if not names and not (isinstance(q, float) and q == 0.0):
            raise InputError("q: the freedoms of this [hold] have no number of their own; expected orientation")
        if orientation is not None and len(names) == m:
            raise InputError(f"orientation: the freedoms of this [hold] have none; expected q of {', '.join(names)}")
        parts: Parts = {
            "q": (read(q, "q", len(names), names, "freedom") if names else np.zeros(()), len(names)),
            "orientation": (self._attitudes(orientation, None), 4),
            "q_dot": (read(q_dot, "q_dot", m, freedom_names(hold), "freedom"), m),
        }
        wheels = self._flywheel_parts(wheel_numbers)
        n = batch_size({name: part for name, (part, _) in (parts | wheels).items()})
        coordinates = [by_component(part, count, n or 1, np.dtype(float)).T for part, count in parts.values()]
        place, turn, V = held_states.of_coordinates(self.stand, *coordinates)
        states = self._stacked({"position": (place, 3), "attitude": (turn, 4), "V": (V, 6), **wheels}, None)
        return states if n is not None else states.take(0)

    def of_array(self, array: ArrayLike) -> States:
        """See `Model.states_of`."""
        states = read(array, "states", self.components, (), "component")
        if states.ndim == 0:
            raise InputError(f"states: expected shape ({self.components},) or (n, {self.components}), found ()")
        return self._stacked({"states": (states, self.components)}, None)

    def _flywheel_parts(self, state_numbers: Any) -> Parts:
        N, names = len(self.flywheels), self.flywheels
        wheel_numbers = {name: state_numbers.get(name, 0.0) for name in ("phi", "phi_dot")}
        return {name: (read(value, name, N, names, "flywheel"), N) for name, value in wheel_numbers.items()}

    def _stacked(self, parts: Parts, n: int | None) -> States:
        """States of the parts below one another, n of them, or as many as the parts have. Raises InputError."""
        many = batch_size({name: part for name, (part, _) in parts.items()})
        if n is not None and not is_count(n):
            raise InputError(f"states: n: expected a number of states, found {n!r:.40}")
        if n is not None and many not in (None, n):
            raise InputError(f"states: n is {n}, but arrays of {many} states were given")
        size = n if n is not None else many if many is not None else 1
        memory = np.empty((self.components, size), dtype=self.element)
        row = 0
        for part, count in parts.values():
            with np.errstate(over="ignore"):  # beyond float is infinite, which the C refuses by name
                memory[row : row + count] = part.T if part.ndim == 2 else part[:, np.newaxis] if part.ndim else part
            row += count
        return States(self.stand.name, self.columns, memory, n is None and many is None)

    def _pose(
        self, position: ArrayLike | None, attitude: ArrayLike | None, angles: ArrayLike | None
    ) -> tuple[Array, Array]:
        """Position (), (3,) or (n, 3) and attitude (4,) or (n, 4), of what is given and what a hold says."""
        held = self.stand.hold is not None
        place = None if position is None else read(position, "position", 3, ("x", "y", "z"), "component")
        turn = self._attitudes(attitude, angles)
        if not held:
            return np.zeros(()) if place is None else place, turn
        if attitude is None and angles is None:
            turn = held_states.home_attitude(self.stand)
        if place is None:
            place = held_states.place_at(self.stand, turn)
        batch_size({"position": place, "attitude": turn})
        held_states.check_pose(self.stand, place * np.ones(3), turn)
        return place, turn

    def _twist(self, V: Given, u: Given | None) -> Array:
        """V (), (6,) or (n, 6), given or of u. Raises InputError, also for one that a hold does not allow."""
        hold = self.stand.hold
        if u is None:
            twist = read(V, "V", 6, TWIST_LETTERS, "component")
            if hold is not None and (reason := blocked_twist(hold, twist * np.ones(6))):
                raise InputError(reason)
            return twist
        if hold is None:
            raise InputError("u: the stand has no [hold], expected V")
        if not (isinstance(V, float) and V == 0.0):
            raise InputError("V, u: both given, expected one of them")
        count = len(hold.freedoms)
        twist = read(u, "u", count, freedom_names(hold), "freedom") * np.ones(count)
        return np.asarray(twist @ twists(hold).T)

    def _attitudes(self, attitude: ArrayLike | None, angles: ArrayLike | None) -> Array:
        """Unit quaternions, (4,) or (n, 4), of quaternions or angles. Raises InputError, RefusedError."""
        if attitude is not None and angles is not None:
            raise InputError("attitude, angles: both given, expected one of them")
        if angles is not None:
            triples = read(angles, "angles", 3, ("psi", "theta", "phi"), "angle")
            return self.quaternions(np.full(3, triples) if triples.ndim == 0 else triples)
        if attitude is None:
            return np.array([1.0, 0.0, 0.0, 0.0])
        attitudes = numbers(attitude, "attitude")
        if attitudes.ndim not in (1, 2) or attitudes.shape[-1] != 4:
            raise InputError(f"attitude: expected shape (4,) or (n, 4) (w, x, y, z), found {attitudes.shape}")
        length = np.linalg.norm(attitudes.astype(np.float64), axis=-1, keepdims=True)
        wrong = np.flatnonzero(~(np.abs(length - 1.0) <= UNIT_LENGTH))
        if wrong.size:
            where = f" of state {wrong[0]}" if attitudes.ndim == 2 else ""
            raise InputError(f"attitude{where}: length {length.flat[wrong[0]]:.9g}, expected 1 within {UNIT_LENGTH:g}")
        return np.where(np.abs(length - 1.0) <= ROUNDING, attitudes, attitudes / length)
