"""Motion in time of one state or many, of one stand or many variants of it, as labelled arrays."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from mahovik.contract.status import status_words
from mahovik.core.motion.regime import Regime, steady_regime
from mahovik.core.stand.model import Stand, rest_state
from mahovik.core.toolchain.compiled import Block
from mahovik.errors import InputError, RefusedError, UsageError
from mahovik.out.api.calls import Array, Calls, OnError, check_on_error
from mahovik.out.api.tables import Tables
from mahovik.out.arguments import regime_of, time
from mahovik.out.result import Axis, Column, Result
from mahovik.proof.verify.draw import blocked_twist
from mahovik.use.simulate.case import Case
from mahovik.use.simulate.course import NEEDS, motion, stand_for, together, why_refused

MOST = 1 << 28
"""Numbers of a motion, at most: 2 GB."""


def simulate(
    calls: Calls,
    until: float | str,
    regime: Regime | Mapping[str, Any] | str | Path | None,
    start: Any,
    dt: float | str,
    every: float | str,
    order: int,
    mounts: bool,
    tables: Tables | None,
    on_error: OnError,
) -> Result:
    """See `Model.simulate`."""
    check_on_error(on_error)
    end, step, between = time("until", until), time("dt", dt), time("every", every)
    x, n = _beginnings(calls, start, tables)
    speeds = x[13 + len(calls.flywheels) :]
    if regime is None and np.any(np.abs(speeds - speeds[:, :1]) > 0.0):
        raise InputError("start: the states have different speeds, expected a regime that gives them")
    steady = steady_regime(calls.stand, speeds[:, 0].tolist())
    chosen = steady if regime is None else regime_of(regime, calls.stand, end)
    stand = stand_for(calls.stand, chosen)
    if stand != calls.stand:  # the regime puts wrenches on bodies that take none
        other = Calls(stand, calls.real, calls.compiler, calls.threads)
        if tables is not None:
            tables = Tables(other.made, other.threads, tables.samples.changes, len(tables))
        x0 = x.T if n else x[:, 0]
        return simulate(other, end, chosen, x0, step, between, order, mounts, tables, on_error)
    case = Case(stand, chosen, _state_of(stand, x[:, 0]), end, between, step, order, calls.real)
    needs = NEEDS - {"I", "coordinates"} - (set() if mounts else {"loads"})
    _check_size(case, x.shape[1], len(calls.made.sensors))
    arrays, refused = dict[str, Array](), [""] * x.shape[1]
    for rows, block, parts in together(case, calls.made, x, tables):
        for name, array in _arrays(case, block, needs, parts).items():
            arrays.setdefault(name, np.empty((x.shape[1], *array.shape[1:]), array.dtype))[rows] = array
        words = [why_refused(stand, block, j) for j in range(block.n)]
        if on_error == "raise" and any(words):
            j = next(j for j, why in enumerate(words) if why)
            where = f"sample {rows[j]}: " if n else ""
            status, count = int(block.status[j]), sum(map(bool, words))
            raise RefusedError(f"{where}{words[j]}", "simulate", int(rows[j]), status, status_words(status), count)
        for number, why in zip(rows.tolist(), words, strict=True):
            refused[number] = why
    return _result(calls, case.times, arrays, refused, n)


def _result(calls: Calls, t: Array, arrays: Mapping[str, Array], refused: Sequence[str], n: int | None) -> Result:
    """Arrays over the time, of one state or of n samples."""
    fields = {one.name: one for columns in (*calls.columns.values(), calls.state) for one in columns}
    if sensed := fields.get("specific_force"):
        fields["rate"] = Column("rate", "rad/s", sensed.values, sensed.axes)
    bad = sum(map(bool, refused))
    messages = [f"{bad} of {len(refused)} samples refused, NaN from then on"] if bad else []
    meta: dict[str, Any] = {"stand": calls.stand.name, "refused": refused}
    title = f"{calls.stand.name}, {len(t)} moments"
    if n is None:
        index = Column("t", "s", t)
        columns = [fields[name]._replace(values=array[0]) for name, array in arrays.items()]
    else:
        index, time_axis = Column("sample", "", np.arange(n)), Axis("t", tuple(t.tolist()))
        title, meta = f"{title} of {n} samples", meta | {"t": t}
        columns = [
            fields[name]._replace(values=array, axes=(time_axis, *fields[name].axes)) for name, array in arrays.items()
        ]
    return Result(
        title, [index, *columns], index=index.name, meta=meta, messages=messages, ok=not bad, details=tuple(meta)
    )


def _beginnings(calls: Calls, start: Any, tables: Tables | None) -> tuple[Array, int | None]:
    """States at t = 0 (13 + 2 N, n or 1), and how many samples; None: a single one."""
    if start is None:
        from mahovik.use.study.rest import rest

        state = rest(calls.stand).state
        start = np.array([*state.position, *(state.quaternion or ()), *state.V, *state.phi, *state.phi_dot])
    if isinstance(start, str | Path):
        raise InputError(f"start: found the text {str(start)!r}, expected states, or the numbers of the file by name")
    states = calls.array(start).astype(calls.element)
    n = None if states.ndim == 1 else len(states)
    n = calls.check_tables(tables, n) if tables is not None else n
    x = np.broadcast_to(states.reshape(-1, states.shape[-1]), (n or 1, states.shape[-1]))
    if hold := calls.stand.hold:
        moves = tables and any(path.startswith("hold.") for path in tables.samples.changes)
        holds = [tables.stand(j).hold or hold for j in range(len(x))] if tables and moves else [hold]
        for one, V in zip(holds, np.split(x[:, 7:13], len(holds)), strict=True):
            if reason := blocked_twist(one, V):
                raise InputError(f"start: {reason}")
    return np.ascontiguousarray(x.T), n


def _state_of(stand: Stand, x: Array) -> Any:
    """The numbers of one state as plain data."""
    parts = np.split(x.astype(np.float64), [3, 7, 13, 13 + len(stand.flywheels)])
    names = ("position", "quaternion", "V", "phi", "phi_dot")
    numbers: dict[str, Any] = {name: tuple(part.tolist()) for name, part in zip(names, parts, strict=True)}
    return replace(rest_state(stand), **numbers)


def _check_size(case: Case, n: int, sensors: int) -> None:
    """UsageError: a motion that is too large to be kept whole."""
    width = 25 + 10 * len(case.stand.flywheels) + 24 * sensors
    if len(case.times) * n * width > MOST:
        raise UsageError(
            f"{len(case.times):,} moments of {n:,} samples are more than memory should hold; expected at most "
            f"{MOST / (n * width):,.0f} moments: a larger `every`, or fewer samples at once"
        )


def _arrays(case: Case, block: Block, needs: Collection[str], parts: int) -> dict[str, Array]:
    """The motion of a block by name, (n, T, ...)."""
    pieces = list(motion(case, block, needs, parts))
    T, N, n = len(case.times), len(case.stand.flywheels), block.n

    def whole(name: str) -> Array:
        joined = np.concatenate([getattr(piece, name) for piece in pieces])
        filled = np.full((T, *joined.shape[1:]), np.nan, joined.dtype)  # all samples may be refused before the end
        filled[: len(joined)] = joined
        return np.ascontiguousarray(filled.transpose(2, 0, 1))

    state, readings = whole("state"), whole("readings").reshape(n, T, -1, 24)
    arrays = {"position": state[..., :3], "attitude": state[..., 3:7], "V": state[..., 7:13], "V_dot": whole("V_dot")}
    arrays |= {"phi": whole("phi"), "phi_dot": state[..., 13 + N :]}
    arrays |= {name: whole(name) for name in ("phi_ddot", "tau", "reaction")}
    # of a sensor: position, C, twist, specific force, angular acceleration
    arrays |= {"specific_force": readings[..., 18:21], "rate": readings[..., 15:18]}
    arrays["mount_wrench"] = whole("loads").reshape(n, T, -1, 6)
    return {name: array for name, array in arrays.items() if array.shape[2]}
