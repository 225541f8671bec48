"""Emitted C of batches in this process, beside the functions for one state, by ctypes on arrays."""

from __future__ import annotations

import ctypes
import subprocess
from collections.abc import Callable, Iterator
from itertools import count
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from numpy.typing import NDArray

from emit.stands import stand, write
from mahovik.core.emit.batch import batch_files
from mahovik.core.emit.generate import generate_all
from mahovik.core.lower.batch import Batch, batches
from mahovik.core.program.types import Kind, Struct
from toolchain.tools import FIRMWARE_WARNINGS

OPTIONS: dict[str, float] = {"dt": 1e-5, "order": 4}
"""Arguments that are the same for all states."""


Arrays = dict[str, NDArray[Any]]
"""Inputs or results by name, (components, states), in the element type of the C."""

Numbers = NDArray[np.int32]


class Batched:
    """C of a stand with its batches, built by a compiler with flags; `tables` of stands that differ a little."""

    def __init__(
        self, name: str, real: str = "double", compiler: str = "gcc", flags: tuple[str, ...] = ("-O0",)
    ) -> None:
        given = stand(name)
        self.generated = generate_all(given, real)
        self.layout, self.name = self.generated.layout, name
        self.batches = batches(self.generated.program).batches
        self.real: type[np.floating[Any]] = np.float32 if real == "float" else np.float64
        files = {**self.generated.files, **batch_files(given, self.generated)}
        files["vary.c"] = _vary(name, self.layout.table, real)
        if self.layout.flywheels:
            files["vary.c"] += _vary_mounting(name, self.layout.mount_table, real)
        with TemporaryDirectory() as folder:
            write(files, Path(folder))
            command = [compiler, *FIRMWARE_WARNINGS, "-Wno-missing-prototypes", "-ffp-contract=off", "-fPIC"]
            command.append(f"-D{name.upper()}_PLAIN_NAMES")
            base = [f for f in flags if "native" not in f]  # gcc 12 fuses in the functions for one state
            objects = []
            for source in files:
                if source.endswith(".c"):
                    objects.append(str(Path(folder) / f"{source}.o"))
                    options = flags if source == f"{name}_batch.c" else base
                    subprocess.run(
                        [*command, *options, "-c", str(Path(folder) / source), "-o", objects[-1]], check=True
                    )
            self.object_code = Path(folder, f"{name}_batch.c.o").read_bytes()
            library = Path(folder) / "batch.so"
            subprocess.run([compiler, *flags, "-shared", *objects, "-o", str(library)], check=True)
            self.library = ctypes.CDLL(str(library))

    def inputs(self, rng: np.random.Generator, n: int) -> Arrays:
        """Inputs of n ordinary states by name, arrays of (components, n)."""
        layout, count = self.layout, int(self.layout.count) if self.layout.flywheels else 0
        attitude = rng.normal(size=(4, n))
        rows = [rng.normal(size=(3, n)) * 0.1, attitude / np.linalg.norm(attitude, axis=0), rng.normal(size=(6, n))]
        rows += [rng.uniform(-3, 3, (count, n)), rng.normal(size=(count, n)) * 100]
        found = {"x": np.vstack(rows), "phi_ddot": rng.normal(size=(count, n)) * 300, "V_dot": rng.normal(size=(6, n))}
        found |= {"tau": rng.normal(size=(count, n)), "wrench": rng.normal(size=(6 * len(layout.inputs), n))}
        return {name: np.ascontiguousarray(values, dtype=self.real) for name, values in found.items()}

    def one(self, batch: Batch, inputs: Arrays, j: int, table: bytes | None = None) -> tuple[int, Arrays]:
        """Status and results of the function for one state, of state j."""
        columns = {name: np.ascontiguousarray(values[:, j]) for name, values in inputs.items()}
        factor = 1 + 1e-4 * j if batch.each else 1.0
        mounting = ctypes.c_char_p(self.mounting(factor)) if self._takes_mounting(batch) else None
        status, results = self._called(
            batch.narrow.name, batch, columns, 1, table or self._default(), None, mounting=mounting
        )
        return status, {name: values[:, 0] for name, values in results.items()}

    def many(
        self, batch: Batch, inputs: Arrays, n: int, tables: bytes | None = None, fill: float = np.nan
    ) -> tuple[int, Numbers, Arrays]:
        """Return value of a batch, statuses (n) and results, arrays of (components, n)."""
        name = f"{batch.narrow.name}_batch{'_of' if batch.each else ''}"
        statuses = np.full(n, 99, dtype=np.int32)
        table: ctypes.c_char_p | ctypes.c_void_p = self._default()
        mounting: ctypes.c_char_p | ctypes.c_void_p | None = None
        if self._takes_mounting(batch):
            singles = b"".join(self.mounting(1 + 1e-4 * j if batch.each else 1.0) for j in range(n))
            mounting = ctypes.c_char_p(singles)
            if batch.each:
                mounting = aligned(max(1, -(-n // 8)) * self.library.size_of_wide_mounting())
                self.library.put_mountings(singles, n, mounting)
        if batch.each:
            table = aligned(max(1, -(-n // 8)) * self.library.size_of_wide())
            given = self.function("tables")
            assert given(ctypes.c_char_p(tables), ctypes.c_size_t(n), table) == 0
        returned, results = self._called(name, batch, inputs, n, table, statuses, fill, mounting)
        return returned, statuses, results

    def table(self, factor: float) -> bytes:
        """A copy of the default table, every number a little larger."""
        memory = ctypes.create_string_buffer(self.library.size_of_table())
        self.library.vary(memory, ctypes.c_double(factor))
        return memory.raw

    def mounting(self, factor: float) -> bytes:
        """A copy of the default mountings, every number a little larger."""
        memory = ctypes.create_string_buffer(self.library.size_of_mounting())
        self.library.vary_mounting(memory, ctypes.c_double(factor))
        return memory.raw

    def _takes_mounting(self, batch: Batch) -> bool:
        return any(a.name == "mounting" for a in batch.narrow.arguments)

    def function(self, name: str) -> Callable[..., int]:
        """A function of the stand by its name without the prefix."""
        found: Callable[..., int] = getattr(self.library, f"{self.name}_{name}")
        return found

    def _default(self) -> ctypes.c_char_p:
        return ctypes.c_char_p(self.table(1.0))

    def _called(
        self,
        name: str,
        batch: Batch,
        inputs: Arrays,
        n: int,
        table: bytes | ctypes.c_char_p | ctypes.c_void_p,
        statuses: Numbers | None,
        fill: float = np.nan,
        mounting: ctypes.c_char_p | ctypes.c_void_p | None = None,
    ) -> tuple[int, Arrays]:
        passed: list[Any] = []
        results: Arrays = {}
        for a in batch.narrow.arguments:
            if a.name == "table":
                passed.append(ctypes.c_char_p(table) if isinstance(table, bytes) else table)
            elif a.name == "mounting":
                passed.append(mounting)
            elif a.name == "locked":
                passed.append(locks(len(inputs["tau"])).ctypes.data_as(ctypes.c_void_p))
            elif a.name in OPTIONS:
                number = OPTIONS[a.name]
                real = ctypes.c_float if self.real is np.float32 else ctypes.c_double
                passed.append(ctypes.c_int(int(number)) if a.type is Kind.INT else real(number))
            elif a.direction == "in":
                passed.append(inputs[a.name].ctypes.data_as(ctypes.c_void_p))
            else:
                rows = int(a.shape[0]) if a.shape else 1
                rows *= _reals(a.type) if isinstance(a.type, Struct) else 1
                results[a.name] = np.full((rows, n), fill, dtype=self.real)
                passed.append(results[a.name].ctypes.data_as(ctypes.c_void_p))
        if statuses is not None:
            passed.insert(1, ctypes.c_size_t(n))
            passed.append(statuses.ctypes.data_as(ctypes.c_void_p))
        return self.function(name)(*passed), results


def locks(flywheels: int) -> Numbers:
    """Locks of which the second flywheel's alone is on."""
    return np.array([int(s == 1) for s in range(flywheels)] or [0], dtype=np.int32)


class Aligned(ctypes.c_void_p):
    """An address that keeps its memory alive."""

    memory: ctypes.Array[ctypes.c_char]


def aligned(size: int) -> Aligned:
    """Memory at a multiple of 64 bytes."""
    memory = ctypes.create_string_buffer(size + 64)
    place = (ctypes.addressof(memory) + 63) // 64 * 64
    found = Aligned(place)
    found.memory = memory
    return found


def _vary(name: str, table: Struct, real: str) -> str:
    """C that scales every number of a copy of the default table."""
    lines = _statements(table, "t->", count(), _scale)
    return f"""#include "{name}_batch.h"
int size_of_table(void);
int size_of_wide(void);
void vary({name}_table *t, double factor);
int size_of_table(void) {{ return (int)sizeof({name}_table); }}
int size_of_wide(void) {{ return (int)sizeof({name}_wide_table); }}
void vary({name}_table *t, double factor)
{{
    const {real} f = ({real})factor;
    *t = {name}_default;
    {" ".join(lines)}
}}
"""


def _vary_mounting(name: str, mounting: Struct, real: str) -> str:
    """C that scales every number of a copy of the mountings, and that puts those of n stands side by side."""
    lines = _statements(mounting, "t->", count(), _scale)
    put = _statements(mounting, ".", count(), _put)
    return f"""
int size_of_mounting(void);
int size_of_wide_mounting(void);
void vary_mounting({name}_mount_table *t, double factor);
void put_mountings(const {name}_mount_table *t, int n, {name}_wide_mount_table *w);
int size_of_mounting(void) {{ return (int)sizeof({name}_mount_table); }}
int size_of_wide_mounting(void) {{ return (int)sizeof({name}_wide_mount_table); }}
void vary_mounting({name}_mount_table *t, double factor)
{{
    const {real} f = ({real})factor;
    (void){name}_prepare_mounts(&{name}_default_parameters, t);
    {" ".join(lines)}
}}
void put_mountings(const {name}_mount_table *t, int n, {name}_wide_mount_table *w)
{{
    const int lanes = (int)(sizeof(w[0].flywheel[0].mass) / sizeof({real}));
    for (int j = 0; j < (n + lanes - 1) / lanes * lanes; ++j) {{
        const int i = j < n ? j : n - 1;
        {" ".join(put)}
    }}
}}
"""


def _statements(struct: Struct, path: str, numbers: Iterator[int], leaf: Callable[[str, Any], str]) -> list[str]:
    """C that does what `leaf` gives, of a place and its type, with every number of a struct, in loops."""
    found = []
    for f in struct.fields:
        at, heads = f"{path}{f.name}", []
        for length in f.shape:
            index = f"k{next(numbers)}"
            heads.append(f"for (int {index} = 0; {index} < {int(length)}; ++{index}) {{")
            at += f"[{index}]"
        inner = _statements(f.type, f"{at}.", numbers, leaf) if isinstance(f.type, Struct) else [leaf(at, f.type)]
        found += [*heads, *inner, *("}" for _ in heads)]
    return found


def _put(place: str, _: Any) -> str:
    return f"w[j / lanes]{place}.at[j % lanes] = t[i]{place};"


def _scale(place: str, kind: Any) -> str:
    return f"{place} *= f;" if kind is Kind.REAL else ""


def _reals(struct: Struct) -> int:
    found = 0
    for f in struct.fields:
        size = _reals(f.type) if isinstance(f.type, Struct) else 1
        for length in f.shape:
            size *= int(length)
        found += size
    return found
