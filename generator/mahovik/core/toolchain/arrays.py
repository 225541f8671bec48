"""Emitted C of a stand, its batches and its arrays in one shared library of this machine, and calling it."""

from __future__ import annotations

import ctypes
import os
import platform
import shutil
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mahovik.core.toolchain.compiler import BITS, WARNINGS, run_compiler
from mahovik.errors import ToolchainError

SINGLE = (*BITS, "-O2")
"""Flags for functions of one state."""

BATCH = (*BITS, "-O3", "-march=native")
"""Flags for batches: with the registers of this processor, and the same bits."""

_PARALLEL = "-fopenmp"
_PLACE = ["-shared", "-fPIC"]


_PROCESS = {"forked": False}


def _after_fork() -> None:
    """The threads of OpenMP stayed behind in the process that this was forked from: waiting for them would not end."""
    _PROCESS["forked"] = True


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_after_fork)


@lru_cache
def machine(compiler: tuple[str, ...]) -> str:
    """Macros that the compiler predefines on this processor: where they are equal, so is the code it makes."""
    return run_compiler(["-march=native", "-dM", "-E", "-x", "c", os.devnull], "no file at all", compiler)


def program_file(compiler: tuple[str, ...]) -> str:
    """The file of the compiler's program: path, size, time of change; and the architecture of this processor.

    Where they are equal, so is the code that is compiled without `-march=native`.
    """
    path = Path(shutil.which(compiler[0]) or compiler[0]).resolve()
    found = path.stat()
    return f"{path} {found.st_size} {found.st_mtime_ns} {platform.machine()}"


def build(parts: Iterable[Mapping[str, str]], name: str, folder: Path, compiler: Sequence[str], parallel: bool) -> Path:
    """Compiles C by file name into a shared library in `folder`; `parallel`: with OpenMP. Raises ToolchainError.

    parts  files after files: those of a part are compiled while the next part is made
    """
    from mahovik.core.toolchain.process import side_by_side

    openmp = [_PARALLEL] if parallel else []

    def compile_file(file: str) -> str:
        target = f"{folder / file}.o"
        how = BATCH if file == f"{name}_batch.c" else SINGLE
        run_compiler([*WARNINGS, *how, *openmp, "-fPIC", "-c", str(folder / file), "-o", target], file, compiler)
        return target

    with side_by_side() as pool:
        under_way = []
        for files in parts:
            for file, text in files.items():
                (folder / file).write_text(text, encoding="ascii", newline="\n")
            under_way += [pool.submit(compile_file, file) for file in files if file.endswith(".c")]
        objects = [each.result() for each in under_way]
    library = folder / f"{name}.so"
    try:
        run_compiler([*objects, *_PLACE, *openmp, "-o", str(library)], "to link", compiler)
    except ToolchainError as error:
        hint = "; more than one thread needs its OpenMP library (clang on Debian: apt-get install libomp-dev)"
        raise ToolchainError(f"{error}{hint if parallel else ''}") from None
    return library


class ArrayLibrary:
    """A library that `build` made. Its functions may be called from any thread; they let other threads run.

    Raises ToolchainError where the file is no such library.
    """

    def __init__(self, library: Path, name: str, functions: Sequence[str], parallel: bool, tables: bool) -> None:
        """`functions`: names of those that `call` knows; `tables`: whether they take tables of n stands."""
        try:
            loaded = ctypes.CDLL(str(library))
            self._calls = {f: loaded[f"{name}_arrays_{f}"] for f in functions}
            self._threads = loaded[f"{name}_arrays_threads"] if parallel else None
            self._block_bytes = loaded[f"{name}_arrays_block_bytes"] if tables else None
        except (OSError, AttributeError) as error:
            raise ToolchainError(f"{library.name} cannot be loaded: {error}") from error
        for each in self._calls.values():
            each.argtypes, each.restype = (ctypes.c_size_t, ctypes.c_void_p, ctypes.c_void_p), ctypes.c_int
        if self._threads is not None:
            self._threads.argtypes, self._threads.restype = (ctypes.c_int,), None
        if self._block_bytes is not None:
            self._block_bytes.argtypes, self._block_bytes.restype = (ctypes.c_int,), ctypes.c_size_t

    def block_bytes(self, mountings: bool) -> int:
        """How many bytes a block of prepared tables takes, or one of mountings."""
        assert self._block_bytes is not None
        return int(self._block_bytes(int(mountings)))

    def call(
        self, function: str, n: int, arrays: Sequence[NDArray[Any]], status: NDArray[np.int32], threads: int = 1
    ) -> int:
        """Calls a function on contiguous arrays; returns the first negative status, else 0.

        In a process that was forked and runs no other program, `threads` is 1.
        """
        if self._threads is not None:
            self._threads(1 if _PROCESS["forked"] else threads)
        passed = (ctypes.c_void_p * len(arrays))(*[_address(a) for a in arrays])
        return int(self._calls[function](n, passed, _address(status)))

    def repeat_call(
        self, function: str, n: int, arrays: Sequence[NDArray[Any]], status: NDArray[np.int32]
    ) -> Callable[[], int]:
        """A call that is made again and again with the same memory, in one thread; see `call`."""
        passed = (ctypes.c_void_p * len(arrays))(*[_address(a) for a in arrays])
        called, of_status, kept = self._calls[function], _address(status), (*arrays, status)

        def call() -> int:
            assert kept  # the memory lives as long as the call
            return int(called(n, passed, of_status))

        return call


def _address(array: NDArray[Any]) -> int | None:
    """Where an array lies; by way of its buffer, which takes a tenth of the time of `array.ctypes.data`."""
    if not array.size:
        return None
    if not array.flags.writeable:
        return array.ctypes.data
    return ctypes.addressof(ctypes.c_char.from_buffer(array.data))
