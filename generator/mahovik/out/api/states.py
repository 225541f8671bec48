"""States of a stand: one, or many with a batch axis, in the memory that the batch C reads."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mahovik.errors import InputError
from mahovik.nearest import suggestion
from mahovik.out.api import inputs
from mahovik.out.api.fields import Field, Named, arrays

Real = NDArray[Any]
_WRITTEN = ("position", "attitude", "V", "phi", "phi_dot")


class States(Named):
    """States of one stand: `position`, `attitude`, `V`, `phi`, `phi_dot`, arrays of shape (n, k), or (k,) of one state.

    position  m; of O1 in E0
    attitude  unit quaternion, w first: x0 = C x1
    V         m/s, rad/s; twist of the carrier relative to E0, in E1 about O1
    phi       rad; phases of the flywheels
    phi_dot   rad/s; their speeds relative to the mount

    The arrays are views: writing into them writes the states. Made by `Model.state` and `Model.states`.
    """

    def __init__(self, stand: str, fields: Sequence[Field], memory: Real, single: bool) -> None:
        """`memory`: (components, n), contiguous. For users: `Model.states`."""
        super().__init__(fields, None if single else memory.shape[1])
        self._stand = stand
        self._memory = memory

    # -- arrays ------------------------------------------------------------------------------------------------------

    @property
    def array(self) -> Real:
        """All numbers of a state side by side, shape (n, 13 + 2 N): position, attitude, V, phi, phi_dot. A view."""
        return self._memory[:, 0] if self._batch is None else self._memory.T

    @property
    def position(self) -> Real:
        """m; of O1, in E0."""
        return self._array("position")

    @position.setter
    def position(self, value: ArrayLike) -> None:
        self["position"] = value

    @property
    def attitude(self) -> Real:
        """Unit quaternion, w first: x0 = C x1."""
        return self._array("attitude")

    @attitude.setter
    def attitude(self, value: ArrayLike) -> None:
        self["attitude"] = value

    @property
    def V(self) -> Real:
        """m/s, rad/s; twist of the carrier relative to E0, in E1 about O1."""
        return self._array("V")

    @V.setter
    def V(self, value: ArrayLike) -> None:
        self["V"] = value

    @property
    def phi(self) -> Real:
        """rad; phases of the flywheels."""
        return self._array("phi")

    @phi.setter
    def phi(self, value: ArrayLike) -> None:
        self["phi"] = value

    @property
    def phi_dot(self) -> Real:
        """rad/s; speeds of the flywheels relative to the mount."""
        return self._array("phi_dot")

    @phi_dot.setter
    def phi_dot(self, value: ArrayLike) -> None:
        self["phi_dot"] = value

    def __setattr__(self, name: str, value: Any) -> None:
        if not name.startswith("_") and name not in _WRITTEN:
            raise InputError(f"{name}: states have no such array{suggestion(name, _WRITTEN)}")
        super().__setattr__(name, value)

    def __setitem__(self, key: str | tuple[Any, ...], value: ArrayLike) -> None:
        """Writes an array, or the part of it that labels name: `x["phi_dot", "w1"] = 100.0`."""
        name, index = self._place(key)
        target = self._array(name)[index]
        given = inputs.numbers(value, name)
        try:
            self._array(name)[index] = given
        except ValueError:
            raise InputError(f"{name}: expected shape {target.shape}, found {given.shape}") from None

    def _array(self, name: str) -> Real:
        first = 0
        for f in self._fields.values():
            size = f.shape[0]
            if f.name == name:
                rows = self._memory[first : first + size]
                return rows[:, 0] if self._batch is None else rows.T
            first += size
        return np.zeros((0,) if self._batch is None else (self._batch, 0), self._memory.dtype)  # no flywheels

    # -- many --------------------------------------------------------------------------------------------------------

    def __len__(self) -> int:
        if self._batch is None:
            raise InputError("a single state has no length")
        return self._batch

    def take(self, which: int | slice | ArrayLike) -> States:
        """A copy of some of the states: of one by its number, of several by a slice, numbers or flags."""
        if self._batch is None:
            raise InputError("take: a single state, expected a batch")
        try:
            part = self._memory[:, cast(Any, which)]  # NumPy itself says what is no index
        except (IndexError, ValueError, TypeError) as error:
            raise InputError(f"take: {error}") from None
        if part.ndim > 2:
            raise InputError(f"take: expected a number, a slice or one list, found {which!r:.60}")
        single = part.ndim == 1
        memory = np.array(part[:, np.newaxis] if single else part, order="C")
        return States(self._stand, self.fields, memory, single)

    def copy(self) -> States:
        """States with memory of their own."""
        return States(self._stand, self.fields, self._memory.copy(), self._batch is None)

    # -- display -----------------------------------------------------------------------------------------------------

    def __repr__(self) -> str:
        of = "a state" if self._batch is None else f"{self._batch} states"
        return f"<States: {of} of {self._stand}; {', '.join(self._fields)}>"

    def _repr_html_(self) -> str:
        return arrays(repr(self), self)
