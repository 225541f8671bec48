"""Making states: from numbers, from coordinates of the freedoms of a held carrier, from arrays."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from mahovik.core.stand.hold import freedom_names
from mahovik.core.stand.model import Stand
from mahovik.errors import InputError
from mahovik.out.api import held_states, inputs
from mahovik.out.api.call import Caller
from mahovik.out.api.fields import Array, Field
from mahovik.out.api.inputs import Given, attitudes, pack_states
from mahovik.out.api.states import States

_PLACE = ("x", "y", "z")


class MakesStates:
    """Part of a model that makes states of its stand."""

    _stand: Stand
    _call: Caller
    _element: np.dtype[Any]
    _state: tuple[Field, ...]
    _components: int
    _flywheels: tuple[str, ...]

    def state(
        self,
        *,
        position: ArrayLike | None = None,
        attitude: ArrayLike | None = None,
        angles: ArrayLike | None = None,
        V: Given = 0.0,
        u: Given | None = None,
        phi: Given = 0.0,
        phi_dot: Given = 0.0,
    ) -> States:
        """One state; see `states`."""
        x = self.states(None, position=position, attitude=attitude, angles=angles, V=V, u=u, phi=phi, phi_dot=phi_dot)
        if x.batch is not None:
            raise InputError(f"state: {x.batch} states given, expected one: use states")
        return x

    def states(
        self,
        n: int | None = None,
        *,
        position: ArrayLike | None = None,
        attitude: ArrayLike | None = None,
        angles: ArrayLike | None = None,
        V: Given = 0.0,
        u: Given | None = None,
        phi: Given = 0.0,
        phi_dot: Given = 0.0,
    ) -> States:
        """States: n of them, or as many as the arrays given have; one without batch axis where none has.

        position    m; of O1 in E0; left out, 0, or where a hold has O1 with this attitude
        attitude    quaternion, w first, of x0 = C x1; made unit where it is within 1e-3 of that
        angles      rad; of the sequence of the stand, instead of `attitude`; neither: aligned with E0, or the home pose
        V           m/s, rad/s; twist in E1 about O1
        u           m/s, rad/s; of a held carrier instead of `V`: the speeds of its freedoms
        phi         rad; phases
        phi_dot     rad/s; speeds

        Raises InputError, also for a pose and a V that the hold of the carrier does not allow.
        """
        count = len(self._flywheels)
        place, turn = self._pose(position, attitude, angles)
        parts = {
            "position": (place, 3),
            "attitude": (turn, 4),
            "V": (self._twist(V, u), 6),
            "phi": (inputs.read(phi, "phi", count, self._flywheels, "flywheel"), count),
            "phi_dot": (inputs.read(phi_dot, "phi_dot", count, self._flywheels, "flywheel"), count),
        }
        single = n is None and inputs.batch_size({name: part for name, (part, _) in parts.items()}) is None
        return States(self._stand.name, self._state, pack_states(parts, n, self._element), single)

    def state_from_coordinates(
        self,
        q: Given = 0.0,
        q_dot: Given = 0.0,
        *,
        orientation: ArrayLike | None = None,
        phi: Given = 0.0,
        phi_dot: Given = 0.0,
    ) -> States:
        """A state of a held carrier, or as many as the arrays have, by coordinates of its freedoms; of `generalized`.

        q             m, rad; one for each freedom, zero in the home pose; none of all three turns together
        q_dot         m/s, rad/s; one for each freedom
        orientation   of all three turns: the unit quaternion from the home pose, w first; left out: that pose
        phi, phi_dot  as in `states`

        Raises InputError.
        """
        names, hold = held_states.coordinate_names(self._stand), self._stand.hold
        assert hold is not None
        m, whole = len(hold.freedoms), len(self._flywheels)
        if not names and not (isinstance(q, float) and q == 0.0):
            raise InputError("q: the freedoms of this [hold] have no number of their own; expected orientation")
        if orientation is not None and len(names) == m:
            raise InputError(f"orientation: the freedoms of this [hold] have none; expected q of {', '.join(names)}")
        parts = {
            "q": (inputs.read(q, "q", len(names), names, "freedom") if names else np.zeros(()), len(names)),
            "orientation": (attitudes(orientation, None, self._quaternions), 4),
            "q_dot": (inputs.read(q_dot, "q_dot", m, freedom_names(hold), "freedom"), m),
            "phi": (inputs.read(phi, "phi", whole, self._flywheels, "flywheel"), whole),
            "phi_dot": (inputs.read(phi_dot, "phi_dot", whole, self._flywheels, "flywheel"), whole),
        }
        n = inputs.batch_size({name: part for name, (part, _) in parts.items()})
        coordinates = [inputs.by_component(*parts[k], n or 1, np.dtype(float)).T for k in ("q", "orientation", "q_dot")]
        place, turn, V = held_states.of_coordinates(self._stand, *coordinates)
        whole_parts = {"position": (place, 3), "attitude": (turn, 4), "V": (V, 6)}
        whole_parts |= {name: parts[name] for name in ("phi", "phi_dot")}
        memory = pack_states(whole_parts, None, self._element)
        return States(self._stand.name, self._state, memory, n is None)

    def states_of(self, array: ArrayLike) -> States:
        """States of an array of all their numbers, (n, 13 + 2 N) or (13 + 2 N,), as `States.array` has them: a copy.

        Quaternions are taken as they are: the C refuses those that are not unit within 1e-3. Raises InputError.
        """
        given = inputs.read(array, "states", self._components, (), "component")
        if given.ndim == 0:
            raise InputError(f"states: expected shape ({self._components},) or (n, {self._components}), found ()")
        parts = {"states": (given, self._components)}
        return States(self._stand.name, self._state, pack_states(parts, None, self._element), given.ndim == 1)

    def carry(self, n: int | None = None) -> Array:
        """A carry for `step` and `step_driven`, all zero: (n, 13 + 2 N), or (13 + 2 N,) of one state."""
        if n is not None and (isinstance(n, bool) or not isinstance(n, int) or n < 0):
            raise InputError(f"carry: expected a number of states from 0, found {n!r:.40}")
        return np.zeros(self._components if n is None else (n, self._components), self._element)

    def _pose(
        self, position: ArrayLike | None, attitude: ArrayLike | None, angles: ArrayLike | None
    ) -> tuple[Array, Array]:
        """Position (), (3,) or (n, 3) and attitude (4,) or (n, 4), of what is given and what a hold says."""
        held = self._stand.hold is not None
        place = None if position is None else inputs.read(position, "position", 3, _PLACE, "component")
        turn = attitudes(attitude, angles, self._quaternions)
        if held and attitude is None and angles is None:
            turn = held_states.home_attitude(self._stand)
        if not held:
            return np.zeros(()) if place is None else place, turn
        if place is None:
            place = held_states.place_at(self._stand, turn)
        inputs.batch_size({"position": place, "attitude": turn})
        held_states.check_pose(self._stand, place * np.ones(3), turn)
        return place, turn

    def _twist(self, V: Given, u: Given | None) -> Array:
        """V (), (6,) or (n, 6), given or of u."""
        hold = self._stand.hold
        if u is None:
            return inputs.read_twist(V, hold)
        if hold is None:
            raise InputError("u: the stand has no [hold], expected V")
        if not (isinstance(V, float) and V == 0.0):
            raise InputError("V, u: both given, expected one of them")
        found = inputs.read(u, "u", len(hold.freedoms), freedom_names(hold), "freedom")
        return held_states.twists_of(hold, found * np.ones(len(hold.freedoms)))

    def _quaternions(self, angles: Array) -> Array:
        n = len(angles) if angles.ndim == 2 else 1
        found, _ = self._call.run("quaternion", {"angles": angles}, n, "raise")
        return found["attitude"] if angles.ndim == 2 else found["attitude"][0]
