"""Emitted C in this process: compiled, loaded by its own header, and called with plain Python data."""

from __future__ import annotations

import re
import tempfile
from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import zip_longest
from pathlib import Path
from typing import Any, TypeVar

import cffi
import numpy as np

from mahovik.core.emit.names import MACROS, member
from mahovik.core.program.call import Argument
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind, Struct
from mahovik.core.toolchain import store
from mahovik.core.toolchain.compiler import BITS, SHARED, WARNINGS, preprocess, run_compiler
from mahovik.errors import StateError, ToolchainError

_SIZE_CHECK = re.compile(r"typedef char \w+\[\(sizeof[^;]*;")
"""Arrays that have a size only where two headers fit: a matter of the compiler, which has seen them."""

_PLAIN = {member(name): name for name in MACROS}
"""Names of members that have another name in C."""


FLAGS = (*BITS, "-O2")

Loaded = TypeVar("Loaded")


def load_compiled(source: Path, flags: Sequence[str], load: Callable[[str], Loaded]) -> Loaded:
    """Loads the library of one C file and the headers beside it, which is kept for others. Raises ToolchainError."""
    key = store.source_key(source, flags)
    if (kept := store.find(key)) is not None:
        return load(str(kept[0]))
    # once loaded, the library needs its file no more
    with tempfile.TemporaryDirectory(prefix="mahovik-", ignore_cleanup_errors=True) as scratch:
        library = Path(scratch) / f"{source.stem}.so"
        command = [*WARNINGS, *flags, *SHARED, f"-I{source.parent}", str(source), "-o", str(library)]
        run_compiler(command, source.name)
        store.keep(key, library, {})
        return load(str(library))


class Library:
    """One stand's C, built of a source that lies beside its header, or taken from the store.

    The declarations come from the header itself, through the compiler's preprocessor. Public names begin with the
    stand's name, and with that of the programme where the C is of one that has a name.
    """

    def __init__(self, source: Path, stand: str, programme: str = "") -> None:
        header, plain = source.with_suffix(".h"), f"-D{stand.upper()}_PLAIN_NAMES"
        self._prefix = f"{stand}_{programme}" if programme else stand
        self._ffi = cffi.FFI()
        try:
            # cffi reaches variables only: it takes a `const` object for a constant of the compiler.
            text = _SIZE_CHECK.sub("", preprocess(header, plain))
            self._ffi.cdef(text.replace("extern const ", "extern "))
            self._library = load_compiled(source, (*FLAGS, plain), self._ffi.dlopen)
        except (cffi.CDefError, OSError) as error:
            raise ToolchainError(f"{header.name} cannot be read as declarations: {error}") from error

    @classmethod
    def of_texts(cls, files: Mapping[str, str], source: str, stand: str) -> Library:
        """The library of a source among texts by file name."""
        with tempfile.TemporaryDirectory(prefix="mahovik-", ignore_cleanup_errors=True) as folder:
            for file, text in files.items():
                Path(folder, file).write_text(text, encoding="ascii", newline="\n")
            return cls(Path(folder, source), stand)

    def has(self, function: str) -> bool:
        """Is there a public function of that name (without prefix)?"""
        return hasattr(self._library, f"{self._prefix}_{function}")

    def functions(self) -> tuple[str, ...]:
        """Names (without prefix) of the public functions that header and source have, in the order of names."""
        start = f"{self._prefix}_"
        names = sorted(name for name in dir(self._library) if name.startswith(start))
        return tuple(name.removeprefix(start) for name in names if self._is_function(name))

    def _is_function(self, name: str) -> bool:
        try:
            function = getattr(self._library, name)
        except (AttributeError, KeyError):  # declared by an included header, and defined elsewhere
            return False
        return isinstance(function, self._ffi.CData) and self._ffi.typeof(function).kind == "function"

    def constant(self, name: str) -> int:
        """A whole number of the header by its name without prefix, such as `SERVO_TICKS`."""
        try:
            return int(getattr(self._library, f"{self._prefix.upper()}_{name}"))
        except AttributeError as error:
            raise ToolchainError(f"the C has no constant {self._prefix.upper()}_{name}") from error

    def difference(self, functions: Iterable[Function]) -> str | None:
        """What first differs between the header's declarations and those of `functions`; None if nothing does.

        C that another version of mahovik made of the same stand may have other members or arguments.
        """
        seen: set[str] = set()
        for function in functions:
            name = f"{self._prefix}_{function.name}"
            there, expected = len(self._ffi.typeof(self.function(function.name)).args), len(function.arguments)
            if there != expected:
                return f"{name} takes {there} arguments, expected {expected}"
            for struct in (s for a in function.arguments if isinstance(a.type, Struct) for s in a.type.inner_structs()):
                if struct.name not in seen and (result := self._struct_difference(struct)):
                    return result
                seen.add(struct.name)
        return None

    def _struct_difference(self, struct: Struct) -> str | None:
        name = self._c_type(struct)
        try:
            there = [(key, field.type) for key, field in self._ffi.typeof(name).fields or ()]
        except self._ffi.error:
            return f"{name} is not declared"
        expected = [
            (member(f.name), self._ffi.typeof(f"{self._c_type(f.type)}{''.join(f'[{int(n)}]' for n in f.shape)}"))
            for f in struct.fields
        ]
        for have, want in zip_longest(there, expected, fillvalue=(None, None)):
            if have != want:
                return f"{name}: member {have[0] or 'missing'}, expected {want[0] or 'none'}"
        return None

    @property
    def ffi(self) -> cffi.FFI:
        """What makes and reads data of the library's types, for callers that call one function many times."""
        return self._ffi

    def function(self, name: str) -> Any:
        """A public function by its name without prefix, to be called with data of `ffi`. StateError: there is none."""
        if not self.has(name):
            raise StateError(f"{name} is not in the C: generate it again")
        return getattr(self._library, f"{self._prefix}_{name}")

    def default(self, name: str) -> Any:
        """Address of a constant of the library, such as `default`."""
        try:
            return self._ffi.addressof(self._library, f"{self._prefix}_{name}")
        except AttributeError as error:
            raise ToolchainError(f"the C has no constant {self._prefix}_{name}") from error

    def hold(self, function: str, inputs: Mapping[str, Any]) -> dict[str, Any]:
        """Data of C of all arguments of a function in their order, as its header declares them.

        Inputs are numbers, lists or arrays, structs as mappings, None for a null pointer; data of C stays as it is.
        """
        kinds = self._ffi.typeof(self.function(function)).args
        return {name: self._stored(kind, value) for kind, (name, value) in zip(kinds, inputs.items(), strict=True)}

    def _stored(self, kind: Any, value: Any) -> Any:
        if isinstance(value, self._ffi.CData):
            return value
        if kind.kind == "primitive":
            return np.asarray(value).item()
        if value is None:
            return self._ffi.NULL
        return self._ffi.new(self._ffi.getctype(kind.item, "*" if isinstance(value, Mapping) else "[]"), _of_c(value))

    def read(self, value: Any) -> Any:
        """Data of C as plain data: numbers, lists, structs as dicts; what a pointer points to."""
        if not isinstance(value, self._ffi.CData) or value == self._ffi.NULL:
            return value
        kind = self._ffi.typeof(value)
        if kind.kind == "pointer":
            return self.read(value[0])
        if kind.kind == "struct":
            return {_PLAIN.get(name, name): self.read(getattr(value, name)) for name, _ in kind.fields}
        if kind.item.kind == "primitive":
            return self._ffi.unpack(value, len(value))
        return [self.read(element) for element in value]

    def run(
        self, function: Function, inputs: Mapping[str, Any], fill: float | None = None
    ) -> tuple[int, dict[str, Any]]:
        """Calls a public function with inputs by argument name; returns its status and its outputs as plain data.

        With `fill`, outputs hold that number beforehand, so that a caller can see whether they were written.
        """
        held = self.hold_all(function, inputs, fill)
        status = self.function(function.name)(*held.values())
        written = (a.name for a in function.arguments if a.direction != "in")
        return int(status), {name: self.read(held[name]) for name in written if held[name]}

    def hold_all(self, function: Function, inputs: Mapping[str, Any], fill: float | None = None) -> dict[str, Any]:
        """Data of C of all arguments of a function: of `inputs`, and memory of what is not given, zero or `fill`."""
        return self.hold(function.name, {a.name: self._memory(a, inputs.get(a.name), fill) for a in function.arguments})

    def _memory(self, a: Argument, value: Any, fill: float | None) -> Any:
        """What an argument is given: its value; where there is none, none or memory."""
        if isinstance(value, self._ffi.CData) or (value is None and a.optional == "missing"):
            return value
        if not a.shape and not a.variable.pointer:
            return 0 if value is None else value
        if value is None and fill:
            value = uniform_data(a.type, a.shape, fill)
        count = f"[{int(a.shape[0])}]" if a.shape else "*"  # a list that is too short is filled up with zeros
        return self._ffi.new(f"{self._c_type(a.type)} {count}", _of_c(value))

    def probe(self, function: str, held: Mapping[str, Any]) -> tuple[int, bool]:
        """Calls a function with data of C; returns its status, and whether all that it points to is as it was."""
        pointed = [self._ffi.buffer(x) for x in held.values() if isinstance(x, self._ffi.CData) and x != self._ffi.NULL]
        before = [bytes(memory) for memory in pointed]
        status = int(self.function(function)(*held.values()))
        return status, before == [bytes(memory) for memory in pointed]

    def _c_type(self, type_: Kind | Struct) -> str:
        if isinstance(type_, Struct):
            return f"{self._prefix}_{type_.name}"
        return {Kind.REAL: f"{self._prefix}_real", Kind.INT: "int"}[type_]


def _of_c(value: Any) -> Any:
    """Plain data, also of arrays, with the names that members of structs have in C."""
    if isinstance(value, float):
        return value
    if isinstance(value, list):
        return value if not value or isinstance(value[0], float) else [_of_c(content) for content in value]
    if isinstance(value, Mapping):
        return {member(name): _of_c(content) for name, content in value.items()}
    return value.tolist() if isinstance(value, np.ndarray | np.generic) else value


def uniform_data(type_: Kind | Struct, shape: tuple[Any, ...], number: float) -> Any:
    """Plain data of a type with every number the same."""
    if shape:
        return [uniform_data(type_, shape[1:], number) for _ in range(int(shape[0]))]
    if isinstance(type_, Struct):
        return {f.name: uniform_data(f.type, f.shape, number) for f in type_.fields}
    return number if type_ is Kind.REAL else int(number)
