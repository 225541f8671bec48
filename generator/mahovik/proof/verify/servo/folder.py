"""The C of a servo in a folder, compiled and called with NumPy data."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand
from mahovik.core.toolchain.library import Library
from mahovik.errors import UsageError
from mahovik.proof.verify.bounds import BOUNDS, Bounds
from mahovik.proof.verify.servo.law import Array


@dataclass(frozen=True)
class CompiledServo:
    """The servo's C of a folder, loaded. `prefix`: what its names in C begin with; `count`: flywheels."""

    library: Library
    prefix: str
    real: str
    count: int

    @property
    def bounds(self) -> Bounds:
        """Accepted differences of the element type."""
        return BOUNDS[self.real]

    @property
    def has_trim(self) -> bool:
        """Whether the folder's servo has a trim."""
        return self.library.has("trim_default")

    def round(self, values: Any) -> Array:
        """The nearest numbers that the element type has."""
        kind = np.float32 if self.real == "float" else np.float64
        with np.errstate(over="ignore"):
            return np.asarray(np.asarray(values, dtype=np.float64).astype(kind), dtype=np.float64)

    def struct(self, name: str, members: Mapping[str, Any]) -> Any:
        """A struct of C with these members."""
        made = self.library.ffi.new(f"{self.prefix}_{name} *")
        for member, value in members.items():
            setattr(made, member, np.asarray(value).tolist())
        return made

    def default(self, name: str) -> dict[str, Any]:
        """Members of a table of the C, such as `servo_default`."""
        return self.members(self.library.default(name))

    def members(self, made: Any) -> dict[str, Any]:
        """Members of a struct of C: arrays, or numbers."""
        kind = self.library.ffi.typeof(made).item
        return {name: _plain(getattr(made, name)) for name, _ in kind.fields}

    def reals(self, values: Array) -> Any:
        """An array of C."""
        return self.library.ffi.new(f"{self.real}[]", values.tolist())

    def flags(self, values: Sequence[int] | None) -> Any:
        """An array of int; a null pointer for None."""
        return self.library.ffi.NULL if values is None else self.library.ffi.new("int[]", list(values))

    def read(self, array: Any) -> Array:
        """Numbers of an array of C."""
        return np.array(list(array), dtype=np.float64)

    def call(self, function: str, *given: Any) -> int:
        """Status of a function of this C."""
        return int(self.library.function(function)(*given))


def _plain(value: Any) -> Any:
    """An array or a number of C as NumPy data."""
    if isinstance(value, int | float):
        return value
    return np.array([_plain(each) for each in value])


def load_servo_folder(stand: Stand, folder: Path, name: str, scratch: Path) -> CompiledServo:
    """Compiles the servo of the programme `name` in a folder, in `scratch`.

    Raises UsageError: no such files, or of another stand; ToolchainError: no compiler, or it refuses the C.
    """
    programme = "" if name == "programme" else name
    prefix = f"{stand.name}_{programme}" if programme else stand.name
    header, source, facts = (folder / f"{prefix}_servo.{suffix}" for suffix in ("h", "c", "json"))
    own = folder / f"{stand.name}.h"
    for each in (header, source, facts, own):
        if not each.is_file():
            command = "generate" if each == own else "export servo"
            raise UsageError(f"{each}: not there; expected what `mahovik {command} -o {folder}` writes")
    physics, real = _facts(facts)
    if physics != identities(stand).physics:
        raise UsageError(
            f"{facts}: its physics is {physics}, expected {identities(stand).physics} of the stand {stand.name}: "
            "export the servo again"
        )
    library = Library(header, source, scratch, stand.name, programme)
    return CompiledServo(library, prefix, real, len(stand.flywheels))


def _facts(path: Path) -> tuple[str, str]:
    """Physics and element type in the manifest of a servo."""
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
        physics, real = str(found["physics"]), found["real"]
    except (ValueError, KeyError, TypeError, RecursionError):
        physics, real = "", None
    if real not in tuple(BOUNDS):
        raise UsageError(f"{path}: not as `mahovik export servo` writes it: export the servo again")
    return physics, str(real)
