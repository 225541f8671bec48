"""States of a stand: one, or many with a batch axis, in the memory that the batch C reads; and how they are made."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, TypedDict, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mahovik.contract.evaluation import STATE
from mahovik.contract.quantities import UNIT_LENGTH
from mahovik.core.stand.hold import twists
from mahovik.core.stand.model import Stand, State
from mahovik.errors import InputError, UsageError
from mahovik.nearest import suggestion
from mahovik.out.api.inputs import Given, axes_of, batch_size, by_component, is_count, numbers, read
from mahovik.out.arguments import reading, text_of_keys
from mahovik.out.result import Axis, Column, Result
from mahovik.proof.verify.draw import blocked_twist, freedom_rates, home_attitude
from mahovik.proof.verify.states import ROUNDING
from mahovik.use.simulate.held import blocked_pose, place_at

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

    @property
    def flywheels(self) -> tuple[str, ...]:
        """Names of the flywheels."""
        return next((one.axes[0].labels for one in self._columns if one.name == "phi"), ())

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
    quaternion: ArrayLike | None
    angles: ArrayLike | None
    V: Given
    u: Given | None
    phi: Given
    phi_dot: Given


class StateMaker:
    """Makes states of a stand. `quaternions`: of angles (3, or n x 3) of its sequence; `columns` as in `States`."""

    def __init__(
        self, stand: Stand, columns: Sequence[Column], element: np.dtype[Any], quaternions: Callable[[Array], Array]
    ) -> None:
        self.stand, self.columns, self.element, self.quaternions = stand, columns, element, quaternions
        names = [f"{one.name} {label}" for one in columns for label in one.axes[0].labels]
        self.numbers, self.axes = Axis("number", tuple(names)), axes_of(stand)

    @property
    def components(self) -> int:
        """Numbers of a state."""
        return len(self.numbers.labels)

    def states(self, n: int | None, values: StateNumbers) -> States:
        """See `Model.states`."""
        for name in sorted(values.keys() - StateNumbers.__annotations__.keys()):
            known = StateNumbers.__annotations__
            hint = f", expected some of {', '.join(known)}" if name in STATE else suggestion(name, known)
            raise InputError(f"states: unknown {name}{hint}")
        if n is not None and not is_count(n):
            raise InputError(f"states: n: expected a number of states, found {n!r:.40}")
        turns = {name: values.get(name) for name in ("attitude", "quaternion", "angles")}
        place, turn = self._pose(values.get("position"), {k: turn for k, turn in turns.items() if turn is not None})
        parts = {"position": place, "attitude": turn, "V": self._twist(values.get("V", 0.0), values.get("u"))}
        for name, value in (("phi", values.get("phi", 0.0)), ("phi_dot", values.get("phi_dot", 0.0))):
            parts[name] = read(value, name, self.axes[name])
        many = batch_size(parts)
        if n is not None and many not in (None, n):
            raise InputError(f"states: n is {n}, but arrays of {many} states were given")
        size = n if n is not None else 1 if many is None else many
        with np.errstate(over="ignore"):  # beyond float is infinite, which the C refuses by name
            rows = [by_component(parts[x.name], x.values.shape[1], size, self.element) for x in self.columns]
        return States(self.stand.name, self.columns, np.concatenate(rows), n is None and many is None)

    def of_array(self, array: ArrayLike) -> States:
        """See `Model.states_of`."""
        states = read(array, "states", self.numbers)
        if states.ndim == 0:
            raise InputError(f"states: expected shape ({self.components},) or (n, {self.components}), found ()")
        with np.errstate(over="ignore"):
            memory = np.array(np.atleast_2d(states).T, self.element, order="C")
        return States(self.stand.name, self.columns, memory, states.ndim == 1)

    def _pose(self, position: ArrayLike | None, turns: Mapping[str, Any]) -> tuple[Array, Array]:
        """Position (), (3,) or (n, 3) and attitude (4,) or (n, 4), of what is given and what a hold says."""
        place = None if position is None else read(position, "position", self.axes["position"])
        turn = self._attitudes(turns)
        if self.stand.hold is None:
            return np.zeros(()) if place is None else place, turn
        if not turns:
            turn = np.array(home_attitude(self.stand))
        if place is None:
            place = place_at(self.stand, turn)
        batch_size({"position": place, "attitude": turn})
        if reason := blocked_pose(self.stand, place * np.ones(3), turn):
            raise InputError(reason)
        return place, turn

    def _twist(self, V: Given, u: Given | None) -> Array:
        """V (), (6,) or (n, 6), given or of u. Raises InputError, also for one that a hold does not allow."""
        hold = self.stand.hold
        if u is None:
            twist = read(V, "V", self.axes["V"])
            if hold is not None and (reason := blocked_twist(hold, twist * np.ones(6))):
                raise InputError(reason)
            return twist
        if hold is None:
            raise InputError("u: the stand has no [hold], expected V")
        if not (isinstance(V, float) and V == 0.0):
            raise InputError("V, u: both given, expected one of them")
        rates = read(u, "u", self.axes["u"]) * np.ones(len(hold.freedoms))
        return np.asarray(rates @ twists(hold).T)

    def _attitudes(self, turns: Mapping[str, Any]) -> Array:
        """Unit quaternions, (4,) or (n, 4), of quaternions or angles. Raises InputError, RefusedError."""
        if len(turns) > 1:
            raise InputError(f"{', '.join(turns)}: both given, expected one of them")
        if not turns:
            return np.array([1.0, 0.0, 0.0, 0.0])
        ((name, values),) = turns.items()
        if name == "angles":
            triples = read(values, "angles", self.axes["angles"])
            return self.quaternions(np.full(3, triples) if triples.ndim == 0 else triples)
        attitudes = numbers(values, name)
        if attitudes.ndim not in (1, 2) or attitudes.shape[-1] != 4:
            raise InputError(f"{name}: expected shape (4,) or (n, 4) (w, x, y, z), found {attitudes.shape}")
        length = np.linalg.norm(attitudes.astype(np.float64), axis=-1, keepdims=True)
        wrong = np.flatnonzero(~(np.abs(length - 1.0) <= UNIT_LENGTH))
        if wrong.size:
            where = f" of state {wrong[0]}" if attitudes.ndim == 2 else ""
            raise InputError(f"{name}{where}: length {length.flat[wrong[0]]:.9g}, expected 1 within {UNIT_LENGTH:g}")
        return np.where(np.abs(length - 1.0) <= ROUNDING, attitudes, attitudes / length)


def keys_of_state(state: States | Mapping[str, Any], stand: Stand) -> dict[str, Any]:
    """The keys of a state of `stand` as `eval` reads it, in plain data: as the arrays of a state, or what makes one.

    Raises InputError.
    """
    if not isinstance(state, States | Mapping):
        raise InputError(f"state: expected a mapping with its keys, found {type(state).__name__}")
    if isinstance(state, States):
        if state.batch is not None:
            raise InputError(f"state: {len(state)} states given, expected one, as states.take(0)")
        if state.flywheels != tuple(s.name for s in stand.flywheels):
            raise InputError(f"states of another stand: {state!r}, expected a state of {stand.name}")
    keys, hold = dict(state), stand.hold
    for name, axis in axes_of(stand).items():
        if name in keys:
            keys[name] = (read(keys[name], name, axis) * np.ones(len(axis.labels))).tolist()
    if "attitude" in keys:
        keys["quaternion"] = keys.pop("attitude")
    if hold is not None and "V" in keys and "u" not in keys:
        V = np.array(keys.pop("V"))
        if reason := blocked_twist(hold, V):
            raise InputError(reason)
        keys["u"] = freedom_rates(hold, V).tolist()
    return keys


def state_of(
    name: str, state: State | States | Mapping[str, Any] | str | Path, stand: Stand, keys: tuple[str, ...], hint: str
) -> State:
    """A state of an argument as `eval` reads it; `keys` are allowed. Raises UsageError; `hint` says why no others."""
    from mahovik.use.simulate.case import load_start, read_start

    if isinstance(state, State):
        return state
    if not isinstance(state, str | Path):
        return read_start(text_of_keys(keys_of_state(state, stand), schema=False), stand, keys, hint)
    if not Path(state).exists():
        raise UsageError(f"{name} {state}: no such file, expected one with a state")
    return reading("state", Path(state), load_start, stand, keys, hint)
