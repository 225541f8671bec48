"""Columns of a log of a held carrier: speeds and coordinates of its freedoms, and the reaction of the hold."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from mahovik.core.stand.hold import freedom_names, has_coordinates, numbered_freedoms, twists
from mahovik.core.stand.model import Hold, Stand
from mahovik.core.stand.state import State
from mahovik.core.stand.units import (
    ACCELERATION,
    ANGLE,
    ANGULAR_ACCELERATION,
    FORCE,
    LENGTH,
    PLAIN,
    SPEED,
    TORQUE,
    VELOCITY,
    Dimension,
)
from mahovik.errors import DataError
from mahovik.proof.verify.held import ALLOWED, at_coordinates, blocked_twist, freedom_rates, with_pose
from mahovik.proof.verify.states import read_request
from mahovik.use.measured.recording import Array

RATES: Mapping[str, tuple[Dimension, Dimension]] = {
    "slide": (VELOCITY, ACCELERATION),
    "turn": (SPEED, ANGULAR_ACCELERATION),
    "twist": (PLAIN, PLAIN),
}
"""Dimensions of u and u_dot of a kind of freedom."""

COORDINATES = ("q", "orientation")
"""Keys of the coordinates of freedoms."""


def groups_of(hold: Hold) -> Iterator[tuple[str, list[tuple[str, Dimension]]]]:
    """Columns, with their dimensions, of each key that a held carrier has besides those of a free one."""
    names, kinds = freedom_names(hold), [each.kind for each in hold.freedoms]
    if names:
        for k, key in enumerate(("u", "u_dot")):
            yield key, [(f"{key} {name}", RATES[kind][k]) for name, kind in zip(names, kinds, strict=True)]
    if has_coordinates(hold):
        own = numbered_freedoms(hold)
        if own:
            yield "q", [(f"q {names[k]}", LENGTH if kinds[k] == "slide" else ANGLE) for k in own]
        if len(own) < len(names):
            yield "orientation", [(f"orientation_{letter}", PLAIN) for letter in "wxyz"]
    yield "reaction", [(f"hold.reaction.{a}", FORCE if a in "xyz" else TORQUE) for a in "xyzkmn"]


class HeldColumns:
    """Motion and pose of a held carrier by the columns of its log. `values`: groups by key, in place."""

    def __init__(self, stand: Stand, hold: Hold, path: Path, values: dict[str, Array]) -> None:
        self._stand, self._hold, self._path, self._values = stand, hold, path, values
        if self._is_posed():
            for key in COORDINATES:
                values.pop(key, None)

    @property
    def clamped(self) -> bool:
        """Whether the carrier has no freedom."""
        return not self._hold.freedoms

    @property
    def has_coordinates(self) -> bool:
        """Whether the pose is that of the columns of coordinates."""
        expected = {key for key, _ in groups_of(self._hold) if key in COORDINATES}
        return bool(expected) and expected <= self._values.keys()

    def add_twists(self, rows: int) -> None:
        """V and V_dot (rows, 6) by u and u_dot where they are not there; zeros of a clamped carrier.

        Raises DataError: V is none that the hold allows, or not that of the u beside it.
        """
        S, values = twists(self._hold), self._values
        for key, rate in (("V", "u"), ("V_dot", "u_dot")):
            if self.clamped:
                values.setdefault(key, np.zeros((rows, 6)))
            elif rate in values:
                values.setdefault(key, values[rate] @ S.T)
        for k, V in enumerate(values.get("V", ())):
            if np.isfinite(V).all() and (reason := blocked_twist(self._hold, V)):
                raise DataError([f"{self._path}: row {k + 1}: {reason}"])
            off = np.abs(V - S @ values["u"][k]).max() if "u" in values else 0.0
            if off > ALLOWED * max(1.0, np.abs(V).max()):
                raise DataError([f"{self._path}: row {k + 1}: V is not S u of the u beside it, off by {off:.3g}"])

    def add_rates(self) -> None:
        """u and u_dot (rows, m) of V and V_dot, where they are not there."""
        for key, rate in (("V", "u"), ("V_dot", "u_dot")):
            if key in self._values:
                self._values.setdefault(rate, freedom_rates(self._hold, self._values[key]))

    def state(self, given: Mapping[str, Any]) -> State:
        """The state of a row: in the pose of its coordinates, or else of position and attitude, of which the hold
        gives what is missing. Raises StateError.
        """
        keys = {key: given[key] for key in given if key not in (*COORDINATES, "V", "V_dot")}
        state = read_request(self._stand, {**keys, "want": ["forward"]}).state
        if self.has_coordinates:
            turned = np.array(given["orientation"]) if "orientation" in given else None
            return at_coordinates(self._stand, state, np.array(given.get("q", ())), turned)
        return with_pose(self._stand, state, keys)

    def _is_posed(self) -> bool:
        """Whether position and attitude are there, as far as the freedoms change them."""
        kinds = {each.kind for each in self._hold.freedoms}
        attitude = "turn" not in kinds or bool({"quaternion", "angles"} & self._values.keys())
        return attitude and ("slide" not in kinds or "position" in self._values)
