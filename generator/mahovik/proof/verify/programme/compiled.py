"""C of a programme or servo in a folder, beside the stand's own: compiled, called with NumPy data, judged by a law."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np

from mahovik.contract.limits import LIMITS, PERTURBATION, PERTURBATIONS
from mahovik.contract.status import STATUS_VALUES, status_words
from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand
from mahovik.core.toolchain.library import Library
from mahovik.errors import StateError, UsageError
from mahovik.proof.reference.array import Array
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.refusals import NULL, WrongValue, with_value
from mahovik.proof.verify.scales import is_word

UNCHECKED = ("gains", "design", "clock", "invalid", "sum", "wanted", "present")
"""Arguments and members that no function checks: a program has them in its text, or made them itself."""

NOT_FINITE = (math.nan, math.inf, -math.inf)


@dataclass(frozen=True)
class Part:
    """C of a programme or servo in a folder, loaded. `limit`: of a programme, what its tables may add to the residual,
    as the folder's JSON file says.
    """

    library: Library
    real: str
    limit: float

    def round(self, values: Any) -> Any:
        """The nearest numbers that the element type has, of mappings in each member; whole numbers stay."""
        if isinstance(values, Mapping):
            return {name: self.round(value) for name, value in values.items()}
        if np.asarray(values).dtype.kind != "f":
            return values
        with np.errstate(over="ignore"):
            return np.asarray(values, np.float32 if self.real == "float" else np.float64).astype(np.float64)

    def functions(self, needed: Iterable[str]) -> list[str]:
        """Public functions of the header, after those that are needed."""
        return [*dict.fromkeys((*needed, *self.library.functions()))]

    def call(self, function: str, inputs: Mapping[str, Any]) -> tuple[int, dict[str, Any]]:
        """Status of a function, and all its arguments after the call, members of a state by their own names.

        `inputs`: all arguments in their order: arrays, structs as mappings, numbers, None for a null pointer.
        """
        held = self.hold(function, inputs)
        status = int(self.library.function(function)(*held))
        found = {name: self.read(value) for name, value in zip(inputs, held, strict=True)}
        return status, found | found.pop("state", {})

    def hold(self, function: str, inputs: Mapping[str, Any]) -> list[Any]:
        """Inputs as data of C. Raises StateError where the C lacks the function."""
        if not self.library.has(function):
            raise StateError(f"{function} is not in the C: export it again")
        ffi = self.library.ffi
        kinds = ffi.typeof(self.library.function(function)).args

        def converted(kind: Any, value: Any) -> Any:
            if kind.kind == "primitive":
                return np.asarray(value).item()
            if value is None or value is NULL:
                return ffi.NULL
            if kind.item.kind == "struct":
                return ffi.new(ffi.getctype(kind.item, "*"), {k: np.asarray(x).tolist() for k, x in value.items()})
            return ffi.new(ffi.getctype(kind.item, "[]"), np.asarray(value).tolist())

        return [converted(kind, value) for kind, value in zip(kinds, inputs.values(), strict=True)]

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
        return np.array([self.read(x) for x in value])


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
    return Part(Library(header, source, scratch, stand.name, programme), real, limit)


def law_checks(
    part: Part, function: str, drawn: Iterable[Mapping[str, Any]], law: Callable[..., Mapping[str, Any]],
    rng: np.random.Generator,
) -> Iterable[Check]:  # fmt: skip
    """What a function writes against its law, from drawn inputs, a check for each quantity.

    A scale is the number itself, or its largest change over the relative change of every input; words, and what counts,
    must be those of the law at the inputs or so near.
    """
    rows: dict[str, Check] = {}
    limit, size = LIMITS[part.real].law, PERTURBATION[part.real]
    for number, inputs in enumerate(drawn):
        status, found = part.call(function, inputs)
        found["status"] = status_words(status)
        nearby = [law(**_changed(inputs, size, rng)) for _ in range(PERTURBATIONS)]
        for name, value in law(**inputs).items():
            row, others = rows.setdefault(name, Check(function, name, limit)), [other[name] for other in nearby]
            if is_word(value):
                words = f"{found[name]}, expected {value}"
                row.demand(found[name] in (value, *others), f"sample {number}", words)
            else:
                scale = np.max([np.abs(value), *(np.abs(other - value) / size for other in others)], axis=0)
                row.compare(found[name], value, scale, f"sample {number}")
    return rows.values()


def _changed(value: Any, size: float, rng: np.random.Generator) -> Any:
    """Inputs with every number times 1 + size u, |u| <= 1; whole numbers stay."""
    if isinstance(value, Mapping):
        return {name: _changed(each, size, rng) for name, each in value.items()}
    if np.asarray(value).dtype.kind != "f":
        return value
    return value * (1 + size * rng.uniform(-1, 1, np.shape(value)))


def refusal_check(part: Part, function: str, good: Mapping[str, Any], wrong: Mapping[str, tuple[float, ...]]) -> Check:
    """Bad inputs of a function are refused, one wrong value at a time, with all results untouched.

    `good`: all arguments in their order, NaN what is only written; `wrong`: out of range, by argument or member.
    """
    row, ffi = Check(function, "bad inputs refused"), part.library.ffi
    for bad in _wrong_values(good, wrong):
        held = part.hold(function, with_value(good, bad))
        written = [x for x in held if isinstance(x, ffi.CData) and x != ffi.NULL]
        before = [bytes(ffi.buffer(x)) for x in written]
        status = int(part.library.function(function)(*held))
        row.demand(
            status == STATUS_VALUES[bad.status], bad.words, f"status {status_words(status)}, expected {bad.status}"
        )
        same = before == [bytes(ffi.buffer(x)) for x in written]
        row.demand(same, bad.words, "refused, but results were written")
    return row


def _wrong_values(good: Mapping[str, Any], wrong: Mapping[str, tuple[float, ...]]) -> Iterator[WrongValue]:
    for name, value in good.items():
        if isinstance(value, Mapping) or np.ndim(value):
            yield WrongValue((name,), NULL, "BAD_ARGUMENT")
        for path, number in _numbers(value, (name,)):
            symbol = [step for step in path if isinstance(step, str)][-1]
            if name in UNCHECKED or symbol in UNCHECKED:
                continue
            if isinstance(number, int):
                yield from (WrongValue(path, x, "BAD_ARGUMENT") for x in wrong[symbol])
            elif not math.isnan(number):
                yield from (WrongValue(path, x, "NOT_FINITE") for x in NOT_FINITE)
                yield from (WrongValue(path, x, "RANGE") for x in wrong[symbol])


def _numbers(value: Any, path: tuple[str | int, ...]) -> Iterator[tuple[tuple[str | int, ...], Any]]:
    """Numbers of nested data, with where they stand."""
    if isinstance(value, Mapping) or np.ndim(value):
        for key, part in value.items() if isinstance(value, Mapping) else enumerate(value):
            yield from _numbers(part, (*path, key))
    else:
        yield path, value


def spread_phases(count: int) -> Array:
    """Rising phases in [0, 1), spread by the golden ratio, so that they fall everywhere between nodes."""
    return np.sort((np.arange(1.0, count + 1.0) * (np.sqrt(5.0) - 1.0) / 2.0) % 1.0)
