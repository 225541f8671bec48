"""Flight logs of the emitted recorder, and their replay: the same steps here, compared bit for bit, and shown.

The format stands in the header of the recorder (templates/recorder.h.j2). Damage is found and reported, never guessed
around.
"""

from __future__ import annotations

import json
import struct
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mahovik.contract.functions import ALL
from mahovik.contract.status import status_words
from mahovik.core.emit.generate import Generated, generate_all
from mahovik.core.emit.log_format import CHANGING, FORMAT, MAGIC, STEP, state_hash, table_bytes, table_from_bytes
from mahovik.core.emit.manifest import read_header
from mahovik.core.emit.recorder import source_hash
from mahovik.core.lower.golden import fnv1a
from mahovik.core.stand.files import FLIGHT, content
from mahovik.core.stand.model import Stand
from mahovik.core.stand.structure import identities
from mahovik.errors import CheckError, StateError, UsageError
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.states import encode

Reals = NDArray[np.floating[Any]]

FLAGS = {name: bit for name, (bit, _) in CHANGING.items()}


@dataclass(frozen=True)
class Start:
    """A start record: identity of the log's stand, its element type, and the state before step `count`."""

    offset: int
    stand: str
    real: str
    structure: str
    physics: str
    source: int
    flywheels: int
    wrenches: int
    table_hash: int
    count: int
    state: Mapping[str, Reals]
    table: bytes


@dataclass(frozen=True)
class Step:
    """The record of one step: all inputs and the result.

    `written` are members of the state set since the previous step; `drive` is tau, or phi_ddot if `driven`; `hash` is
    of the state after the step. `carried`: the step keeps what rounding takes, and `hash` is of its carry as well;
    `carry`: the carry before it, None where it is as it was left.
    """

    offset: int
    count: int
    written: Mapping[str, Reals]
    dt: float
    order: int
    drive: Reals
    driven: bool
    locked: tuple[int, ...]
    wrench: Reals
    stream: Reals | None
    carry: Reals | None
    carried: bool
    status: int
    hash: int

    @property
    def function(self) -> str:
        """Name of the function of the C that made it."""
        return "step_driven" if self.driven else "step"


@dataclass(frozen=True)
class Damage:
    """A place where the log cannot be read: the steps up to the next start are lost. `end`: the log stops there."""

    message: str
    end: bool = False


def load(path: Path) -> tuple[bytes, list[str]]:
    """The bytes of a log file, binary or as text from a serial console, and a note for each spoiled line.

    In text, lines that begin with `@` hold hexadecimal digits, and all other lines are unrelated output.
    Raises UsageError.
    """
    try:
        data = content(path, FLIGHT)
    except OSError as error:
        raise UsageError(f"{path}: cannot be read: {error.strerror or error}") from None
    notes: list[str] = []
    if MAGIC not in data and any(line.startswith(b"@") for line in data.splitlines()):
        data = _from_hex(data, notes)
    if MAGIC not in data:
        why = f"no log in its @ lines, {len(notes)} damaged: {notes[0]}" if notes else _no_log(data)
        raise UsageError(f"{path}: {why}")
    return data, [f"{path}: {note}" for note in notes]


def _from_hex(data: bytes, notes: list[str]) -> bytes:
    content = bytearray()
    for number, line in enumerate(data.splitlines(), 1):
        if not line.startswith(b"@"):
            continue
        try:
            content += bytes.fromhex(line[1:].decode("ascii").strip())
        except ValueError:
            notes.append(f"line {number}: expected an even number of hexadecimal digits after @; the line is left out")
    return bytes(content)


def _no_log(data: bytes) -> str:
    """Why bytes without a start record are not a log."""
    for width in (2, 4, 8):
        swapped = b"".join(MAGIC[i : i + width][::-1] for i in range(0, 8, width))
        if swapped in data:
            return f"its bytes are swapped in words of {width}: the log was moved as words by a big-endian machine"
    for name, mangled in (
        ("\\r\\n became \\n", MAGIC.replace(b"\r\n", b"\n")),
        ("\\n became \\r\\n", MAGIC.replace(b"\r\n", b"\r\r\n")),
        ("the eighth bit of every byte is lost", bytes(b & 0x7F for b in MAGIC)),
    ):
        if mangled in data:
            return f"moved as text ({name}): transfer it as binary, or print it as @ lines of hexadecimal digits"
    if not data:
        return "is empty"
    return "no flight log: no start record in it (expected the bytes 89 4d 48 56 4b 0d 0a 1a, or lines @894d4856...)"


class _EndError(Exception):
    """The log ends inside a record."""


class _Bytes:
    """Reader of little-endian numbers from a position on."""

    def __init__(self, data: bytes, offset: int, real: str = "double") -> None:
        self._data = data
        self._begin = offset
        self.at = offset
        self.dtype = np.dtype("<f8" if real == "double" else "<f4")

    def take(self, count: int) -> bytes:
        if self.at + count > len(self._data):
            raise _EndError
        self.at += count
        return self._data[self.at - count : self.at]

    def number(self, kind: str) -> int:
        return int(struct.unpack(f"<{kind}", self.take(struct.calcsize(f"<{kind}")))[0])

    def reals(self, count: int) -> Reals:
        return np.frombuffer(self.take(count * self.dtype.itemsize), dtype=self.dtype)

    def check_matches(self) -> bool:
        """Whether the next bytes are the check of the record so far."""
        computed = fnv1a(self._data[self._begin : self.at])
        return self.number("I") == computed


def records(data: bytes) -> Iterator[Start | Step | Damage]:
    """Starts and steps in order, and places where something is missing or damaged."""
    reader = _Reader(data)
    first = data.find(MAGIC)
    if first > 0:
        yield Damage(
            f"{first} bytes before the first start record cannot be replayed: there is no initial state for them"
        )
    at: int | None = first if first >= 0 else None
    while at is not None and at < len(data):
        record, after = reader.record(at)
        yield record
        at = after if not isinstance(record, Damage) else reader.next_start(at + 1)


class _Reader:
    """Keeps what the records so far have set: identities, time step, the count of the next step."""

    def __init__(self, data: bytes) -> None:
        self._data = data
        self._start: Start | None = None
        self._next = 0
        self._dt = 0.0
        self._order = 0

    def next_start(self, at: int) -> int | None:
        result = self._data.find(MAGIC, at)
        return result if result >= 0 else None

    def record(self, at: int) -> tuple[Start | Step | Damage, int]:
        """The record at a position, and where the next one begins."""
        try:
            if self._data.startswith(MAGIC, at):
                return self._read_start(at)
            return self._read_step(at)
        except _EndError:
            if self._is_cut(at):
                return Damage(f"the log ends inside {self._where(at)}", end=True), len(self._data)
            return self._damage_at(at), at

    def _is_cut(self, at: int) -> bool:
        """Whether the log just ends inside a record; not if a whole one comes after it: then its length is wrong."""
        if self._data[at] not in (STEP, MAGIC[0]) or self.next_start(at + 1) is not None:
            return False
        place = self._data.find(bytes([STEP]), at + 1)
        while self._start is not None and place >= 0:
            try:
                if self._parse_step(place) is not None:
                    return False
            except _EndError:
                pass
            place = self._data.find(bytes([STEP]), place + 1)
        return True

    def _where(self, at: int) -> str:
        if self._data.startswith(MAGIC, at):
            return f"the start record at byte {at}"
        return f"the record of step {self._next} at byte {at}"

    def _damage_at(self, at: int) -> Damage:
        return Damage(f"{self._where(at)} is damaged: its check does not fit; {self._rest(at)}")

    def _rest(self, at: int) -> str:
        """Where the log can be replayed again."""
        after = self.next_start(at + 1)
        return "the log ends without another start" if after is None else f"the next start is at byte {after}"

    def _read_start(self, at: int) -> tuple[Start | Damage, int]:
        read = _Bytes(self._data, at)
        read.take(len(MAGIC))
        version, size = read.number("B"), read.number("B")
        if version != FORMAT:
            return Damage(f"the start record at byte {at} has format {version}, this mahovik reads {FORMAT}"), at
        if size not in (4, 8):
            return self._damage_at(at), at
        real = "double" if size == 8 else "float"
        read.dtype = np.dtype(f"<f{size}")
        name = read.take(read.number("B")).decode("ascii", "replace")
        structure, physics, source = (read.number("I") for _ in range(3))
        flywheels, wrenches = read.number("H"), read.number("H")
        table_hash, count = read.number("I"), read.number("I")
        state = {member: read.reals(n) for member, n in members(flywheels).items()}
        table = read.take(read.number("I"))
        if not read.check_matches():
            return self._damage_at(at), at
        self._start = Start(
            *(at, name, real, f"{structure:08x}", f"{physics:08x}", source, flywheels, wrenches),
            *(table_hash, count, state, table),
        )
        self._next = count
        return self._start, read.at

    def _read_step(self, at: int) -> tuple[Step | Damage, int]:
        steps = self._parse_step(at)
        if steps is None:
            return self._damage_at(at), at
        step, after = steps
        if step.count != self._next:
            return Damage(self._gap(step)), at
        self._next = (step.count + 1) % 2**32
        self._dt, self._order = step.dt, step.order
        return step, after

    def _gap(self, step: Step) -> str:
        """Message about what is missing before a step that is not the next one."""
        last = step.count - 1
        if step.count > self._next:
            lost = f"step {last}" if last == self._next else f"steps {self._next} to {last}"
            what = f"{lost} missing before byte {step.offset}: nothing to replay step {step.count} from"
        else:
            where = f"step {step.count} at byte {step.offset}"
            what = f"{where} comes where step {self._next} was expected: a start is missing"
        return f"{what}; {self._rest(step.offset)}"

    def _parse_step(self, at: int) -> tuple[Step, int] | None:
        """The record of a step and where the next one begins; None if its check does not fit. Raises _EndError."""
        start = self._start
        assert start is not None
        read = _Bytes(self._data, at, start.real)
        if read.number("B") != STEP:
            return None
        flags, count = read.number("H"), read.number("I")
        dt, order = self._dt, self._order
        if flags & FLAGS["SETTINGS"]:
            dt, order = float(read.reals(1)[0]), read.number("i")
        written = {}
        for place, (member, length) in enumerate(members(start.flywheels).items()):
            if flags & 1 << place:
                written[member] = read.reals(length)
        stream = read.reals(3) if flags & FLAGS["STREAM"] else None
        carry = read.reals(sum(members(start.flywheels).values())) if flags & FLAGS["CARRY"] else None
        drive = read.reals(start.flywheels)
        locked = (0,) * start.flywheels
        if flags & FLAGS["LOCKS"]:
            mask = int.from_bytes(read.take((start.flywheels + 7) // 8), "little")
            locked = tuple(mask >> s & 1 for s in range(start.flywheels))
        six = 6 * start.wrenches
        wrench = read.reals(six) if flags & FLAGS["WRENCH"] else np.zeros(six, dtype=read.dtype)
        status, after = read.number("b"), read.number("I")
        if not read.check_matches():
            return None
        driven, carried = (bool(flags & FLAGS[name]) for name in ("DRIVEN", "CARRIED"))
        return Step(
            *(at, count, written, dt, order, drive, driven, locked, wrench, stream, carry, carried),
            *(status, after),
        ), read.at


def members(flywheels: int) -> dict[str, int]:
    """Members of a state and their lengths, in their order."""
    result = {"position": 3, "attitude": 4, "V": 6}
    return result | {"phi": flywheels, "phi_dot": flywheels} if flywheels else result


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
    """Runs the steps of one stand by its C, from the present `state` with the present `carry`.

    source   hash of the C source
    """

    def __init__(self, backend: CBackend, source: int) -> None:
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
    """A machine that runs the C of a stand, freshly generated or in `folder`. Raises as CBackend; UsageError."""
    there = None if folder is None else read_header(folder, stand.name)
    if there is not None and there.real is not None and there.real != real:
        raise UsageError(f"against {folder}: its C is {there.real}, the log {real}: give the folder that flew")
    backend = _compiled_backend(stand, real) if folder is None else CBackend(stand, real, folder)
    files = backend.generated.files if folder is None else _texts(folder, stand.name)
    return Machine(backend, source_hash(files, stand.name))


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
            "that C comes from another version of mahovik; give its folder with against=DIR"
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
            "give its folder with against=DIR"
        )
    return "the source text is the same: was it compiled with -ffp-contract=off and without -ffast-math?"


def _texts(folder: Path, name: str) -> dict[str, str]:
    """Header and source of a stand in a folder."""
    return {f"{name}.{kind}": (folder / f"{name}.{kind}").read_text(encoding="utf-8") for kind in ("h", "c")}


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
