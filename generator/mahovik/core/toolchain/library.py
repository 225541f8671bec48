"""Emitted C in this process: compiled, loaded by its own header, and called with plain Python data."""

from __future__ import annotations

import re
import tempfile
from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import zip_longest
from pathlib import Path
from typing import Any, TypeVar

import cffi

from mahovik.core.emit.names import member
from mahovik.core.program.call import Argument
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind, Struct
from mahovik.core.toolchain import store
from mahovik.core.toolchain.compiler import BITS, SHARED, WARNINGS, preprocess, run_compiler
from mahovik.errors import ToolchainError

_SIZE_CHECK = re.compile(r"typedef char \w+\[\(sizeof[^;]*;")
"""Arrays that have a size only where two headers fit: a matter of the compiler, which has seen them."""

_PATTERN = b"\xa5"
"""What results hold before a call that must not write them; no number that a stand has is made of it."""


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
        """A public function by its name without prefix, to be called with data of `ffi`."""
        return getattr(self._library, f"{self._prefix}_{name}")

    def default(self, name: str) -> Any:
        """Address of a constant of the library, such as `default`."""
        try:
            return self._ffi.addressof(self._library, f"{self._prefix}_{name}")
        except AttributeError as error:
            raise ToolchainError(f"the C has no constant {self._prefix}_{name}") from error

    def value(self, function: Function, name: str) -> Any:
        """A constant struct as plain data, by the type of the argument of that name."""
        argument = next(a for a in function.arguments if a.name == name)
        return self._plain(self.default("default")[0], argument.type, argument.shape)

    def run(
        self, function: Function, inputs: Mapping[str, Any], fill: float | None = None, plain: bool = True
    ) -> tuple[int, dict[str, Any]]:
        """Calls a public function with inputs by argument name; returns its status and its outputs as plain data.

        Inputs are numbers, lists, dicts, or addresses from `default`. With `fill`, outputs hold that number
        beforehand, so that a caller can see whether they were written; without `plain` they are not read.
        """
        storage = {a.name: self._storage(a, inputs.get(a.name), fill) for a in function.arguments}
        call = getattr(self._library, f"{self._prefix}_{function.name}")
        status = call(*storage.values())
        outputs = {}
        for a in function.arguments:
            if a.direction != "in" and plain and storage[a.name]:
                stored = storage[a.name]
                outputs[a.name] = self._plain(stored if a.shape else stored[0], a.type, a.shape)
        return int(status), outputs

    def probe(self, function: Function, inputs: Mapping[str, Any]) -> tuple[int, bool]:
        """Calls a public function; returns its status, and whether every byte of its results is as it was.

        Of results whose address is given (null, for example) nothing is said.
        """
        storage = {}
        before = {}
        for a in function.arguments:
            if isinstance(inputs.get(a.name), self._ffi.CData):
                storage[a.name] = inputs[a.name]
                continue
            if a.direction != "out":
                storage[a.name] = self._storage(a, inputs.get(a.name), None)
            else:
                count = int(a.shape[0]) if a.shape else 1
                storage[a.name] = self._ffi.new(f"{self._c_type(a.type)}[{count}]")
                held = self._ffi.buffer(storage[a.name])
                held[:] = _PATTERN * len(held)
            if a.direction != "in" and storage[a.name]:
                before[a.name] = bytes(self._ffi.buffer(storage[a.name]))
        status = getattr(self._library, f"{self._prefix}_{function.name}")(*storage.values())
        return int(status), all(bytes(self._ffi.buffer(storage[name])) == held for name, held in before.items())

    def _storage(self, a: Argument, value: Any, fill: float | None) -> Any:
        if isinstance(value, self._ffi.CData):
            return value
        if value is None and a.optional == "missing":
            return self._ffi.NULL
        if not a.shape and not a.variable.pointer:
            return 0 if value is None else value
        kind = self._c_type(a.type)
        if value is None and fill:  # else it is zero
            value = _by_member(uniform_data(a.type, a.shape, fill))
        if a.shape:
            return self._ffi.new(f"{kind}[{int(a.shape[0])}]", value)
        return self._ffi.new(f"{kind} *", value)

    def _c_type(self, type_: Kind | Struct) -> str:
        if isinstance(type_, Struct):
            return f"{self._prefix}_{type_.name}"
        return {Kind.REAL: f"{self._prefix}_real", Kind.INT: "int"}[type_]

    def _plain(self, stored: Any, type_: Kind | Struct, shape: tuple[Any, ...]) -> Any:
        if len(shape) == 1 and isinstance(type_, Kind):
            return self._ffi.unpack(stored, int(shape[0]))
        if shape:
            return [self._plain(stored[i], type_, shape[1:]) for i in range(int(shape[0]))]
        if isinstance(type_, Struct):
            return {f.name: self._plain(getattr(stored, member(f.name)), f.type, f.shape) for f in type_.fields}
        return stored


def _by_member(value: Any) -> Any:
    """Plain data with the names that members of structs have in C."""
    if isinstance(value, dict):
        return {member(name): _by_member(content) for name, content in value.items()}
    return [_by_member(content) for content in value] if isinstance(value, list) else value


def uniform_data(type_: Kind | Struct, shape: tuple[Any, ...], number: float) -> Any:
    """Plain data of a type with every number the same."""
    if shape:
        return [uniform_data(type_, shape[1:], number) for _ in range(int(shape[0]))]
    if isinstance(type_, Struct):
        return {f.name: uniform_data(f.type, f.shape, number) for f in type_.fields}
    return number if type_ is Kind.REAL else int(number)
