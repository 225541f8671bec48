"""A stand's program as a backend: the generated C, printed, compiled, loaded and called; beside it the interpreter."""

from __future__ import annotations

import math
import tempfile
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import replace
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from mahovik.contract.functions import FUNCTIONS, TASK_TAKERS, WANTS
from mahovik.contract.status import refusal_reason, status_words
from mahovik.core.emit.generate import PRECISIONS, Generated, generate_all, host_lanes
from mahovik.core.emit.manifest import NAME as MANIFEST
from mahovik.core.emit.reading import Header, read_header
from mahovik.core.lower.layout import Layout
from mahovik.core.lower.test_inputs import first_of
from mahovik.core.program.function import Program
from mahovik.core.program.interpret import Interpreter
from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.core.toolchain.library import Library
from mahovik.errors import CheckError, StateError, UsageError
from mahovik.proof.verify.delivery import delivered_only
from mahovik.proof.verify.folder_stand import declared_functions

NEAR_SINGULAR_BELOW = 1e-6
"""`NEAR_SINGULAR` in eval: smallest kept singular value below this part of the first (stand.md)."""


Runner = Callable[[str, Mapping[str, Any]], tuple[int, dict[str, Any]]]
"""Calls a function of the program by name with plain inputs; returns its status and outputs."""


class ProgramBackend:
    """Answers of a program, run as compiled C or by the interpreter.

    `table`, `mounting`: the prepared stand as the functions take it; no mounting without flywheels. `options`: of
    `inverse`, by the stand file.
    """

    def __init__(
        self, name: str, layout: Layout, program: Program, table: Any, mounting: Any, run: Runner, options: Any = None
    ) -> None:
        self.name = name
        self.mounting = mounting
        self.layout = layout
        self.program = program
        self._table = table
        self._run = run
        self._options = options or {}

    @property
    def wants(self) -> tuple[str, ...]:
        """Wants that the program answers: no `points` on a stand without points, none whose function is left out."""
        return self.wants_of(self.program)

    def wants_of(self, program: Program) -> tuple[str, ...]:
        """Wants that the public functions of a program of this stand answer."""
        public = public_names(program)
        by = {want: want for want in WANTS} | ({} if self.layout.flywheels else {"coupled": "forward"})
        return tuple(want for want, function in by.items() if function in public and self._has_parts(function))

    def _has_parts(self, function: str) -> bool:
        """Whether the stand has what a function needs."""
        needs = FUNCTIONS[function].needs
        return not needs or bool(getattr(self.layout, needs))

    @property
    def inputs(self) -> tuple[str, ...]:
        """Bodies on which the program takes a run-time wrench."""
        return self.layout.inputs

    def evaluate(self, state: State, want: Sequence[str]) -> dict[str, Any]:
        """Results by the names of stand.md. Raises StateError."""
        for name in want:
            if name not in WANTS:
                raise StateError(f'want: unknown "{name}", expected one of {", ".join(WANTS)}')
        missing = [body for body in state.wrench if body not in self.inputs]
        if missing:
            raise StateError(f'wrench: the C takes none on "{missing[0]}": set `wrench_input = true` in the stand file')
        inputs = self.arguments(state)
        results: dict[str, Any] = {}
        moved = inputs
        if state.task:
            found = self._inverse_task(state, inputs)
            moved = {**inputs, "V_dot": found["V_dot"], "phi_ddot": found["phi_ddot"]}
        if any(law.invalid for law in self.layout.law_tables):
            self._call("wrench", inputs)  # a state where a law is undefined has no answer to any want
        for name in want:
            if state.task and name == "inverse":
                results |= found
            else:
                results |= self.answer(name, state, moved if name in TASK_TAKERS else inputs)
        return results

    def answer(self, want: str, state: State, inputs: Mapping[str, Any]) -> dict[str, Any]:
        """Results of one want, for arguments by name. Raises StateError."""
        shaped = getattr(self, f"_{want}", None)
        found: dict[str, Any] = shaped(state, inputs) if shaped else self._plain(want, inputs)
        return found

    def _plain(self, function: str, inputs: Mapping[str, Any]) -> dict[str, Any]:
        """Results of a function by name; those of a struct of results by its members."""
        outputs = self._call(function, inputs)
        found: dict[str, Any] = outputs.get("out", outputs)
        return found

    def arguments(self, state: State) -> dict[str, Any]:
        """A state as arguments of the program's functions, by name."""
        if state.quaternion is not None:
            attitude: Any = state.quaternion
        elif state.angles is not None:
            attitude = self._call("quaternion", {"angles": state.angles})["attitude"]
        else:
            attitude = (1.0, 0.0, 0.0, 0.0)
        x = {"position": state.position, "attitude": attitude, "V": state.V}
        if self.layout.flywheels:
            x |= {"phi": state.phi, "phi_dot": state.phi_dot}
        zero = (0.0,) * 6
        wrench = [number for body in self.inputs for number in state.wrench.get(body, zero)]
        return {
            "table": self._table,
            "mounting": self.mounting,
            "x": x,
            "sine": [math.sin(phi) for phi in state.phi],
            "cosine": [math.cos(phi) for phi in state.phi],
            "V_dot": state.V_dot,
            "demand": state.demand,
            "phi_ddot": state.phi_ddot,
            "tau": state.tau,
            "locked": [0] * len(state.phi),
            "wrench": wrench,
            "options": {  # of `inverse`: by the stand file what each flywheel has, the rest by stand.md
                **self._options,
                "weight": [1.0] * len(state.phi),
                "limit": [self.layout.precision.largest] * len(state.phi),
                "near": NEAR_SINGULAR_BELOW,
                "damping": 0.0,
            },
        }

    def call(self, function: str, inputs: Mapping[str, Any]) -> tuple[int, dict[str, Any]]:
        """Calls one function with those of the inputs that it takes; returns status and outputs."""
        wanted = [a for a in self.program.function(function).arguments if a.direction != "out" and a.name in inputs]
        return self._run(function, {a.name: first_of(a, inputs[a.name]) for a in wanted})

    def _call(self, function: str, inputs: Mapping[str, Any]) -> dict[str, Any]:
        status, outputs = self.call(function, inputs)
        self._refuse(status)
        return outputs

    def _refuse(self, status: int) -> None:
        """Raises StateError for a negative status."""
        if status < 0:
            name = status_words(status)
            raise StateError(f"{name}: {refusal_reason(name, 'refused')}")

    def _matrices(self, state: State, inputs: Mapping[str, Any]) -> dict[str, Any]:
        found = self._plain("matrices", inputs)
        if not self.layout.flywheels:
            found |= {"I": [[] for _ in range(6)], "J": [[] for _ in range(6)]}
        return found

    def _generalized(self, state: State, inputs: Mapping[str, Any]) -> dict[str, Any]:
        if state.quaternion is not None:
            raise StateError("generalized: needs angles, not a quaternion")
        angles = state.angles or (0.0, 0.0, 0.0)
        found: dict[str, Any] = self._call("generalized", {**inputs, "angles": angles})["out"]
        return found

    def _torque(self, state: State, inputs: Mapping[str, Any]) -> dict[str, Any]:
        return self._call("torque", inputs) if self.layout.flywheels else {"tau": []}

    def _mounts(self, state: State, inputs: Mapping[str, Any]) -> dict[str, Any]:
        if not self.layout.flywheels:
            return {"mount_wrench": np.zeros((0, 6))}
        flat = self._call("mounts", inputs)["mount_wrench"]
        return {"mount_wrench": [flat[i : i + 6] for i in range(0, len(flat), 6)]}

    def _coupled(self, state: State, inputs: Mapping[str, Any]) -> dict[str, Any]:
        if not self.layout.flywheels:
            return {**self._call("forward", inputs), "phi_ddot": []}
        return self._call("coupled", inputs)

    def _inverse(self, state: State, inputs: Mapping[str, Any]) -> dict[str, Any]:
        status, outputs = self.call("inverse", inputs)
        self._refuse(status)
        found = {"phi_ddot": [], "sigma": []} | outputs["out"]
        result = {name: found[name] for name in ("phi_ddot", "residual", "sigma", "rank")}
        return result | {"status": status_words(status)}

    def _inverse_task(self, state: State, inputs: Mapping[str, Any]) -> dict[str, Any]:
        """The answer of the task of a state. Raises StateError."""
        rows = {task.name: len(task.rows) for task in self.layout.structure.tasks}
        if rows.get(state.task) != len(state.demand):
            raise StateError(f"demand: expected {rows.get(state.task, 0)} numbers, found {len(state.demand)}")
        status, outputs = self.call(f"inverse_{state.task}", inputs)
        self._refuse(status)
        found = {name: outputs["out"][name] for name in ("phi_ddot", "V_dot", "residual", "sigma", "rank")}
        return found | {"status": status_words(status)}

    def _points(self, state: State, inputs: Mapping[str, Any]) -> dict[str, Any]:
        if not self.layout.sensors:
            return {"points": {}}
        readings = self._call("points", inputs)["out"]
        return {"points": dict(zip(self.layout.sensors, readings, strict=True))}


def public_names(program: Program) -> tuple[str, ...]:
    """Names of the public functions of a program, in its order."""
    return tuple(f.name for f in program.functions if f.public)


def with_all_inputs(stand: Stand) -> Stand:
    """The stand with a run-time wrench on every body."""
    return replace(
        stand,
        carrier=replace(stand.carrier, wrench_input=True),
        instruments=tuple(replace(p, wrench_input=True) for p in stand.instruments),
        flywheels=tuple(replace(s, wrench_input=True) for s in stand.flywheels),
    )


class InterpreterBackend(ProgramBackend):
    """A stand's program run by the interpreter."""

    def __init__(self, generated: Generated) -> None:
        interpreter, values = Interpreter(generated.program), generated.values
        stand = prepare_records(interpreter, generated.layout, values.table, values.mounting)
        super().__init__("interpreter", generated.layout, generated.program, *stand, interpreter.run, values.options)


def prepare_records(interpreter: Interpreter, layout: Layout, table: Any, mounting: Any) -> tuple[Any, Any]:
    """Table and mounting as records, which the interpreter takes as they are: made once, for every call."""
    records = None if mounting is None else interpreter.filled(layout.mount_table, mounting)
    return interpreter.filled(layout.table, table), records


class CBackend(ProgramBackend):
    """Compiled C of a stand: freshly generated, or <name>.h and <name>.c of `folder`.

    `lanes`: None means those of the C in the folder; without a folder 1, or what suits the host if it is `fast`. C of a
    folder is compiled for speed if its header asks for it. `generated`: the result of `generate_all` with these
    options, if the caller has it. `pool`: threads in which `full` is generated and compiled at once, for a caller who
    will want it.
    A state with a run-time wrench that the C does not take is evaluated by the C of the same stand with an input
    on every body; with `folder` it is an error of that state.
    C of `generate --only` in `folder` answers the wants of its functions. Functions that it lacks and that a judge
    needs beside the judged one are run by the interpreter of `complete`, which is the program with all functions.
    Raises ToolchainError (no compiler, a warning), UsageError (no such files), CheckError (of another stand).
    """

    def __init__(
        self,
        stand: Stand,
        precision_name: str = "double",
        folder: Path | None = None,
        lanes: int | None = None,
        fast: bool = False,
        generated: Generated | None = None,
        pool: ThreadPoolExecutor | None = None,
    ) -> None:
        self._stand, self._precision_name, self._folder = stand, precision_name, folder
        says_fast = fast
        if folder is not None:
            header = _check_folder(folder, stand, precision_name, lanes)
            lanes, says_fast = header.lanes, header.fast
        elif lanes is None:
            lanes = host_lanes(len(stand.flywheels)) if fast else 1
        self.fast = fast or says_fast
        self.complete = self.generated = generated or generate_all(stand, precision_name, lanes, says_fast)
        if folder is not None and (only := _part(folder, stand, self.complete.program)):
            self.generated = generate_all(stand, precision_name, lanes, says_fast, only)
        self._full: Future[CBackend] | None = None if pool is None else pool.submit(self._made_full)
        # once loaded, the library needs its file no more
        with tempfile.TemporaryDirectory(prefix="mahovik-", ignore_cleanup_errors=True) as scratch:
            place = folder if folder is not None else _write_files(self.generated.files, Path(scratch))
            paths = place / f"{stand.name}.h", place / f"{stand.name}.c"
            self.library = Library(*paths, Path(scratch), stand.name, self.fast)
        program = self.generated.program

        def run(function: str, inputs: Mapping[str, Any]) -> tuple[int, dict[str, Any]]:
            return self.library.run(program.function(function), inputs)

        table = self.library.default("default")
        mounting = None
        if "prepare_mounts" in public_names(program):
            given = {"parameters": self.library.default("default_parameters")}
            mounting = run("prepare_mounts", given)[1]["mounting"]
        super().__init__("c", self.generated.layout, program, table, mounting, run, self.generated.values.options)

    @cached_property
    def interpreter(self) -> InterpreterBackend:
        """The interpreter of the program with all functions."""
        return InterpreterBackend(self.complete)

    @cached_property
    def left_out(self) -> tuple[str, ...]:
        """Public functions of the stand that the C in the folder lacks."""
        there = public_names(self.program)
        return tuple(name for name in public_names(self.complete.program) if name not in there)

    def call(self, function: str, inputs: Mapping[str, Any]) -> tuple[int, dict[str, Any]]:
        """Calls the C, or the interpreter for a function that the C lacks: with its own table for the compiled one."""
        if function not in self.left_out:
            return super().call(function, inputs)
        own = self.interpreter
        given = dict(inputs)
        if isinstance(given.get("table"), self.library.ffi.CData):
            given["table"] = own._table
        if given.get("mounting") is None:
            given["mounting"] = own.mounting
        return own.call(function, given)

    @cached_property
    def full(self) -> CBackend:
        """The C of the same stand with a run-time wrench on every body."""
        return self._made_full() if self._full is None else self._full.result()

    def _made_full(self) -> CBackend:
        stand = with_all_inputs(self._stand)
        if stand == self._stand:
            return self
        return CBackend(stand, self._precision_name, lanes=self.generated.layout.lanes, fast=self.fast)

    def evaluate(self, state: State, want: Sequence[str]) -> dict[str, Any]:
        """Results by the names of stand.md. Raises StateError."""
        if self._folder is None and any(body not in self.inputs for body in state.wrench):
            return super(CBackend, self.full).evaluate(state, want)
        return super().evaluate(state, want)

    def interpreter_evaluate(self, state: State, want: Sequence[str]) -> dict[str, Any]:
        """The same results by the interpreter, whose bits must be equal."""
        if any(body not in self.inputs for body in state.wrench):
            return self.full.interpreter.evaluate(state, want)
        return self.interpreter.evaluate(state, want)

    def table(self) -> Any:
        """The compiled default table as plain data."""
        return self.library.value(self.complete.program.function("forward"), "table")


def _write_files(files: Mapping[str, str], scratch: Path) -> Path:
    for name, text in files.items():
        (scratch / name).write_text(text, encoding="ascii", newline="\n")
    return scratch


def _part(folder: Path, stand: Stand, program: Program) -> tuple[str, ...]:
    """The functions that C of `generate --only` in a folder has, by its manifest or header; empty: all of `program`.

    Raises CheckError where the header lacks some that the manifest promises.
    """
    public, declared = public_names(program), declared_functions(folder, stand.name)
    there = tuple(name for name in public if name in declared)
    if not (folder / MANIFEST).is_file():
        return there if there != public else ()
    only = delivered_only(folder)
    if missing := [name for name in only or public if name not in there]:
        path = folder / f"{stand.name}.h"
        raise CheckError(f"{path}: declares no function {', '.join(missing)}, expected by {MANIFEST}: generate again")
    return only


def _check_folder(folder: Path, stand: Stand, real: str, lanes: int | None) -> Header:
    """The header of the C in the folder. Raises UsageError; CheckError: other C."""
    path = folder / f"{stand.name}.h"
    header = read_header(folder, stand.name)
    if header is None or not path.with_suffix(".c").is_file():
        missing = path if header is None else path.with_suffix(".c")
        raise UsageError(f"{missing}: no such file; --against wants the folder with {stand.name}.h and {stand.name}.c")
    expected = identities(stand)
    for kind in ("structure", "physics"):
        have, want = getattr(header, kind), getattr(expected, kind)
        if have != want:
            raise CheckError(
                f"{path}: its {kind} is {have or 'none'}, that of the stand file {want}: generate it again"
            )
    if header.real != real:
        remedy = f"give --real {header.real}" if header.real in PRECISIONS else "generate it again"
        raise UsageError(f"{path}: its C is {header.real or 'of no known element type'}, expected {real}: {remedy}")
    if lanes is not None and header.lanes != lanes:
        raise UsageError(f"{path}: its C has lanes {header.lanes}, expected {lanes}: leave --lanes out")
    return header
