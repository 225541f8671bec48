"""Motion in time of one state or many, of one stand or many variants of it, as labelled arrays."""

from __future__ import annotations

import json
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, field, replace
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from mahovik.core.motion.regime import Regime, load, loads_regime, steady_regime
from mahovik.core.stand.model import TWIST_LETTERS, WRENCH_LETTERS, Stand
from mahovik.core.stand.state import rest_state
from mahovik.core.toolchain.block import Block
from mahovik.errors import InputError, RefusedError, UsageError
from mahovik.out.api import inputs
from mahovik.out.api.call import OnError
from mahovik.out.api.core import Built
from mahovik.out.api.fields import Array
from mahovik.out.api.states import States
from mahovik.out.api.tables import Tables
from mahovik.use.simulate.case import Case
from mahovik.use.simulate.course import NEEDS, motion, parts_of, stand_for, why_refused

MOST = 1 << 28
"""Numbers of a motion, at most: 2 GB."""

SIZE = 256
"""Samples that are stepped together: their tables and states stay in the cache of the processor."""

AXES, QUATERNION = ("x", "y", "z"), ("w", "x", "y", "z")


@dataclass(frozen=True, eq=False)
class Motion(Mapping[str, Array]):
    """Arrays by name, (T, ...), of many samples (n, T, ...): `motion["phi_dot"]`. SI.

    t              (T); position (3) and attitude (4, quaternion, w first) of the carrier in E0; V, V_dot (6) in E1
    phi, phi_dot, phi_ddot, tau   (N): angles, not wrapped; speeds, accelerations, whole drive torques
    specific_force, rate          (sensors, 3): what accelerometers and gyros of instruments and points read
    mount_wrench   (N, 6): of the mounts on the flywheels, if asked for
    reaction       (6): of the hold on the carrier, in E1 about O1, of a held one
    refused        of each sample why the C refused it, or "": its numbers from then on are NaN
    """

    stand: Stand
    arrays: Mapping[str, Array]
    refused: tuple[str, ...] = ()
    single: bool = field(default=True, repr=False)

    def __getitem__(self, name: str) -> Array:
        return self.arrays[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self.arrays)

    def __len__(self) -> int:
        return len(self.arrays)

    def to_xarray(self) -> Any:
        """An xarray.Dataset with the dimensions `sample` (of many), `t`, `flywheel`, `sensor` and those of vectors.

        Raises UsageError: xarray is not there.
        """
        try:
            xarray = import_module("xarray")
        except ImportError:
            raise UsageError('to_xarray needs xarray: pip install "mahovik[frames]"') from None
        stand = self.stand
        names = {
            "flywheel": [s.name for s in stand.flywheels],
            "sensor": [*(p.name for p in stand.instruments), *(p.name for p in stand.points)],
            "axis": list(AXES), "quaternion": list(QUATERNION), "twist": list(TWIST_LETTERS),
            "wrench": list(WRENCH_LETTERS),
        }  # fmt: skip
        first = ("t",) if self.single else ("sample", "t")
        found = {
            name: (("t",) if name == "t" else (*first, *dims), self[name], {"units": unit})
            for name, (dims, unit) in FIELDS.items()
            if name in self
        }
        used = {dim for dims, _, _ in found.values() for dim in dims}
        coordinates = {dim: labels for dim, labels in names.items() if dim in used}
        return xarray.Dataset(found, coordinates, {"stand": stand.name})


FIELDS: Mapping[str, tuple[tuple[str, ...], str]] = {
    "t": ((), "s"),
    "position": (("axis",), "m"),
    "attitude": (("quaternion",), ""),
    "V": (("twist",), "m/s, rad/s"),
    "V_dot": (("twist",), "m/s2, rad/s2"),
    "phi": (("flywheel",), "rad"),
    "phi_dot": (("flywheel",), "rad/s"),
    "phi_ddot": (("flywheel",), "rad/s2"),
    "tau": (("flywheel",), "N m"),
    "reaction": (("wrench",), "N, N m"),
    "specific_force": (("sensor", "axis"), "m/s2"),
    "rate": (("sensor", "axis"), "rad/s"),
    "mount_wrench": (("flywheel", "wrench"), "N, N m"),
}
"""Dimensions of the arrays of a motion after the time, and units."""


class WithSimulation(Built):
    """Part of a model that steps states through time."""

    def simulate(
        self,
        until: float | str,
        *,
        regime: Regime | Mapping[str, Any] | str | Path | None = None,
        start: States | ArrayLike | None = None,
        dt: float | str = 1e-4,
        every: float | str = 1e-3,
        order: int = 4,
        mounts: bool = False,
        tables: Tables | None = None,
        on_error: OnError = "raise",
    ) -> Motion:
        """The motion until a time (s, or a text with a unit), of all states and stands at once, in C.

        regime    speeds or torques of the flywheels, wrenches: a file, its keys, or a Regime; the same for all samples.
                  None: the flywheels keep the speeds of `start`
        start     one state for all samples, or one for each; None: the static equilibrium of the model's stand
        dt        the longest step; every: time between moments of output, the last of which is `until`
        order     of the step: 4 or 2
        mounts    also the wrench of the mount on each flywheel
        tables    of `model.tables`: sample j is of stand j. One sample does not depend on which others there are
        on_error  "raise": a state that the C refuses raises RefusedError; "nan": its numbers are NaN from then on

        Campaigns and other loops that keep little of each moment take pieces from `course.motion` instead.
        Raises InputError, UsageError, RegimeError, CheckError (no equilibrium to begin from), RefusedError.
        """
        end, dt, every = (
            inputs.time(value, name) if isinstance(value, str) else value
            for name, value in (("until", until), ("dt", dt), ("every", every))
        )
        x, n = self._beginnings(start, tables)
        speeds = x[13 + len(self._flywheels) :]
        if regime is None and np.any(speeds != speeds[:, :1]):
            raise InputError("start: the states have different speeds, expected a regime that gives them")
        chosen = steady_regime(self._stand, speeds[:, 0].tolist()) if regime is None else self._regime(regime, end)
        stand = stand_for(self._stand, chosen)
        if stand != self._stand:  # the regime puts wrenches on bodies that take none
            model = type(self)(stand, self._real, *self._given)
            other = None if tables is None else model.tables(dict(tables.samples.given), len(tables))
            return model.simulate(
                end, regime=chosen, start=x if n else x[:, 0], dt=dt, every=every, order=order, mounts=mounts,
                tables=other, on_error=on_error,
            )  # fmt: skip
        case = Case(stand, chosen, self._state_of(x[:, 0]), end, every, dt, order, self._real)
        needs = NEEDS - {"I", "coordinates"} - (set() if mounts else {"loads"})
        own = Block(stand, self._made, 1)
        own.x[:] = x[:, :1]
        parts = parts_of(case, own)
        self._check_size(case, x.shape[1], needs)
        pieces, refused = [], list[str]()
        for first in range(0, x.shape[1], SIZE):
            columns = x[:, first : first + SIZE]
            block = Block(stand, self._made, columns.shape[1], None if tables is None else tables.block, first)
            block.x[:] = columns
            pieces.append(_arrays(case, block, needs, parts))
            words = [why_refused(stand, block, j) for j in range(block.n)]
            if on_error == "raise" and any(words):
                j = next(j for j, why in enumerate(words) if why)
                where = f"sample {first + j}: " if n else ""
                status = int(block.status[j])
                raise RefusedError(f"{where}{words[j]}", "simulate", first + j, status, "", sum(map(bool, words)))
            refused += words
        arrays = {name: np.concatenate([piece[name] for piece in pieces]) for name in pieces[0]}
        if not n:
            arrays = {name: array[0] for name, array in arrays.items()}
        return Motion(stand, {"t": case.times, **arrays}, tuple(refused), not n)

    def _beginnings(self, start: Any, tables: Tables | None) -> tuple[Array, int | None]:
        """States at t = 0 (13 + 2 N, n or 1), and how many samples; None: a single one."""
        if start is None:
            from mahovik.use.study.rest import rest

            found = rest(self._stand).state
            start = np.array([*found.position, *(found.quaternion or ()), *found.V, *found.phi, *found.phi_dot])
        given = self._array(start).astype(self._element)
        n = None if given.ndim == 1 else len(given)
        n = self._check_tables(tables, n) if tables is not None else n
        x = np.broadcast_to(given.reshape(-1, given.shape[-1]), (n or 1, given.shape[-1]))
        return np.ascontiguousarray(x.T), n

    def _regime(self, regime: Regime | Mapping[str, Any] | str | Path, until: float) -> Regime:
        if isinstance(regime, Mapping):
            return loads_regime(json.dumps({"schema": 1, **regime}), self._stand, until, is_json=True)
        return regime if isinstance(regime, Regime) else load(regime, self._stand, until)

    def _state_of(self, x: Array) -> Any:
        """The numbers of one state as plain data."""
        parts = np.split(x.astype(np.float64), [3, 7, 13, 13 + len(self._flywheels)])
        names = ("position", "quaternion", "V", "phi", "phi_dot")
        numbers: dict[str, Any] = {name: tuple(part.tolist()) for name, part in zip(names, parts, strict=True)}
        return replace(rest_state(self._stand), **numbers)

    def _check_size(self, case: Case, n: int, needs: Collection[str]) -> None:
        """UsageError: a motion that is too large to be kept whole."""
        width = 25 + 10 * len(self._flywheels) + 24 * len(self._made.sensors)
        if len(case.times) * n * width > MOST:
            most = MOST / (n * width)
            raise UsageError(
                f"{len(case.times):,} moments of {n:,} samples are more than memory should hold; expected at most "
                f"{most:,.0f} moments: a larger `every`, or fewer samples at once"
            )


def _arrays(case: Case, block: Block, needs: Collection[str], parts: int) -> dict[str, Array]:
    """The motion of a block by name, (n, T, ...)."""
    pieces = list(motion(case, block, needs, parts))
    T, N, n = len(case.times), len(case.stand.flywheels), block.n

    def whole(name: str) -> Array:
        found = np.concatenate([getattr(piece, name) for piece in pieces])
        filled = np.full((T, *found.shape[1:]), np.nan, found.dtype)  # all samples may be refused before the end
        filled[: len(found)] = found
        return np.ascontiguousarray(filled.transpose(2, 0, 1))

    state, readings = whole("state"), whole("readings").reshape(n, T, -1, 24)
    arrays = {"position": state[..., :3], "attitude": state[..., 3:7], "V": state[..., 7:13], "V_dot": whole("V_dot")}
    arrays |= {"phi": whole("phi"), "phi_dot": state[..., 13 + N :]}
    arrays |= {name: whole(name) for name in ("phi_ddot", "tau", "reaction")}
    # of a sensor: position, C, twist, specific force, angular acceleration
    arrays |= {"specific_force": readings[..., 18:21], "rate": readings[..., 15:18]}
    arrays["mount_wrench"] = whole("loads").reshape(n, T, -1, 6)
    return {name: array for name, array in arrays.items() if array.shape[2]}
