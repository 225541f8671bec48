"""Judge of what others wrote: programs that follow the contract of `eval`, and logs of states with their answers."""

from __future__ import annotations

import contextlib
import json
import os
import shlex
import signal
import subprocess
import tempfile
import threading
from collections import deque
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import islice
from time import monotonic
from typing import IO, Any, Literal, get_args

import numpy as np

from mahovik.contract.evaluation import ANSWERS, MAY_BE_LEFT_OUT, STATE, answers_of
from mahovik.contract.functions import wants_of_carrier
from mahovik.contract.limits import DOUBLE, Limits, uniform
from mahovik.contract.status import BITS, STATUS_VALUES
from mahovik.core.stand.model import Stand, State
from mahovik.core.stand.random import random_state
from mahovik.errors import CheckError, StateError, UsageError
from mahovik.nearest import suggestion
from mahovik.proof.reference.inverse import task_rows
from mahovik.proof.reference.motion import coupled
from mahovik.proof.second import Second
from mahovik.proof.verify.backends import CasadiBackend
from mahovik.proof.verify.check import Check, Report, difference, report
from mahovik.proof.verify.compare import Rows, ordinary
from mahovik.proof.verify.draw import draw, onto_hold, with_angles, with_drawn_actuators, with_quaternion
from mahovik.proof.verify.functions.optimality import judge_torques, motor_bounds
from mahovik.proof.verify.harness import applicable
from mahovik.proof.verify.motors import motor_states
from mahovik.proof.verify.scales import Scales
from mahovik.proof.verify.states import LONGEST, Request, excerpt, state_line

Attitude = Literal["angles", "quaternion"]

TORQUE_FOR, SHARES, STATES = "torque_for", (0.3, 1.0, 2.0), 24
"""Want of torques within bounds; demands of it as shares of what motors have; ordinary states of a task, at most."""

Answered = Sequence[tuple[Request, Mapping[str, Any]]]
"""Requests of one want each, with their results."""


@dataclass(frozen=True)
class Program:
    """A program that reads states.

    name       in reports
    words      of its command
    offers     wants that it may offer; none: those of the carrier
    left_out   quantities that it may leave out of a want that it offers
    on_hold    whether it takes only poses of a held carrier that the hold allows
    attitude   the only form in which it is given attitudes; None: in both
    actuators  whether it takes deflections of fins and speeds of propellers
    """

    name: str
    words: tuple[str, ...]
    offers: tuple[str, ...] = ()
    left_out: tuple[str, ...] = MAY_BE_LEFT_OUT
    on_hold: bool = False
    attitude: Attitude | None = None
    actuators: bool = False

    def wants(self, stand: Stand) -> tuple[str, ...]:
        """Wants that it may offer of a stand."""
        return self.offers or (*wants_of_carrier(stand.hold is not None), *((TORQUE_FOR,) if stand.tasks else ()))

    def state(self, stand: Stand, state: State) -> State:
        """A state as the program is given it."""
        if self.on_hold:
            state = onto_hold(stand, state)
        turned = {"angles": with_angles, "quaternion": with_quaternion}
        return turned[self.attitude](stand, state) if self.attitude else state


def program_of(command: str, stand_file: str, attitude: Attitude | None = None) -> Program:
    """The program of a command; `{stand}` in it becomes the stand file. Raises UsageError."""
    try:
        words = tuple(word.replace("{stand}", stand_file) for word in shlex.split(command))
    except ValueError as error:
        raise UsageError(f"with_ {command}: {error}; expected a command of the shell") from None
    if not words:
        raise UsageError("with_: found nothing, expected a command")
    return Program(command, words, attitude=attitude)


def verify_program(
    stand: Stand,
    program: Program,
    *,
    wants: Sequence[str] = (),
    seed: int = 1,
    count: int = 200,
    timeout: float = 300.0,
    tolerance: float = DOUBLE.value,
) -> Report:
    """Judge a program. `wants`: those it must offer; else what it does offer.

    A program that dies, hangs, drops lines or prints anything else is reported with an `error`.
    Raises UsageError where it cannot be started, or a want cannot be asked.
    """
    asked = tuple(wants) or program.wants(stand)
    if not stand.tasks and TORQUE_FOR in asked:
        raise UsageError(f"want {TORQUE_FOR}: {stand.name} has no task, [task.NAME]")
    if program.attitude == "quaternion" and "generalized" in wants and stand.hold is None:
        raise UsageError("want, attitude: generalized needs angles, found quaternion")
    states = [(name, program.state(stand, state)) for name, state in draw(stand, seed, count)]
    if program.actuators:  # two sets, since the second derivation is made for each, and every third state as it is
        rng = np.random.default_rng(seed)
        first = states[0][1]
        sets = [first.actuators, *(with_drawn_actuators(stand, first, rng).actuators for _ in range(2))]
        states = [(name, replace(state, actuators=sets[k % 3])) for k, (name, state) in enumerate(states)]
    requests = [
        Request(f"{name}, {want}", state, (want,))  # so that a want that a program lacks does not affect others
        for name, state in states
        for want in asked
        if applicable(state, want)
    ]
    if TORQUE_FOR in asked:
        requests += torque_requests(stand, states, seed)
    scales = Scales(stand)
    if "inverse" in asked:
        edges = motor_states(stand, scales, ordinary(states, STATES))
        requests += [Request(name, program.state(stand, state), ("inverse",)) for name, state in edges]
    try:
        results = answers_of_program(program, requests, timeout)
    except CheckError as error:
        return report(stand, program.name, seed, len(states), tolerance, (), str(error))
    answered = list(zip(requests, results, strict=True))
    rows = _rows(stand, tolerance, "program", answered, program.left_out, wants, scales)
    return report(stand, program.name, seed, len(states), tolerance, rows)


def verify_log(
    stand: Stand,
    source: str,
    answers: Answered,
    count: int,
    *,
    wants: Sequence[str] = (),
    tolerance: float = DOUBLE.value,
) -> Report:
    """Judge the answers of a log of `count` states. `wants`: those it must have."""
    asked = [(request, result) for request, result in answers if not wants or request.want[0] in wants]
    rows = _rows(stand, tolerance, "log", asked, ("reaction",), wants, Scales(stand))
    return report(stand, source, 0, count, tolerance, rows)


def takes_actuators(stand: Stand, program: Program, timeout: float) -> bool:
    """Whether the answers of a program depend on the deflections and speeds that a state gives, the key `actuators`.

    Raises CheckError where it dies, hangs or prints anything else; UsageError where it cannot be started.
    """
    rng = np.random.default_rng(0)
    still = program.state(stand, random_state(stand, rng))
    moved = with_drawn_actuators(stand, still, rng)
    requests = [
        Request(f"{name}, {want}", state, (want,))
        for want in program.wants(stand)
        if applicable(still, want)
        for name, state in (("file", still), ("set", moved))
    ]
    results = answers_of_program(program, requests, timeout)
    pairs = zip(results[::2], results[1::2], strict=True)
    return any("error" not in b and {**a, "id": None} != {**b, "id": None} for a, b in pairs if "error" not in a)


def _rows(
    stand: Stand, tolerance: float, judged: str, answered: Answered, left_out: Sequence[str], wants: Sequence[str],
    scales: Scales,
) -> list[Check]:  # fmt: skip
    """Rows of the wants that a program offers; one row for each that it does not, MISSING where it is in `wants`."""
    by_want: dict[str, list[tuple[Request, Mapping[str, Any]]]] = {want: [] for want in wants}
    for request, result in answered:
        by_want.setdefault(request.want[0], []).append((request, result))
    second, limits = Second(stand), uniform(tolerance)
    other, compared, rows = CasadiBackend(stand, second), list[Check](), list[Check]()
    for want, pairs in by_want.items():
        refusals = [str(result["error"])[:200] for _, result in pairs if "error" in result]
        if len(refusals) == len(pairs):
            words = refusals[0] if refusals else f"no row of the {judged} has it"
            rows.append(Check(want, want, verdict="MISSING" if wants else "not offered", words=words))
            continue
        if want == TORQUE_FOR:
            rows += torque_checks(TorqueCase(stand, limits, second, scales), pairs)
            continue
        # what is in some of its results must be in all
        absent = [name for name in left_out if not any(name in result for _, result in pairs)]
        absent = [name for name in answers_of(want, stand.hold is not None) if name in absent]
        silent = [name for name in absent if name not in by_want]  # a reaction may have a want of its own
        rows += [Check(want, name, verdict="not offered", words="in none of its results") for name in silent]
        judge = Rows(limits, scales, want, second=other, by=judged)
        for request, result in pairs:
            refusal = f"refused: {result['error']}"[:200] if "error" in result else ""
            judge.compare_want(request, None if refusal else result, absent, refusal)
        compared += judge.checks()
    return [*compared, *rows]


@dataclass(frozen=True)
class TorqueCase:
    """Where torques of a program within the bounds of its motors are judged, by what they reach, as those of the C."""

    stand: Stand
    limits: Limits
    second: Second
    scales: Scales


def motor_options(stand: Stand) -> dict[str, Any]:
    """Options of `eval`: weights and motors of the stand file, no power, no wanted speeds."""
    motors = [wheel.motor for wheel in stand.flywheels]
    curves = [np.transpose(m.limit if m and m.torque_speed else ((0.0, np.inf),)).tolist() for m in motors]
    return {
        "weight": [wheel.inverse_weight for wheel in stand.flywheels],
        "motor_torque": [np.inf if m is None or m.torque is None else m.torque for m in motors],
        "motor_speed": [np.inf if m is None or m.speed is None else m.speed for m in motors],
        "motor_curve_speed": [speeds for speeds, _ in curves],
        "motor_curve_torque": [torques for _, torques in curves],
        "motor_power": [np.inf] * len(motors),
        "target_speed": [0.0] * len(motors),
        "target_rate": 0.0,
        "avoid_speed": 0.0,
    }


def torque_requests(stand: Stand, states: Sequence[tuple[str, State]], seed: int) -> list[Request]:
    """Requests for each task of the stand, none without tasks.

    A demand is what random torques reach, SHARES of those of the motors, or of 1000 rad/s2 where these have no limit.
    """
    scales, options = Scales(stand), motor_options(stand)
    result = []
    for task in stand.tasks:
        for number, (name, state) in enumerate(ordinary(states, STATES)):
            at, (_, most) = scales.at(state), motor_bounds(state, options)
            drawn = np.random.default_rng((seed, 900 + number)).uniform(-1.0, 1.0, len(most))
            tau = drawn * SHARES[number % len(SHARES)] * np.minimum(most, 1000.0 * np.diag(at.Theta_ff))
            demand = tuple(task_rows(at, stand, task).acceleration(coupled(at, tau)[0]).tolist())
            asked = replace(state, V_dot=(0.0,) * 6, task=task.name, demand=demand)
            result.append(Request(f"{name}, {TORQUE_FOR} {task.name}", asked, (TORQUE_FOR,)))
    return result


def torque_checks(case: TorqueCase, answered: Answered) -> list[Check]:
    """tau where no bound is touched, the error within bounds, the motion that results, status and limited."""
    rows, N = Rows(case.limits, case.scales, TORQUE_FOR, "optimality"), len(case.stand.flywheels)
    for request, result in answered:
        state, where, names = request.state, str(request.id).partition(",")[0], str(result.get("status")).split("|")
        sizes = {"tau": N, "phi_ddot": N, "V_dot": 6, "residual": len(state.demand), "limited": N}
        faults = [
            f"{k}: {fault}" for k, n in sizes.items() if (fault := difference(result.get(k), np.zeros(n), 1.0)[1])
        ]
        if names != ["OK"] and not {*names} <= {*BITS}:
            faults.insert(0, f"status: expected OK or names joined by |, found {result.get('status')!r}")
        if "error" in result:
            faults = [f"refused: {result['error']}"]
        if faults:
            rows.check("tau", "value").refuse(StateError(faults[0][:200]), where)
            continue
        status = 0 if names == ["OK"] else sum(STATUS_VALUES[name] for name in {*names})
        answer = {name: np.array(result[name], dtype=np.float64) for name in sizes}
        judge_torques(case, rows, where, state, motor_options(case.stand), np.zeros(N, dtype=bool), status, answer)
    return rows.checks()


def answers_of_program(program: Program, requests: Sequence[Request], timeout: float) -> list[Mapping[str, Any]]:
    """Results of a program for requests, in order, whose states are in its form.

    Raises CheckError where it dies, hangs, drops lines or prints anything else; UsageError where it cannot be started.
    """
    try:
        return read_results(run_program(program.words, [state_line(x) for x in requests], timeout), requests)
    except CheckError as error:
        if program.attitude or not any(form in str(error) for form in get_args(Attitude)):
            raise
        hint = "some states have angles, others a quaternion: --attitude gives all one of them"
        raise CheckError(f"{error}; {hint}") from None


def read_results(lines: Sequence[bytes], requests: Sequence[Request]) -> list[Mapping[str, Any]]:
    """A result for every request, in order. Raises CheckError."""
    results: list[Mapping[str, Any]] = []
    for number, (line, request) in enumerate(zip(lines, requests, strict=False), start=1):
        try:
            result = json.loads(line)
        except (ValueError, RecursionError):
            result = None
        start = ascii(line[:60].decode("utf-8", "replace").strip())
        otherwise = f": found {start}, expected an object in JSON, an answer a line; messages go to standard error"
        if fault := _fault(request, result) if isinstance(result, dict) else otherwise:
            raise CheckError(f"line {number} of its output{fault}")
        results.append(result)
    echoes = [x == json.loads(state_line(request)) for x, request in zip(results, requests, strict=False)]
    if echoes and all(echoes):
        raise CheckError("it answered nothing: each line of its output is the state that it was given, without results")
    if len(lines) > len(requests):
        raise CheckError(f"it gave more lines than the {len(requests)} states, expected an answer to each")
    return results


def _fault(request: Request, result: Mapping[str, Any]) -> str:
    """What of a result is not by the contract: its id, a name in the place of one that is missing, a shape."""
    if result.get("id") != request.id:
        return f' has the id {excerpt(result.get("id"))}, expected "{request.id}"'
    if "error" in result:
        return ""
    wanted = answers_of(request.want[0], bool(request.state.u), bool(request.state.task))
    missing = [name for name in wanted if name not in result and name not in MAY_BE_LEFT_OUT]
    unknown = [name for name in result if name not in ANSWERS and name not in STATE]
    if missing and unknown:
        return f': unknown key "{unknown[0]}"{suggestion(unknown[0], missing)}'
    for name in wanted:
        expected = ANSWERS[name].shape_of(len(request.state.phi), len(request.state.u))
        if expected is None or result.get(name) is None:
            continue
        try:
            shape = np.shape(result[name])
        except ValueError:
            return f": {name}: found lists of different lengths, expected {_size(expected)}"
        if shape != expected and (np.prod(shape) or np.prod(expected)):
            return f": {name}: found {_size(shape)}, expected {_size(expected)}"
    return ""


def _size(shape: Sequence[int]) -> str:
    return f"a list of {' x '.join(map(str, shape))}" if shape else "one value"


def run_program(words: Sequence[str], lines: Sequence[str], timeout: float) -> list[bytes]:
    """Output lines of a program for these input lines, without blank lines; at most one more.

    It finds all lines and the end of its input, whether it answers each at once or all at the end.
    Raises CheckError where it dies, hangs or does not stop printing; UsageError where it cannot be started.
    """
    last_words, pipe, start = deque[bytes](maxlen=1), subprocess.PIPE, monotonic()
    with tempfile.TemporaryFile() as states:
        states.write("".join(f"{line}\n" for line in lines).encode())
        states.seek(0)
        try:  # in a group of its own, which ends with it
            process = subprocess.Popen(words, stdin=states, stdout=pipe, stderr=pipe, start_new_session=True)
        except (OSError, ValueError) as error:
            reason = error.strerror if isinstance(error, OSError) else error
            raise UsageError(f"with_ {words[0]}: cannot be started: {reason}") from None
    with process:
        timer = threading.Timer(timeout, _kill, (process,))
        listener = threading.Thread(target=lambda: last_words.extend(_lines(process.stderr)), daemon=True)
        try:
            timer.start()
            listener.start()
            answers = list(islice(_lines(process.stdout), len(lines) + 1))
            status = process.wait() if len(answers) <= len(lines) else 0
        finally:
            timer.cancel()
            _kill(process)
            listener.join()
    answered = f"{words[0]} answered {len(answers) or 'none'} of {len(lines)} states"
    if status in (0, 1) and len(answers) >= len(lines):  # 1: some states failed, which their lines say
        return answers
    if monotonic() - start >= timeout:
        raise CheckError(f"{answered} in {timeout:g} s, its timeout, and had not ended: give it longer")
    end = f"signal {-status}" if status < 0 else f"status {status}"
    reason = b"".join(last_words).decode("utf-8", "replace").strip()[:200] or "nothing on its standard error"
    raise CheckError(f"{answered} and ended with {end}: {reason}")


def _lines(pipe: IO[bytes] | None) -> Iterator[bytes]:
    """Lines that are not blank."""
    while pipe is not None and (line := pipe.readline(LONGEST)):
        if line.strip():
            yield line


def _kill(process: subprocess.Popen[bytes]) -> None:
    """Kill the program and all processes that it started."""
    with contextlib.suppress(OSError):
        os.killpg(process.pid, signal.SIGKILL)
