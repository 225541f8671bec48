"""C of a folder beside the stand's own: compiled, called with NumPy data; and that of a programme judged."""

from __future__ import annotations

import json
import math
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from mahovik.core.motion.programme import Angles
from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand
from mahovik.core.toolchain.library import Library
from mahovik.errors import UsageError
from mahovik.proof.reference.array import Array
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.programme.mechanics import largest

if TYPE_CHECKING:
    from mahovik.proof.verify.programme.verification import ProgrammeCase


@dataclass(frozen=True)
class Part:
    """C of a programme or servo in a folder, loaded. `prefix`: what its names begin with; `limit`: of a programme,
    what its tables may add to the residual, as the folder's JSON file says.
    """

    library: Library
    prefix: str
    real: str
    limit: float

    def round(self, values: Any) -> Array:
        """The nearest numbers that the element type has."""
        with np.errstate(over="ignore"):
            return np.asarray(values, np.float32 if self.real == "float" else np.float64).astype(np.float64)

    def hold(self, function: str, *values: Any) -> list[Any]:
        """Values as arguments of a function of this C: arrays, structs as dicts, numbers, None for a null pointer."""
        kinds = self.library.ffi.typeof(self.library.function(function)).args
        return [self._held(kind, value) for kind, value in zip(kinds, values, strict=True)]

    def _held(self, kind: Any, value: Any) -> Any:
        ffi = self.library.ffi
        if isinstance(value, ffi.CData) or kind.kind == "primitive":
            return value
        if value is None:
            return ffi.NULL
        if kind.item.kind == "struct":
            return ffi.new(ffi.getctype(kind.item, "*"), {k: np.asarray(each).tolist() for k, each in value.items()})
        return ffi.new(ffi.getctype(kind.item, "[]"), np.asarray(value).tolist())

    def call(self, function: str, *values: Any) -> tuple[int, list[Any]]:
        """Status of a function of this C, and its arguments after the call."""
        held = self.hold(function, *values)
        return int(self.library.function(function)(*held)), [self.read(each) for each in held]

    def read(self, value: Any) -> Any:
        """Data of C as arrays, structs as dicts, numbers."""
        ffi = self.library.ffi
        if not isinstance(value, ffi.CData) or value == ffi.NULL:
            return value
        kind = ffi.typeof(value)
        if kind.kind == "pointer":
            return self.read(value[0])
        if kind.kind == "struct":
            return {name: self.read(getattr(value, name)) for name, _ in kind.fields}
        return np.array([self.read(each) for each in value])


def load_part(stand: Stand, folder: Path, kind: Literal["programme", "servo"], name: str, scratch: Path) -> Part:
    """Compiles the programme `name` of a folder, or its servo, in `scratch`.

    Raises UsageError: no such files, or of another stand; ToolchainError: no compiler, or it refuses the C.
    """
    programme = "" if (kind, name) == ("servo", "programme") else name
    prefix = f"{stand.name}_{programme}".rstrip("_")
    base = folder / (prefix if kind == "programme" else f"{prefix}_servo")
    header, source, manifest = (base.with_name(f"{base.name}.{suffix}") for suffix in ("h", "c", "json"))
    mechanics = folder / f"{stand.name}.h"
    for path in (header, source, manifest, mechanics):
        if not path.is_file():
            command = "generate" if path == mechanics else f"export {kind}"
            raise UsageError(f"{path}: not there; expected what `mahovik {command} -o {folder}` writes")
    try:
        found = json.loads(manifest.read_text(encoding="utf-8"))
        physics, real, limit = str(found["physics"]), found["real"], float(found.get("limit", 0.0))
        readable = real in ("float", "double") and 0.0 <= limit < math.inf and (kind == "servo" or "limit" in found)
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError):
        readable = False
    if not readable:
        raise UsageError(f"{manifest}: not as `mahovik export {kind}` writes it: export the {kind} again")
    if physics != identities(stand).physics:
        expected = f"expected {identities(stand).physics} of the stand {stand.name}"
        raise UsageError(f"{manifest}: its physics is {physics}, {expected}: export the {kind} again")
    return Part(Library(header, source, scratch, stand.name, programme), prefix, real, limit)


def spread_phases(count: int) -> Array:
    """Rising phases in [0, 1), spread by the golden ratio, so that they fall everywhere between nodes."""
    return np.sort((np.arange(1.0, count + 1.0) * (np.sqrt(5.0) - 1.0) / 2.0) % 1.0)


POINTS = 400
"""Phases at which a table is compared."""

TORQUE = 10.0
"""Factor on the limit of the file for drive torques: their parts are larger than their sum."""

CLOCKS = ((400, 1), (7, 3), (1000, 7), (4001, 2000))
"""Ticks and periods that they take, of the clocks that are tried over two rounds each; one period if it is finite."""


def compiled_checks(stand: Stand, case: ProgrammeCase, folder: Path, name: str) -> list[Check]:
    """Items of the C of a folder, which is that of a stand: every function of the programme's header.

    Raises UsageError, ToolchainError: see `load_part`.
    """
    programme = case.programme
    with tempfile.TemporaryDirectory(prefix="mahovik-") as scratch:
        made = load_part(stand, folder, "programme", name, Path(scratch))
        item, angles, tau = _table_check(made, "at", programme.at, programme.span)
        items = [item]
        if angles is not None:
            t = made.round(spread_phases(POINTS)) * programme.span
            shares = case.scale.wrench_share(case.equations(t, angles)[0])
            i = int(np.argmax(shares))
            words = f"of (12) with the C's angles, at {POINTS} times; largest at t = {t[i]:.6g} s"
            items.append(Check.of("C residual", shares[i], case.limit.residual + made.limit, words))
            if tau is not None:
                exact = case.equations(t)[1]
                peak = largest(exact) or 1.0
                words = f"drive torques, share of the largest, {peak:.3g} N m"
                items.append(Check.of("C torque", largest(tau - exact) / peak, TORQUE * made.limit, words))
        for part, table in (("runup", programme.runup), ("rundown", programme.rundown)):
            if table is not None:
                items.append(_table_check(made, f"{part}_at", table.at, table.duration)[0])
        clocks = CLOCKS if programme.periodic else [(ticks, 1) for ticks, _ in CLOCKS]
        wrong = sum(_clock_errors(made, ticks, periods) for ticks, periods in clocks)
    words = "ticks whose phase or laps are not the exact fraction, rounded down: start, phase, advance"
    return [*items, Check.of("C clock", wrong, 0, words)]


def _table_check(
    made: Part, function: str, at: Callable[[Array], Angles], span: float
) -> tuple[Check, Angles | None, Array | None]:
    """Angles and speeds of a table against those of the programme's file; angles and drive torques of the C.

    No angles where the C gives none, no torques (M, N) where the table has none.
    """
    phases = made.round(spread_phases(POINTS))
    exact, name = at(phases * span), f"C {function}"
    if not made.library.has(function):
        return Check.of(name, np.inf, made.limit, "the C has no such function: export the programme again"), None, None
    N = exact.phi.shape[1]
    outputs = [np.zeros(max(N, 1))] * (len(made.library.ffi.typeof(made.library.function(function)).args) - 1)
    answers = [made.call(function, float(phase), *outputs) for phase in phases]
    if (status := min(status for status, _ in answers)) < 0:
        return Check.of(name, np.inf, made.limit, f"the C answers with status {status}"), None, None
    columns = np.array([found[1:] for _, found in answers])[:, :, :N]
    angles = Angles(columns[:, 0], columns[:, 1], columns[:, 2])
    turned = angles.phi - exact.phi
    turned -= 2 * np.pi * np.round(turned / (2 * np.pi))
    speed = largest(exact.phi_dot) or 1.0
    value = max(largest(turned), largest(angles.phi_dot - exact.phi_dot) / speed)
    words = f"angles, rad, and speeds, share of the largest, at {POINTS} times, against the programme's file"
    return Check.of(name, value, made.limit, words), angles, columns[:, 3] if columns.shape[1] > 3 else None


def _clock_errors(made: Part, ticks: int, periods: int) -> int:
    """Ticks, of two rounds, at which phase or laps are not those of exact fractions."""
    start, clock_phase, advance = (made.library.function(name) for name in ("start", "phase", "advance"))
    ffi, unit = made.library.ffi, Fraction(1, 2**24 if made.real == "float" else 2**52)
    clock, phase = ffi.new(ffi.typeof(start).args[2]), ffi.new(ffi.typeof(clock_phase).args[1])
    wrong = int(start(ticks, periods, clock) != 0)
    for tick in range(2 * ticks):
        wrong += int(clock_phase(clock, phase) != 0)
        laps, part = divmod(Fraction(tick * periods, ticks), 1)
        wrong += int(not 0 <= part - Fraction(float(phase[0])) < unit or clock.laps != laps)
        wrong += int(advance(clock) != 0)
    return wrong
