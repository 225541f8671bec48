"""C of a programme or servo in a folder, beside the stand's own: compiled, and called with NumPy data."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np

from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand
from mahovik.core.toolchain.library import Library
from mahovik.errors import UsageError
from mahovik.proof.reference.array import Array


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
        return [self._converted(kind, value) for kind, value in zip(kinds, values, strict=True)]

    def _converted(self, kind: Any, value: Any) -> Any:
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
