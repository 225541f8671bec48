"""C of a programme or servo in a folder, beside the stand's own: compiled, called with NumPy data, judged by a law."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path as FilePath
from typing import Any, Literal

import numpy as np

from mahovik.contract.limits import PERTURBATION, PERTURBATIONS
from mahovik.contract.status import status_words
from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand
from mahovik.core.toolchain.library import Library
from mahovik.errors import StateError, UsageError
from mahovik.proof.reference.array import Array
from mahovik.proof.verify.compare import Rows
from mahovik.proof.verify.refusals import NOTHING, NULL, Numbers, WrongValue, demand_refusals, wrong_within
from mahovik.proof.verify.scales import changed, is_word

UNCHECKED = frozenset(("gains", "design", "clock", "invalid", "sum", "wanted", "present"))
"""Arguments and members that no function checks: a program has them in its text, or made them itself."""


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
        result = {name: self.read(value) for name, value in zip(inputs, held, strict=True)}
        return status, result | result.pop("state", {})

    def probe(self, function: str, inputs: Mapping[str, Any]) -> tuple[int, bool]:
        """Status of a function, and whether all that its arguments point to is as it was."""
        ffi, held = self.library.ffi, self.hold(function, inputs)
        pointed = [x for x in held if isinstance(x, ffi.CData) and x != ffi.NULL]
        before = [bytes(ffi.buffer(x)) for x in pointed]
        status = int(self.library.function(function)(*held))
        return status, before == [bytes(ffi.buffer(x)) for x in pointed]

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


def load_part(stand: Stand, folder: FilePath, kind: Literal["programme", "servo"], name: str) -> Part:
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
        physics, real, limit = str(document["physics"]), document["real"], float(document.get("limit", 0.0))
        readable = real in ("float", "double") and 0.0 <= limit < math.inf and (kind == "servo" or "limit" in document)
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError):
        readable = False
    if not readable:
        raise UsageError(f"{manifest}: not as `mahovik generate --{kind}` writes it: write the {kind} again")
    if physics != identities(stand).physics:
        expected = f"expected {identities(stand).physics} of the stand {stand.name}"
        raise UsageError(f"{manifest}: its physics is {physics}, {expected}: export the {kind} again")
    return Part(Library(source, stand.name, programme), real, limit)


def compare_with_law(
    part: Part, rows: Rows, drawn: Iterable[Mapping[str, Any]], law: Callable[..., Mapping[str, Any]],
    rng: np.random.Generator,
) -> None:  # fmt: skip
    """What a function writes against its law, from drawn inputs, a check for each quantity.

    A scale is the number itself, or its largest change over the relative change of every input. Of words, and what
    counts, those are left out that differ where they change so near.
    """
    size = PERTURBATION[part.real]
    for number, inputs in enumerate(drawn):
        status, results = part.call(rows.function, inputs)
        results["status"] = status_words(status)
        nearby = [law(**changed(dict(inputs), size, rng)) for _ in range(PERTURBATIONS)]
        for name, value in law(**inputs).items():
            neighbours = [other[name] for other in nearby]
            if is_word(value) and results[name] != value and results[name] in neighbours:
                rows.check(name, "exact").skip("rounding decides it", f"sample {number}")
            elif is_word(value):
                rows.demand(name, results[name] == value, f"sample {number}", f"{results[name]}, expected {value}")
            else:
                scale = np.max([np.abs(value), *(np.abs(other - value) / size for other in neighbours)], axis=0)
                rows.check(name).compare(results[name], value, scale, f"sample {number}")


def judge_refusals(part: Part, rows: Rows, good: Mapping[str, Any], beyond: Numbers = NOTHING) -> None:
    """Bad inputs of a function are refused, one wrong value at a time, with all results untouched.

    `good`: all arguments in their order, NaN what is only written; `beyond`: values just out of range besides.
    """
    pointers = [name for name, value in good.items() if isinstance(value, Mapping) or np.ndim(value)]
    wrong = [WrongValue((name,), NULL, "BAD_ARGUMENT") for name in pointers]
    for name, value in good.items():
        wrong += wrong_within(value, (name,), part.real, UNCHECKED, beyond)
    demand_refusals(rows.check("bad inputs refused", "exact"), rows.function, good, wrong, part.probe)


def spread_phases(count: int) -> Array:
    """Rising phases in [0, 1), spread by the golden ratio, so that they fall everywhere between nodes."""
    return np.sort((np.arange(1.0, count + 1.0) * (np.sqrt(5.0) - 1.0) / 2.0) % 1.0)
