"""Comparison of any program that follows the `eval` contract: states are sent to it, its results are compared."""

from __future__ import annotations

import contextlib
import json
import os
import shlex
import signal
import subprocess
import threading
from collections import deque
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import IO, Any

import numpy as np

from mahovik.contract.functions import wants_of_carrier
from mahovik.core.stand.model import Stand
from mahovik.core.stand.random_state import random_state
from mahovik.core.stand.state import State
from mahovik.errors import CheckError, UsageError
from mahovik.proof.second import Second
from mahovik.proof.verify.actuators import actuators_of, with_drawn_actuators
from mahovik.proof.verify.bounds import DOUBLE, uniform
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.compare import Judge
from mahovik.proof.verify.draw import draw
from mahovik.proof.verify.harness import applicable, report
from mahovik.proof.verify.held import onto_hold
from mahovik.proof.verify.report import Report
from mahovik.proof.verify.states import LONGEST, Request, excerpt, state_line
from mahovik.proof.verify.torque_want import WANT as TORQUE_FOR
from mahovik.proof.verify.torque_want import TaskSetting, torque_requests, torque_rows

OPTIONAL = {"generalized": ("I0", "J0")}
"""Quantities that a program may leave out of a want that it offers: (10) and (11) do not need them."""


@dataclass(frozen=True)
class Program:
    """A program that reads states: its name in reports, the words of its command, and the wants that it may offer."""

    name: str
    words: tuple[str, ...]
    offers: tuple[str, ...] = ()
    """Wants that it may offer; none given: those that the carrier has."""
    optional: Mapping[str, tuple[str, ...]] = field(default_factory=lambda: OPTIONAL)
    """Quantities that it may leave out of a want that it offers."""
    on_hold: bool = False
    """Whether it takes only poses of a held carrier that the hold allows."""


def program_of(command: str, stand_file: str) -> Program:
    """The program of a command; `{stand}` in it becomes the stand file. Raises UsageError."""
    return Program(command, tuple(_words(command, stand_file)))


def verify_program(
    stand: Stand,
    program: Program,
    *,
    wants: Sequence[str] = (),
    seed: int = 1,
    count: int = 200,
    timeout: float = 300.0,
    tolerance: float = DOUBLE.default,
    actuators: bool = False,
) -> Report:
    """Judge a program. `wants`: those it must offer; else what it does offer.

    `actuators`: two of three states have deflections of fins and speeds of propellers, for a program that takes them.

    A program that dies, hangs, drops lines or prints anything else is reported with an `error`.
    Raises UsageError where it cannot be started, or a want is of tasks and the stand has none.
    """
    states = draw(stand, seed, count, wrenches=False)
    if program.on_hold:
        states = [(name, onto_hold(stand, state)) for name, state in states]
    if actuators:
        states = _with_actuators(stand, states, seed)
    setting = TaskSetting(stand, uniform(tolerance), Second(stand), seed)
    asked = tuple(wants) or _offers(stand, program)
    requests = _requests(states, [want for want in asked if want != TORQUE_FOR])
    if TORQUE_FOR in asked:
        requests += torque_requests(setting, states)
    if not stand.tasks and TORQUE_FOR in wants:
        raise UsageError(f"--want {TORQUE_FOR}: {stand.name} has no task, [task.NAME]")
    try:
        found = answers_of(program, requests, timeout)
    except CheckError as error:
        return report(stand, program.name, seed, len(states), tolerance, (), str(error))
    rows = _rows(setting, requests, found, tolerance, bool(wants), program.optional)
    return report(stand, program.name, seed, len(states), tolerance, rows)


def _offers(stand: Stand, program: Program) -> tuple[str, ...]:
    """Wants that a program may offer of this carrier."""
    return program.offers or (*wants_of_carrier(stand.hold is not None), TORQUE_FOR)


def takes_actuators(stand: Stand, program: Program, timeout: float) -> bool:
    """Whether the answers of a program depend on the deflections and speeds that a state gives, the key `actuators`.

    Raises CheckError where it dies, hangs or prints anything else; UsageError where it cannot be started.
    """
    if not actuators_of(stand):
        return False
    rng = np.random.default_rng(0)
    still = random_state(stand, rng)
    moved = with_drawn_actuators(stand, still, rng)
    wants = [want for want in _offers(stand, program) if want != TORQUE_FOR and applicable(still, want)]
    requests = [
        Request(f"{name}, {want}", state, (want,))
        for want in wants
        for name, state in (("file", still), ("set", moved))
    ]
    found = answers_of(program, requests, timeout)
    pairs = zip(found[::2], found[1::2], strict=True)
    return any("error" not in b and {**a, "id": None} != {**b, "id": None} for a, b in pairs if "error" not in a)


def _with_actuators(stand: Stand, states: Sequence[tuple[str, State]], seed: int) -> list[tuple[str, State]]:
    """The states, every third as it is, others with one of two sets: the second derivation is made for each set."""
    rng = np.random.default_rng(seed)
    sets = [with_drawn_actuators(stand, states[0][1], rng).actuators for _ in range(2)]
    return [
        (name, state if k % 3 == 0 else replace(state, actuators=sets[k % 3 - 1]))
        for k, (name, state) in enumerate(states)
    ]


def answers_of(program: Program, requests: Sequence[Request], timeout: float) -> list[Mapping[str, Any]]:
    """Results of a program for requests, in order.

    Raises CheckError where it dies, hangs, drops lines or prints anything else; UsageError where it cannot be started.
    """
    output = run_program(program.words, [state_line(request) for request in requests], timeout)
    return read_results(output, requests)


def _requests(states: Sequence[tuple[str, State]], wants: Sequence[str]) -> list[Request]:
    """Requests of one want each, so that a want that a program lacks does not affect others."""
    return [
        Request(f"{name}, {want}", state, (want,))
        for name, state in states
        for want in wants
        if applicable(state, want)
    ]


def _words(command: str, stand_file: str) -> list[str]:
    try:
        words = [word.replace("{stand}", stand_file) for word in shlex.split(command)]
    except ValueError as error:
        raise UsageError(f"--with {command}: {error}") from None
    if not words:
        raise UsageError("--with: no command")
    return words


def read_results(lines: Sequence[bytes], requests: Sequence[Request]) -> list[Mapping[str, Any]]:
    """A result for every request, in order. Raises CheckError."""
    found: list[Mapping[str, Any]] = []
    for number, (line, request) in enumerate(zip(lines, requests, strict=False), start=1):
        try:
            result = json.loads(line)
        except (ValueError, RecursionError):
            raise CheckError(f"line {number} of its output is no JSON: {_start(line)}") from None
        if not isinstance(result, dict):
            raise CheckError(f"line {number} of its output is no object: {_start(line)}")
        if result.get("id") != request.id:
            given = excerpt(result.get("id"))
            raise CheckError(f'line {number} of its output has the id {given}, expected "{request.id}"')
        found.append(result)
    if len(lines) != len(requests):
        raise CheckError(f"{len(lines)} lines of output for {len(requests)} states")
    if all(result == json.loads(state_line(request)) for result, request in zip(found, requests, strict=True)):
        raise CheckError("it answered nothing: each line of its output is the state that it was given, without results")
    return found


def _start(line: bytes) -> str:
    return ascii(line[:60].decode("utf-8", "replace"))


def _rows(
    setting: TaskSetting,
    requests: Sequence[Request],
    found: Sequence[Mapping[str, Any]],
    tolerance: float,
    required: bool,
    optional: Mapping[str, tuple[str, ...]],
) -> list[Check]:
    """Checks of the wants it offers; one row for each it does not."""
    stand = setting.stand
    judge = Judge(stand, uniform(tolerance), Second(stand), "program")
    pairs = list(zip(requests, found, strict=True))
    torques = [pair for pair in pairs if pair[0].want[0] == TORQUE_FOR]
    by_want: dict[str, list[Mapping[str, Any]]] = {}
    for request, result in pairs:
        by_want.setdefault(request.want[0], []).append(result)
    # of each want it offers, the optional quantities that are in no result; one that is in some must be in all
    omitted = {
        want: tuple(name for name in optional.get(want, ()) if not any(name in result for result in results))
        for want, results in by_want.items()
        if not all("error" in result for result in results)
    }
    for request, result in pairs:
        want = request.want[0]
        if want in omitted and want != TORQUE_FOR:
            refusal = f"refused: {result['error']}"[:200] if "error" in result else ""
            judge.compare(request, want, None if refusal else result, omitted[want], refusal)
    rows = judge.rows()
    if TORQUE_FOR in omitted:
        rows += torque_rows(setting, [pair[0] for pair in torques], [pair[1] for pair in torques])
    for want, names in omitted.items():
        rows += (Check(want, name, verdict="not offered", words="in none of its results") for name in names)
    for want, results in by_want.items():
        if want not in omitted:
            verdict = "MISSING" if required else "not offered"
            rows.append(Check(want, want, verdict=verdict, words=str(results[0]["error"])[:200]))
    return rows


def run_program(words: Sequence[str], lines: Sequence[str], timeout: float) -> list[bytes]:
    """Output lines of a program for these input lines, without blank lines.

    All lines are written and its input is closed, whether it answers each at once or all at the end.
    Raises CheckError where it dies, hangs or does not stop printing; UsageError where it cannot be started.
    """
    try:
        process = subprocess.Popen(
            words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, start_new_session=True
        )
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else error
        raise UsageError(f"--with {words[0]}: cannot be started: {reason}") from None
    assert process.stdin is not None and process.stdout is not None and process.stderr is not None
    found: list[bytes] = []
    complaints: deque[bytes] = deque(maxlen=1)
    threads = [
        threading.Thread(target=_feed, args=(process.stdin, lines), daemon=True),
        threading.Thread(target=_read, args=(process.stdout, found, len(lines)), daemon=True),
        threading.Thread(target=_listen, args=(process.stderr, complaints), daemon=True),
    ]
    try:
        for thread in threads:
            thread.start()
        threads[1].join(timeout)
        if threads[1].is_alive():
            raise CheckError(f"{words[0]} gave no complete answer in {timeout:g} s")
        if len(found) > len(lines):
            raise CheckError(f"{words[0]} gave more lines than the {len(lines)} states")
        try:
            status = process.wait(timeout)
        except subprocess.TimeoutExpired:
            raise CheckError(f"{words[0]} did not end in {timeout:g} s") from None
    finally:
        _stop(process)
        for thread in threads:
            thread.join()
        process.stdout.close()
        process.stderr.close()
    last = complaints[0].decode("utf-8", "replace").strip()[:200] if complaints else ""
    if status not in (0, 1):  # 1: some states failed, which their lines say
        how = f"signal {-status}" if status < 0 else f"status {status}"
        raise CheckError(f"{words[0]} ended with {how}" + (f": {last}" if last else ""))
    if not found:
        raise CheckError(f"{words[0]} gave nothing" + (f": {last}" if last else ""))
    return found


def _feed(pipe: IO[bytes], lines: Sequence[str]) -> None:
    with contextlib.suppress(OSError):  # it has stopped reading: what it printed will tell
        for line in lines:
            pipe.write(line.encode() + b"\n")
    with contextlib.suppress(OSError):
        pipe.close()


def _read(pipe: IO[bytes], found: list[bytes], count: int) -> None:
    """Lines until the end, or until there are too many."""
    while len(found) <= count:
        line = pipe.readline(LONGEST)
        if not line:
            return
        if line.strip():
            found.append(line)


def _listen(pipe: IO[bytes], complaints: deque[bytes]) -> None:
    while line := pipe.readline(LONGEST):
        if line.strip():
            complaints.append(line)


def _stop(process: subprocess.Popen[bytes]) -> None:
    """Kill the program and all processes that it started."""
    with contextlib.suppress(OSError):
        os.killpg(process.pid, signal.SIGKILL)
    process.wait()
