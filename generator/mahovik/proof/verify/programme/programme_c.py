"""The C of a programme, compiled and called: its tables by the literal reference, its clock by exact fractions."""

from __future__ import annotations

import json
import math
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np

from mahovik.core.motion.programme import Angles, Programme
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand
from mahovik.core.toolchain.library import Library
from mahovik.errors import UsageError
from mahovik.proof.reference.array import Array
from mahovik.proof.verify.programme.finding import Finding, check_limit, largest
from mahovik.proof.verify.programme.mechanics import Scale, instants
from mahovik.proof.verify.programme.phase_spread import spread_phases

POINTS = 400
"""Phases at which a table is compared."""

TORQUE = 10.0
"""Factor on the limit of the file for drive torques: their parts are larger than their sum."""

CLOCKS = ((400, 1), (7, 3), (1000, 7), (4001, 2000))
"""Ticks and periods that they take, of the clocks that are tried over two rounds each."""


@dataclass(frozen=True)
class CompiledProgramme:
    """The programme's C of a folder, loaded.

    real, limit   element type, and what its tables may add to the residual, as the folder's JSON file says
    """

    library: Library
    real: str
    limit: float

    def angles(self, part: str, phases: Array, count: int) -> tuple[Angles, Array | None, int]:
        """phi, phi', phi'' (M, count) at phases (M) in [0, 1) of "", "runup_" or "rundown_"; drive torques (M, count),
        None where the table has none; the least status.
        """
        call, ffi = self.library.function(f"{part}at"), self.library.ffi
        outputs = [ffi.new(f"{self.real}[]", max(count, 1)) for _ in ffi.typeof(call).args[1:]]
        rows, least = [], 0
        for phase in phases:
            least = min(least, int(call(float(phase), *outputs)))
            rows.append([[float(each[s]) for s in range(count)] for each in outputs])
        columns = np.array(rows, dtype=np.float64).reshape(len(phases), len(outputs), count)
        return (
            Angles(columns[:, 0], columns[:, 1], columns[:, 2]), columns[:, 3] if len(outputs) > 3 else None, least
        )  # fmt: skip

    def clock_errors(self, ticks: int, periods: int) -> int:
        """Ticks, of two rounds, at which phase or laps are not those of exact fractions."""
        ffi, lib = self.library.ffi, self.library
        start = lib.function("start")
        clock, phase = ffi.new(ffi.typeof(start).args[2]), ffi.new(f"{self.real} *")
        wrong = int(start(ticks, periods, clock) != 0)
        for tick in range(2 * ticks):
            wrong += int(lib.function("phase")(clock, phase) != 0)
            exact = Fraction(tick * periods, ticks)
            laps, part = divmod(exact, 1)
            late = part - Fraction(float(phase[0]))
            wrong += int(not 0 <= late < Fraction(1, 2**24 if self.real == "float" else 2**52) or clock.laps != laps)
            wrong += int(lib.function("advance")(clock) != 0)
        return wrong


def load_programme_c(stand: Stand, folder: Path, name: str, scratch: Path) -> CompiledProgramme:
    """Compiles `<stand>_<name>.c` of a folder in `scratch`.

    Raises UsageError: no such files, or of another stand; ToolchainError: no compiler, or it refuses the C.
    """
    called = f"{stand.name}_{name}"
    header, source, facts = (folder / f"{called}.{suffix}" for suffix in ("h", "c", "json"))
    own = folder / f"{stand.name}.h"
    for each in (header, source, facts, own):
        if not each.is_file():
            command = "generate" if each == own else "export programme"
            raise UsageError(f"{each}: not there; expected what `mahovik {command} -o {folder}` writes")
    said = _facts(facts)
    if said["physics"] != identities(stand).physics:
        raise UsageError(
            f"{facts}: its physics is {said['physics']}, expected {identities(stand).physics} of the stand "
            f"{stand.name}: export the programme again"
        )
    return CompiledProgramme(Library(header, source, scratch, stand.name, name), said["real"], said["limit"])


def _facts(path: Path) -> dict[str, Any]:
    """Physics, element type and limit in the manifest of a programme."""
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
        facts = {"physics": str(found["physics"]), "real": found["real"], "limit": float(found["limit"])}
    except (ValueError, KeyError, TypeError, RecursionError):
        facts = {"real": None, "limit": math.nan}
    if facts["real"] not in ("float", "double") or not 0.0 <= facts["limit"] < math.inf:
        raise UsageError(f"{path}: not as `mahovik export programme` writes it: export the programme again")
    return facts


def compiled_findings(
    stand: Stand, motion: RequiredMotion, programme: Programme, scale: Scale, residual: float, folder: Path, name: str
) -> list[Finding]:
    """Findings on the C of a folder: every function of the programme's header.

    residual   accepted of the programme itself, a share

    Raises UsageError, ToolchainError: see `load_programme_c`.
    """
    with tempfile.TemporaryDirectory(prefix="mahovik-") as scratch:
        made = load_programme_c(stand, folder, name, Path(scratch))
        found = _course_findings(programme.planned_for(stand), motion, programme, scale, residual, made)
        for part, table in (("runup", programme.runup), ("rundown", programme.rundown)):
            if table is not None:
                found.append(_table_finding(made, part, table.at, table.duration, len(stand.flywheels)))
        wrong = sum(made.clock_errors(ticks, periods) for ticks, periods in _clocks(programme))
    words = "ticks whose phase or laps are not the exact fraction, rounded down: start, phase, advance"
    return [*found, check_limit("C clock", wrong, 0, words)]


def _clocks(programme: Programme) -> tuple[tuple[int, int], ...]:
    """The clocks to try: one period each for a finite programme."""
    return CLOCKS if programme.periodic else tuple((ticks, 1) for ticks, _ in CLOCKS)


def _phases(real: str) -> Array:
    return np.asarray(spread_phases(POINTS).astype(np.float32 if real == "float" else np.float64), dtype=np.float64)


def _course_findings(
    stand: Stand, motion: RequiredMotion, programme: Programme, scale: Scale, residual: float, made: CompiledProgramme
) -> list[Finding]:
    """Findings on the table of the programme itself: angles, residual of (12), and drive torques where it has them."""
    phases = _phases(made.real)
    t = phases * programme.span
    angles, tau, status = made.angles("", phases, len(stand.flywheels))
    found = [_table_finding(made, "", programme.at, programme.span, len(stand.flywheels))]
    if status < 0:
        return found
    course = motion.at(t, programme.bias)
    shares = [scale.wrench_share(each.residual()) for each in instants(stand, course, angles)]
    i = int(np.argmax(shares))
    words = f"of (12) with the C's angles, at {POINTS} times; largest at t = {t[i]:.6g} s"
    found.append(check_limit("C residual", shares[i], residual + made.limit, words))
    if tau is not None:
        exact = np.array([each.torque() for each in instants(stand, course, programme.at(t))])
        peak = largest(exact) or 1.0
        words = f"drive torques, share of the largest, {peak:.3g} N m"
        found.append(check_limit("C torque", largest(tau - exact) / peak, TORQUE * made.limit, words))
    return found


def _table_finding(
    made: CompiledProgramme, part: str, at: Callable[[Array], Angles], span: float, count: int
) -> Finding:
    """The finding on angles and speeds of a table against those of the programme's file."""
    name = f"{part}_at" if part else "at"
    phases = _phases(made.real)
    if not made.library.has(name):
        return Finding(f"C {name}", np.inf, made.limit, False, "the C has no such function: export the programme again")
    angles, _, status = made.angles(f"{part}_" if part else "", phases, count)
    if status < 0:
        return Finding(f"C {name}", np.inf, made.limit, False, f"the C answers with status {status}")
    exact = at(phases * span)
    turned = angles.phi - exact.phi
    turned -= 2 * np.pi * np.round(turned / (2 * np.pi))
    speed = largest(exact.phi_dot) or 1.0
    value = max(largest(turned), largest(angles.phi_dot - exact.phi_dot) / speed)
    words = f"angles, rad, and speeds, share of the largest, at {POINTS} times, against the programme's file"
    return check_limit(f"C {name}", value, made.limit, words)
