"""Any program that speaks the `eval` contract, judged as a whole: states into it, its results against ours."""

from __future__ import annotations

import json
import shlex
from collections.abc import Mapping, Sequence
from typing import Any

from mahovik.contract.functions import WANTS
from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.errors import CheckError, UsageError
from mahovik.proof.second import Second
from mahovik.proof.verify.bounds import DOUBLE, uniform
from mahovik.proof.verify.compare import Judge, Row
from mahovik.proof.verify.converse import converse
from mahovik.proof.verify.draw import draw
from mahovik.proof.verify.evaluate import state_line
from mahovik.proof.verify.harness import askable, report
from mahovik.proof.verify.report import Report
from mahovik.proof.verify.states import Request, shown

OPTIONAL = {"generalized": ("I0", "J0")}
"""Quantities that a program may leave out of a want that it offers: (10) and (11) can be had without them."""


def verify_program(
    stand: Stand,
    command: str,
    stand_file: str,
    *,
    wants: Sequence[str] = (),
    seed: int = 1,
    count: int = 200,
    timeout: float = 300.0,
    tolerance: float = DOUBLE.default,
) -> Report:
    """Judge `command`; `{stand}` in it becomes the stand file. `wants`: those it must offer; else what it does offer.

    A program that dies, hangs, drops lines or prints anything else is reported with an `error`.
    Raises UsageError where it cannot be started.
    """
    states = draw(stand, seed, count)
    requests = _requests(states, wants or WANTS)
    try:
        found = ask(command, stand_file, requests, timeout)
    except CheckError as error:
        return report(stand, command, seed, len(states), tolerance, (), str(error))
    rows = _rows(stand, requests, found, tolerance, bool(wants))
    return report(stand, command, seed, len(states), tolerance, rows)


def ask(command: str, stand_file: str, requests: Sequence[Request], timeout: float) -> list[Mapping[str, Any]]:
    """What a program says to requests: a result for each, in order; `{stand}` in the command becomes the stand file.

    Raises CheckError where it dies, hangs, drops lines or prints anything else; UsageError where it cannot be started.
    """
    output = converse(_words(command, stand_file), [state_line(request) for request in requests], timeout)
    return read_results(output, requests)


def _requests(states: Sequence[tuple[str, State]], wants: Sequence[str]) -> list[Request]:
    """One want a line, so that a want which a program lacks spoils no other."""
    return [
        Request(f"{name}, {want}", state, (want,)) for name, state in states for want in wants if askable(state, want)
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
            given = shown(result.get("id"))
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
    stand: Stand, requests: Sequence[Request], found: Sequence[Mapping[str, Any]], tolerance: float, required: bool
) -> list[Row]:
    """Rows of the wants it offers; one row for each it does not."""
    judge = Judge(stand, uniform(tolerance), Second(stand), "program")
    wants = list(dict.fromkeys(request.want[0] for request in requests))
    offered = {request.want[0] for request, result in zip(requests, found, strict=True) if "error" not in result}
    left_out = {want: _left_out(want, requests, found) for want in offered}
    for request, result in zip(requests, found, strict=True):
        want = request.want[0]
        if want not in offered:
            continue
        if "error" in result:
            judge.refused(request, want, f"refused: {result['error']}"[:200], left_out[want])
        else:
            judge.compare(request, want, result, left_out[want])
    rows = judge.rows()
    for want in wants:
        for quantity in left_out.get(want, ()):
            rows.append(Row(want, quantity, verdict="not offered", reason="in none of its results"))
    for want in wants:
        if want not in offered:
            reason = next(str(r["error"])[:200] for q, r in zip(requests, found, strict=True) if q.want[0] == want)
            rows.append(Row(want, want, verdict="MISSING" if required else "not offered", reason=reason))
    return rows


def _left_out(want: str, requests: Sequence[Request], found: Sequence[Mapping[str, Any]]) -> tuple[str, ...]:
    """Optional quantities that are in no result; one that is in some results must be in all."""
    results = [result for request, result in zip(requests, found, strict=True) if request.want[0] == want]
    return tuple(name for name in OPTIONAL.get(want, ()) if not any(name in result for result in results))
