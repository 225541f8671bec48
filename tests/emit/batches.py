"""Emitted C of batches in this process, beside the functions for one state, by ctypes on arrays.

Batches in which each state has a table of its own are tried through Python, in tests/api.
"""

from __future__ import annotations

import ctypes
import subprocess
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from numpy.lib.recfunctions import structured_to_unstructured
from numpy.typing import NDArray

from emit.stands import stand, write
from mahovik.core.emit.batch import batch_files
from mahovik.core.emit.generate import Generated, generate_all
from mahovik.core.lower.batch import Batch, batches
from mahovik.core.program.arrays import fill_record, members, record
from mahovik.core.program.types import Kind, Struct
from toolchain.tools import FIRMWARE_WARNINGS

OPTIONS: dict[str, float] = {"dt": 1e-5, "order": 4}
"""Arguments that are the same for all states."""

UNTOUCHED = 77
"""What results hold before a call."""

Arrays = dict[str, NDArray[Any]]
"""Inputs or results by name, (components, states), in the element type of the C."""

Numbers = NDArray[np.int32]


class Batched:
    """C of a stand with its batches, built by a compiler with flags."""

    def __init__(
        self, name: str, real: str = "double", compiler: str = "gcc", flags: tuple[str, ...] = ("-O0",)
    ) -> None:
        example = stand(name)
        made = generate_all(example, real)
        self.layout, self.name = made.layout, name
        self.batches = [
            batch
            for batch in batches(made.program).batches
            if (not batch.own_table or batch.narrow.name.startswith("inverse"))
            and "mounting" not in {a.name for a in batch.narrow.arguments}
        ]
        self.real: type[np.floating[Any]] = np.float32 if real == "float" else np.float64
        if made.layout.flywheels:
            self.options = hard_options(made, np.dtype(self.real))
        with TemporaryDirectory() as folder:
            place = Path(folder)
            write({**made.files, **batch_files(example, made)}, place)
            command = [compiler, *FIRMWARE_WARNINGS, "-ffp-contract=off", "-fPIC", f"-D{name.upper()}_PLAIN_NAMES"]
            base = [f for f in flags if "native" not in f]  # gcc 12 fuses in the functions for one state
            for source, options in ((name, base), (f"{name}_batch", flags)):
                made_object = str(place / f"{source}.o")
                subprocess.run([*command, *options, "-c", str(place / f"{source}.c"), "-o", made_object], check=True)
            objects = [str(place / f"{name}.o"), str(place / f"{name}_batch.o")]
            subprocess.run([compiler, *flags, "-shared", *objects, "-o", str(place / "batch.so")], check=True)
            self._library = ctypes.CDLL(str(place / "batch.so"))
        self.table = ctypes.byref(ctypes.c_char.in_dll(self._library, f"{name}_default"))

    def inputs(self, rng: np.random.Generator, n: int) -> Arrays:
        """Inputs of n ordinary states by name, arrays of (components, n)."""
        layout, count = self.layout, int(self.layout.count) if self.layout.flywheels else 0
        attitude = rng.normal(size=(4, n))
        rows = [rng.normal(size=(3, n)) * 0.1, attitude / np.linalg.norm(attitude, axis=0), rng.normal(size=(6, n))]
        rows += [rng.uniform(-3, 3, (count, n)), rng.normal(size=(count, n)) * 100]
        inputs = {"x": np.vstack(rows), "phi_ddot": rng.normal(size=(count, n)) * 300, "V_dot": rng.normal(size=(6, n))}
        inputs |= {"tau": rng.normal(size=(count, n)), "wrench": rng.normal(size=(6 * len(layout.inputs), n))}
        inputs["demand"] = inputs["V_dot"]  # of a task the first rows
        inputs["V_dot"][:, ::5] = 0  # nothing is demanded
        return {name: np.ascontiguousarray(values, dtype=self.real) for name, values in inputs.items()}

    def one(self, batch: Batch, inputs: Arrays, j: int) -> tuple[int, Arrays]:
        """Status and results of the function for one state, of state j."""
        columns = {name: np.ascontiguousarray(values[:, j]) for name, values in inputs.items()}
        status, results = self._called(batch.narrow.name, batch, columns, 1, None)
        return status, {name: values[:, 0] for name, values in results.items()}

    def many(self, batch: Batch, inputs: Arrays, n: int) -> tuple[int, Numbers, Arrays]:
        """Return value of a batch, statuses (n) and results, arrays of (components, n)."""
        statuses = np.full(n, 99, dtype=np.int32)
        form = "batch_of" if batch.own_table else "batch"
        returned, results = self._called(f"{batch.narrow.name}_{form}", batch, inputs, n, statuses)
        return returned, statuses, results

    def function(self, name: str) -> Callable[..., int]:
        """A function of the stand by its name without the prefix."""
        function: Callable[..., int] = getattr(self._library, f"{self.name}_{name}")
        return function

    def _tables(self, n: int) -> ctypes.c_void_p:
        """Tables of n stands, all of them the default."""
        size = record(members(self.layout.table), np.dtype(self.real)).itemsize
        tables = np.frombuffer(ctypes.string_at(self.table, size) * n, dtype=np.uint8)
        memory = np.zeros(64 + (n + 64) * size * 2, dtype=np.uint8)  # padding included
        self._kept = memory  # while the C reads it
        place = ctypes.c_void_p(-(-memory.ctypes.data // 64) * 64)
        assert self.function("tables")(tables.ctypes.data_as(ctypes.c_void_p), ctypes.c_size_t(n), place) == 0
        return place

    def _called(self, name: str, batch: Batch, inputs: Arrays, n: int, statuses: Numbers | None) -> tuple[int, Arrays]:
        passed: list[Any] = []
        results: Arrays = {}
        records: dict[str, NDArray[Any]] = {}
        for a in batch.narrow.arguments:
            if a.name == "next" and statuses is None:
                passed.append(None)  # no carry
            if a.name == "table" and batch.own_table and statuses is not None:
                passed.append(self._tables(n))
            elif a.name == "table":
                passed.append(self.table)
            elif a.name == "options":
                passed.append(ctypes.c_char_p(self.options.tobytes()))
            elif a.name == "locked":
                passed.append(locks(len(inputs["tau"])).ctypes.data_as(ctypes.c_void_p))
            elif a.name in OPTIONS:
                number = OPTIONS[a.name]
                real = ctypes.c_float if self.real is np.float32 else ctypes.c_double
                passed.append(ctypes.c_int(int(number)) if a.type is Kind.INT else real(number))
            elif a.direction == "in":
                passed.append(inputs[a.name].ctypes.data_as(ctypes.c_void_p))
            elif isinstance(a.type, Struct) and not a.shape and statuses is None:
                records[a.name] = np.full(1, UNTOUCHED, dtype=record(members(a.type), np.dtype(self.real)))
                passed.append(records[a.name].ctypes.data_as(ctypes.c_void_p))
            else:
                rows = int(a.shape[0]) if a.shape else 1
                rows *= _reals(a.type) if isinstance(a.type, Struct) else 1
                results[a.name] = np.full((rows, n), UNTOUCHED, dtype=self.real)
                passed.append(results[a.name].ctypes.data_as(ctypes.c_void_p))
        if statuses is not None:
            passed.insert(1, ctypes.c_size_t(n))
            passed.append(statuses.ctypes.data_as(ctypes.c_void_p))
        status = self.function(name)(*passed)
        for argument, one in records.items():
            numbers = structured_to_unstructured(one, dtype=self.real)
            results[argument] = numbers.reshape(-1, 1)
        return status, results


def hard_options(made: Generated, real: np.dtype[Any]) -> NDArray[Any]:
    """Options of `inverse` in which flywheels meet their limits and lack torque, rows are damped and one is free."""
    of = members(made.layout.inverse_options)
    assert made.values.options is not None
    options = fill_record(of, real, made.values.options)
    options["limit"] = 2.0 ** np.arange(options["limit"].size)
    options["weight"] = 3.0 ** -np.arange(options["weight"].size)
    options["motor_torque"] = 0.1
    options["near_singular"], options["damping"] = 0.2, 0.1
    for member in of:
        if member.name.startswith("use_"):
            options[member.name][0, 1:2] = 0
    return options


def locks(flywheels: int) -> Numbers:
    """Locks of which the second flywheel's alone is on."""
    return np.array([int(s == 1) for s in range(flywheels)] or [0], dtype=np.int32)


def _reals(struct: Struct) -> int:
    total = 0
    for f in struct.fields:
        size = _reals(f.type) if isinstance(f.type, Struct) else 1
        for length in f.shape:
            size *= int(length)
        total += size
    return total
