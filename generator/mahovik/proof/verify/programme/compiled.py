"""C of a programme or servos in a folder, beside the stand's own: compiled, called with NumPy data, judged.

Functions of servos by their laws; tables of a programme by its file and (12), its clock by exact fractions.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path as FilePath
from typing import Any, Literal

import numpy as np

from mahovik.contract.limits import LIMITS, OF_TABLE, Limits
from mahovik.contract.status import status_words
from mahovik.core.motion.functions import Angles
from mahovik.core.stand.model import Stand
from mahovik.core.stand.structure import identities
from mahovik.core.toolchain.library import Library
from mahovik.errors import MahovikError, StateError, UsageError
from mahovik.proof.reference.algebra import Array, Values
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.compare import Rows
from mahovik.proof.verify.files import Generate
from mahovik.proof.verify.programme.mechanics import largest
from mahovik.proof.verify.programme.verification import TORQUES_ERROR, ProgrammeCase
from mahovik.proof.verify.refusals import NOTHING, NULL, Numbers, WrongValue, demand_refusals, wrong_within

UNCHECKED = frozenset(("gains", "design", "invalid", "sum", "wanted", "present"))
"""Arguments and members that no function checks: a program has them in its text, or made them itself."""


@dataclass(frozen=True)
class Part:
    """C of a programme or servo in a folder, loaded; of a programme what the folder's JSON file says.

    tables   kind, number of rows and measured errors of each table, by its part
    written  files that this version writes in its place, whose errors these are; none where it cannot
    """

    library: Library
    real: str
    tables: Mapping[str, Mapping[str, Any]]
    written: Mapping[str, str]

    @property
    def limit(self) -> float:
        """What its tables may add to the residual."""
        return OF_TABLE[self.real]

    @property
    def numbers(self) -> np.finfo[Any]:
        """Facts of the element type."""
        return np.finfo(np.float32 if self.real == "float" else np.float64)

    def round(self, values: Any) -> Any:
        """The nearest numbers that the element type has, of mappings in each member; whole numbers stay."""
        if isinstance(values, Mapping):
            return {name: self.round(value) for name, value in values.items()}
        if np.asarray(values).dtype.kind != "f":
            return values
        with np.errstate(over="ignore"):
            return np.asarray(values, self.numbers.dtype).astype(np.float64)

    def functions(self, needed: Iterable[str]) -> list[str]:
        """Public functions of the header, after those that are needed."""
        return [*dict.fromkeys((*needed, *self.library.functions()))]

    def call(self, function: str, inputs: Mapping[str, Any]) -> tuple[int, dict[str, Any]]:
        """Status of a function, and all its arguments after the call, members of a state by their own names.

        `inputs`: all arguments in their order: arrays, structs as mappings, numbers, None for a null pointer. Raises
        StateError where the C lacks the function.
        """
        held = self.library.hold(function, inputs)
        status = int(self.library.function(function)(*held.values()))
        result = {name: self.library.read(memory) for name, memory in held.items()}
        return status, result | result.pop("state", {})


def load_part(
    stand: Stand, folder: FilePath, kind: Literal["programme", "servo"], name: str, generate: Generate | None = None
) -> Part:
    """Compiles the programme `name` of a folder, or its servo.

    Raises UsageError: no such files, or of another stand; ToolchainError: no compiler, or it refuses the C.
    """
    programme = "" if (kind, name) == ("servo", "programme") else name
    prefix = f"{stand.name}_{programme}".rstrip("_")
    base = folder / (prefix if kind == "programme" else f"{prefix}_servo")
    header, source, manifest = (base.with_name(f"{base.name}.{suffix}") for suffix in ("h", "c", "json"))
    mechanics = folder / f"{stand.name}.h"
    for path in (header, source, manifest, mechanics):
        if not path.is_file():
            command = "generate" if path == mechanics else f"generate --{kind}"
            raise UsageError(f"{path}: not there; expected what `mahovik {command} -o {folder}` writes")
    try:
        document = json.loads(manifest.read_text(encoding="utf-8"))
        physics, readable = str(document["physics"]), document["real"] in OF_TABLE
        tables = _tables(document)
        readable = readable and (kind == "servo" or tables["programme"]["kind"] in ("quintic", "fourier"))
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError):
        readable = False
    if not readable:
        raise UsageError(f"{manifest}: not as `mahovik generate --{kind}` writes it: write the {kind} again")
    if physics != identities(stand).physics:
        expected = f"expected {identities(stand).physics} of the stand {stand.name}"
        raise UsageError(f"{manifest}: its physics is {physics}, {expected}: generate the {kind} again")
    library, written = Library(source, stand.name, programme), dict[str, str]()
    real = "float" if library.ffi.sizeof(f"{stand.name}_real") == 4 else "double"
    if generate is not None:
        with suppress(MahovikError):  # it cannot be generated any more
            written |= generate(real, tables["programme"]["kind"], "tau" in tables["programme"])
            tables = _tables(json.loads(written[manifest.name]))
    return Part(library, real, tables, written)


def _tables(document: Mapping[str, Any]) -> dict[str, dict[str, Any]]:
    """Kind, rows and errors of the tables of a manifest, by their parts."""
    listed = document.get("tables", ())
    return {table["part"]: {"kind": table["kind"], "rows": int(table["rows"]), **table["errors"]} for table in listed}


def judge_law(
    part: Part, rows: Rows, drawn: Iterable[Mapping[str, Any]], law: Callable[..., Values], beyond: Numbers = NOTHING
) -> None:
    """What a function writes against its law, from drawn inputs, a check for each quantity; and what it must refuse.

    `beyond`: values just out of range besides.
    """
    samples = list(drawn)
    for number, inputs in enumerate(samples):
        status, results = part.call(rows.function, inputs)
        rows.compare(f"sample {number}", inputs, law, {**results, "status": status_words(status)})
    good = {"state": {}} if rows.function.endswith("_reset") else samples[0]  # a reset reads nothing
    judge_refusals(part, rows, good, beyond)


def judge_refusals(part: Part, rows: Rows, good: Mapping[str, Any], beyond: Numbers = NOTHING) -> None:
    """Bad inputs of a function are refused, one wrong value at a time, with all results untouched.

    `good`: all arguments in their order, NaN what is only written; `beyond`: values just out of range besides.
    """
    pointers = [name for name, value in good.items() if isinstance(value, Mapping) or np.ndim(value)]
    wrong = [WrongValue((name,), NULL, "BAD_ARGUMENT") for name in pointers]
    for name, value in good.items():
        wrong += wrong_within(value, (name,), part.real, UNCHECKED, beyond)

    def call(name: str, inputs: Mapping[str, Any]) -> tuple[int, bool]:
        arguments = {key: None if value is NULL else value for key, value in inputs.items()}
        return part.library.probe(name, part.library.hold(name, arguments))

    demand_refusals(rows.check("bad inputs refused", "exact"), rows.function, good, wrong, call)


# Functions of programmes.


def spread_phases(count: int) -> Array:
    """Rising phases in [0, 1), spread by the golden ratio, so that they fall everywhere between nodes."""
    return np.sort((np.arange(1.0, count + 1.0) * (np.sqrt(5.0) - 1.0) / 2.0) % 1.0)


def deviations_of(angles: Angles, exact: Angles) -> tuple[float, float, float, float]:
    """Largest errors of phi, phi', phi'' (M, N each), and together: of phi'' + phi'^2, the force of an unbalance, with
    the angle's error turning this force; relative to its largest value.
    """
    turned, speed, acceleration = (ours - theirs for ours, theirs in zip(angles, exact, strict=True))
    turned -= 2 * np.pi * np.round(turned / (2 * np.pi))
    force = np.hypot(exact.phi_ddot, exact.phi_dot**2)
    wrong = np.abs(acceleration) + 2 * np.abs(exact.phi_dot * speed) + force * np.abs(turned)
    relative = largest(wrong) / max(largest(force), np.finfo(np.float64).tiny)
    return largest(turned), largest(speed), largest(acceleration), relative


PHASES = 400
"""Least number of phases at which a table is compared; two for each of its rows."""

MEASURED = 8.0
"""Factor on the errors that were measured when the table was made, for other times and rounding."""

TABLES = ("at", "runup_at", "rundown_at")
"""Functions that give angles of the flywheels by the time."""

CLOCK = {"surplus": 6, "rest": 6, "ticks": 7, "laps": 0}
CLOCK_FUNCTIONS: dict[str, tuple[dict[str, Any], Numbers]] = {
    "start": ({"ticks": 401, "periods": 200, "clock": {}}, {"periods": (201,)}),
    "advance": ({"clock": CLOCK}, {"surplus": (-1, 7), "rest": (-1, 7), "laps": (-1,)}),
    "phase": ({"clock": {}, "phase": np.full(1, np.nan)}, NOTHING),
}
"""Good arguments of the functions of the clock, at their bounds, and values just out of range."""

CLOCKS = ((400, 1), (7, 3), (1000, 7), (4001, 2000))
"""Ticks and periods that they take, of the clocks that are tried over two rounds each; one period if it is finite."""


@dataclass(frozen=True, eq=False)
class CompiledProgramme:
    """A programme and its C: where the judges of its functions start."""

    case: ProgrammeCase
    made: Part
    states: int = PHASES

    @property
    def limits(self) -> Limits:
        """Accepted differences of the element type of the C."""
        return LIMITS[self.made.real]

    @property
    def tables(self) -> dict[str, tuple[Callable[[Array], Angles], float]]:
        """phi, phi', phi'' by time, and the duration (s), by the function that gives them."""
        programme = self.case.programme
        ways = {"runup_at": programme.runup, "rundown_at": programme.rundown}
        result = {function: (table.at, table.duration) for function, table in ways.items() if table is not None}
        return {"at": (programme.at, programme.span), **result}

    @property
    def public(self) -> list[str]:
        """Functions that the C must have, and those that it has."""
        return self.made.functions((*self.tables, *CLOCK_FUNCTIONS))

    def inputs(self, function: str, phase: float = 0.25) -> dict[str, Any]:
        """Arguments of the function of a table; of four outputs the last are drive torques."""
        if function not in self.tables or not self.made.library.has(function):
            raise StateError(f"{function} is in one of programme and C alone: generate it again")
        count = len(self.made.library.ffi.typeof(self.made.library.function(function)).args) - 1
        none = np.full(len(self.case.stand.flywheels), np.nan)
        return {"phase": phase} | dict.fromkeys(("phi", "phi_dot", "phi_ddot", "tau")[:count], none)


def judge_table(compiled: CompiledProgramme, rows: Rows) -> None:
    """Angles and drive torques of a table against the programme's file; of the programme the residual."""
    case, made, function = compiled.case, compiled.made, rows.function
    table = "programme" if function == "at" else function.removesuffix("_at")
    measured = made.tables.get(table, made.tables["programme"])
    is_cyclic = function == "at" and case.programme.periodic
    judge_refusals(made, rows, compiled.inputs(function), {"phase": (1.0,)} if is_cyclic else NOTHING)
    (at, span), last = compiled.tables[function], 1.0 - made.numbers.epsneg if is_cyclic else 1.0
    phases = np.array([0.0, *made.round(spread_phases(max(PHASES, 2 * measured["rows"]) - 2)), last])
    t, exact = phases * span, at(phases * span)
    answers = [made.call(function, compiled.inputs(function, phase)) for phase in phases]
    if (status := min(status for status, _ in answers)) < 0:
        rows.add(Check.of(function, np.inf, made.limit, f"the C answers with status {status}"))
        return
    columns = {name: np.array([answer[name] for _, answer in answers]) for name in answers[0][1]}
    angles = Angles(columns["phi"], columns["phi_dot"], columns["phi_ddot"])
    speed, way = largest(exact.phi_dot) or 1.0, "" if function == "at" else f"{function} "
    phi, phi_dot, _, together = deviations_of(angles, exact)

    def compare(name: str, value: float, error: float, words: str, most: float = np.inf) -> None:
        rows.add(Check.of(name, value, min(most, MEASURED * max(error, float(made.numbers.eps))), words))

    words = f"angles, rad, and speeds, share of the largest, at {len(t)} times, against the programme's file"
    error = max(measured["phi"], measured["phi_dot"] / speed)
    compare(function, max(phi, phi_dot / speed), error, words, made.limit)
    words = "accelerations of the flywheels, share of the largest, with that of their speeds"
    compare(f"{way}acceleration", together, measured["relative"], words)
    if function == "at":
        shares = case.scale.wrench_share(case.equations(t, angles)[0])
        i = int(np.argmax(shares))
        words = f"of (12) with the C's angles, at {len(t)} times; largest at t = {t[i]:.6g} s"
        rows.add(Check.of("residual", shares[i], case.limit.residual + made.limit, words))
    if "tau" in columns:
        tau = case.torques("" if function == "at" else table, t)
        peak = largest(tau) or 1.0
        error = max(measured.get("tau", 0.0) / peak, TORQUES_ERROR if way else 0.0)
        words = f"drive torques, share of the largest, {peak:.3g} N m"
        compare(f"{way}torque", largest(columns["tau"] - tau) / peak, error, words, np.inf if way else made.limit)


def judge_clock(compiled: CompiledProgramme, rows: Rows) -> None:
    """Phase and laps of clocks, which all three functions make together: with the first of them."""
    made, periodic = compiled.made, compiled.case.programme.periodic
    judge_refusals(made, rows, *CLOCK_FUNCTIONS[rows.function])
    if rows.function == "start" and all(map(made.library.has, CLOCK_FUNCTIONS)):
        wrong = sum(_clock_errors(made, ticks, periods if periodic else 1) for ticks, periods in CLOCKS)
        words = "ticks whose phase or laps are not the exact fraction, rounded down: start, phase, advance"
        rows.add(Check.of("clock", wrong, 0, words))


def _clock_errors(made: Part, ticks: int, periods: int) -> int:
    """Ticks, of two rounds, at which phase or laps are not those of exact fractions."""
    start, clock_phase, advance = (made.library.function(name) for name in ("start", "phase", "advance"))
    held = made.library.hold("start", {"ticks": ticks, "periods": periods, "clock": {}})
    clock, phase = made.library.hold("phase", {"clock": held["clock"], "phase": np.zeros(1)}).values()
    unit = Fraction(1, 2**24 if made.real == "float" else 2**52)
    wrong = int(start(*held.values()) != 0)
    for tick in range(2 * ticks):
        wrong += int(clock_phase(clock, phase) != 0)
        laps, part = divmod(Fraction(tick * periods, ticks), 1)
        wrong += int(not 0 <= part - Fraction(float(phase[0])) < unit or clock.laps != laps)
        wrong += int(advance(clock) != 0)
    return wrong
