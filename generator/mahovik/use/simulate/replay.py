"""Replay of a flight log: the same steps on this machine, every state compared bit for bit, and shown."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from mahovik.contract.functions import ALL
from mahovik.contract.status import status_words
from mahovik.core.emit.generate import Generated, generate_all
from mahovik.core.emit.log_format import state_hash, table_bytes, table_from_bytes
from mahovik.core.emit.manifest import read_header
from mahovik.core.emit.recorder import source_hash
from mahovik.core.lower.golden import fnv1a
from mahovik.core.stand.model import Stand
from mahovik.core.stand.structure import identities
from mahovik.errors import CheckError, StateError, UsageError
from mahovik.proof.verify.c_backend import CBackend, InterpreterBackend
from mahovik.proof.verify.states import encode
from mahovik.use.simulate.flight_log import Damage, Reals, Start, Step

Members = dict[str, Reals]


@dataclass(frozen=True)
class Outcome:
    """One step on this machine. `before` is the state with everything written to it; `table` None: the default.

    `carry`, `carry_after`: what rounding took from the state, before and after the step.
    """

    step: Step
    before: Members
    after: Members
    status: int
    equal: bool
    table: Mapping[str, Any] | None
    carry: Reals
    carry_after: Reals

    @property
    def difference(self) -> str:
        """How the step differs from the log."""
        if self.status != self.step.status:
            return f"status {status_words(self.step.status)} in the log, {status_words(self.status)} here"
        computed = _hash(self.after, self.carry_after, self.step)
        return f"the state after it has hash {self.step.hash:08x} in the log, {computed:08x} here"


class Machine:
    """Runs the steps of one stand by its C or by the interpreter, from the present `state` with the present `carry`.

    source   hash of the C source
    """

    def __init__(self, backend: CBackend | InterpreterBackend, source: int) -> None:
        self._backend, self.generated, self.source = backend, backend.generated, source
        self._dtype = np.dtype(self.generated.program.precision.scalar)
        self._table: Any = None
        self.state: Members = {}
        self.carry = np.zeros(sum(int(f.shape[0]) for f in self.generated.layout.state.fields), dtype=self._dtype)

    def begin(self, state: Mapping[str, Reals], table: Mapping[str, Any] | None) -> None:
        """Set a state and a table; None: the default."""
        self.set_table(self.default_table() if table is None else table)
        self.state, self.carry = {**state}, np.zeros_like(self.carry)

    def set_table(self, table: Mapping[str, Any]) -> None:
        """Set the table from plain data."""
        self._table = self._backend.hold_table(table)

    def step(self, step: Step) -> int:
        """Run one step; return its status. A refused one leaves the state."""
        name, arrays = step_inputs(self.generated, step)
        inputs = {key: value.tolist() if isinstance(value, np.ndarray) else value for key, value in arrays.items()}
        inputs["table"], inputs["dt"] = self._table, self._dtype.type(step.dt).item()
        inputs["x"] = {name: values.tolist() for name, values in self.state.items()}
        if step.carried:
            inputs["carry"] = {"rounding": self.carry.tolist()}
        status, outputs = self._backend.call(name, inputs)
        if status >= 0:
            self.state = {name: np.array(values, dtype=self._dtype) for name, values in outputs["next"].items()}
        if status >= 0 and step.carried:
            self.carry = np.array(outputs["carry"]["rounding"], dtype=self._dtype)
        return status

    def default_table(self) -> Mapping[str, Any]:
        """The default table as plain data."""
        table: Mapping[str, Any] = self._backend.table()
        return table


@lru_cache(maxsize=4)
def _compiled_backend(stand: Stand, real: str) -> CBackend:
    """The compiled C of a stand; the last few are cached, so that many logs of one stand compile once."""
    return CBackend(stand, real)


def c_machine(stand: Stand, real: str, folder: Path | None = None) -> Machine:
    """A machine that runs the C of a stand, freshly generated or in `folder`. Raises as CBackend."""
    backend = _compiled_backend(stand, real) if folder is None else CBackend(stand, real, folder)
    files = backend.generated.files if folder is None else _texts(folder, stand.name)
    return Machine(backend, source_hash(files, stand.name))


def interpreter_machine(stand: Stand, real: str) -> Machine:
    """A machine that interprets the program: it needs no compiler, and is a thousand times slower."""
    generated = generate_all(stand, real)
    return Machine(InterpreterBackend(generated), source_hash(generated.files, stand.name))


def step_inputs(generated: Generated, step: Step) -> tuple[str, dict[str, Any]]:
    """The function that made the step, and its inputs by argument name."""
    drive = "phi_ddot" if step.driven else "tau"
    locked = np.array(step.locked, dtype=np.intc)
    inputs = {drive: step.drive, "locked": locked, "wrench": step.wrench, "dt": step.dt, "order": step.order}
    taken = {a.name for a in generated.program.function(step.function).arguments}
    return step.function, {key: value for key, value in inputs.items() if key in taken}


def replay(machine: Machine, records: Iterable[Start | Step | Damage]) -> Iterator[Outcome | Damage]:
    """Every step that can be replayed, up to the first that differs, and the damage between steps."""
    table: Mapping[str, Any] | None = None
    for record in records:
        if isinstance(record, Damage):
            yield record
            continue
        if isinstance(record, Start):
            table = _table(machine, record)
            machine.begin(record.state, table)
            continue
        machine.state = machine.state | dict(record.written)
        if record.carry is not None:
            machine.carry = record.carry
        if record.stream is not None:
            table = {**(table or machine.default_table()), "stream": record.stream.tolist()}
            machine.set_table(table)
        before, carry = machine.state, machine.carry
        status = machine.step(record)
        equal = status == record.status and _hash(machine.state, machine.carry, record) == record.hash
        yield Outcome(record, before, machine.state, status, equal, table, carry, machine.carry)
        if not equal:
            return


def _hash(state: Members, carry: Reals, step: Step) -> int:
    """Hash of a state, with its carry if the step has one, as the log of a step has it."""
    numbers = [*state.values(), carry] if step.carried else list(state.values())
    return state_hash([number.tobytes() for number in numbers])


def _table(machine: Machine, start: Start) -> Mapping[str, Any] | None:
    """The table of the log; None for the default. Raises CheckError."""
    layout, default = machine.generated.layout, machine.default_table()
    packed = table_bytes(layout, default)
    if start.table:
        if len(start.table) != len(packed):
            raise CheckError(f"the log's table has {len(start.table)} bytes, that of the stand {len(packed)}")
        return table_from_bytes(layout, start.table, default)
    computed = fnv1a(packed)
    if start.table_hash != computed:
        raise CheckError(
            f"the log's default table has hash {start.table_hash:08x}, that of the C here {computed:08x}: "
            "that C comes from another version of mahovik; give its folder with --against DIR"
        )
    return None


def check_stand(stand: Stand, start: Start, source: str) -> None:
    """Check that the log is of this stand. `source` is the stand file. Raises CheckError."""
    hashes = identities(stand)
    if start.stand != stand.name:
        raise CheckError(f'{source}: stand "{stand.name}", but the log is from "{start.stand}"')
    for kind, log, expected in (
        ("structure", start.structure, hashes.structure),
        ("physics", start.physics, hashes.physics),
    ):
        if log != expected:
            raise CheckError(f"{source}: {kind} {expected}, but the log is from {log}: give the stand file that flew")


def explain(machine: Machine, stand: Stand, start: Start) -> str:
    """A possible reason for a difference: the C that flew is neither that of the machine nor the default nor all."""
    delivered = {source_hash(generate_all(stand, start.real, only).files, stand.name) for only in ((), ALL)}
    if start.source not in {machine.source, *delivered}:
        return (
            f"the C that flew was another source text (source {start.source:08x}, here {machine.source:08x}): "
            "give its folder with --against DIR"
        )
    return "the source text is the same: was it compiled with -ffp-contract=off and without -ffast-math?"


def _texts(folder: Path, name: str) -> dict[str, str]:
    """Header and source of a stand in a folder."""
    return {f"{name}.{kind}": (folder / f"{name}.{kind}").read_text(encoding="utf-8") for kind in ("h", "c")}


def machine(stand: Stand, real: str, backend: str, folder: Path | None) -> Machine:
    """The machine that replays: "c" or "interpreter". UsageError, ToolchainError, CheckError."""
    if backend == "c":
        there = None if folder is None else read_header(folder, stand.name)
        if there is not None and there.real is not None and there.real != real:
            raise UsageError(f"against {folder}: its C is {there.real}, the log {real}: give the folder that flew")
        return c_machine(stand, real, folder)
    if folder is not None:
        raise UsageError("against: the interpreter runs no C; leave it out, or use --backend c")
    return interpreter_machine(stand, real)


def state_object(outcome: Outcome, wrenches: Sequence[str]) -> dict[str, Any]:
    """The keys of that line; zeros are left out."""
    step, before = outcome.step, outcome.before
    result: dict[str, Any] = {"id": f"step {step.count}", "quaternion": _plain(before["attitude"])}
    drive = "phi_ddot" if step.driven else "tau"
    members = {name: before[name] for name in before if name != "attitude"} | {drive: step.drive}
    result |= {name: _plain(values) for name, values in members.items() if np.any(values)}
    pushed = {body: _plain(step.wrench[6 * i : 6 * i + 6]) for i, body in enumerate(wrenches)}
    if any(any(six) for six in pushed.values()):
        result["wrench"] = {body: six for body, six in pushed.items() if any(six)}
    return result | {"want": ["forward" if step.driven or not len(step.drive) else "coupled"]}


def step_dump(outcome: Outcome, wrenches: Sequence[str]) -> Iterator[str]:
    """Lines that show one step: its line of `eval`, then all of it in hexadecimal."""
    step = outcome.step
    try:
        yield encode(state_object(outcome, wrenches))
    except StateError as error:
        yield json.dumps({"id": f"step {step.count}", "error": str(error)})
    yield f"step {step.count}, {step.function}: {status_words(outcome.status)}"
    yield f"dt {float(step.dt).hex()} order {step.order}"
    inputs: Mapping[str, Any] = {"phi_ddot" if step.driven else "tau": step.drive, "wrench": step.wrench}
    for name, values in inputs.items():
        if len(values):
            yield _hexadecimal(name, values)
    if any(step.locked):
        yield f"locked {' '.join(map(str, step.locked))}"
    if outcome.table is not None:
        yield "table: that of the log, not the default"
    for title, state in (("before", outcome.before), ("after", outcome.after)):
        for name, values in state.items():
            yield _hexadecimal(f"{title} {name}", values)
    if step.carried:
        yield _hexadecimal("before carry", outcome.carry)
        yield _hexadecimal("after carry", outcome.carry_after)


def _hexadecimal(name: str, values: Any) -> str:
    return f"{name} {' '.join(float(v).hex() for v in values)}"


def _plain(values: Any) -> list[float]:
    return [float(v) for v in values]
