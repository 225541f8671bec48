"""`eval`: a stream of states in, a stream of results out, line by line."""

from __future__ import annotations

import codecs
import json
import math
from collections.abc import Iterable, Iterator
from typing import IO, Any

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.errors import StateError
from mahovik.proof.verify.backends import Backend
from mahovik.proof.verify.states import Request, identifier, read_object, read_request

LONGEST = 16_000_000
"""Bytes of a line; more is no state of any stand, and is not kept."""


def lines_of(stream: IO[bytes]) -> Iterator[bytes]:
    """The lines of a stream, as they come; of one that is too long no more than shows that it is."""
    while line := stream.readline(LONGEST + 1):
        yield line
        while len(line) > LONGEST and not line.endswith(b"\n"):
            line = stream.readline(LONGEST + 1)


def results(stand: Stand, backend: Backend, lines: Iterable[bytes], real: str = "double") -> Iterator[tuple[str, bool]]:
    """For every line that is not blank, in order: a line of strict JSON, and whether the state was evaluated."""
    for number, raw in enumerate(lines):
        line = raw.removeprefix(codecs.BOM_UTF8) if number == 0 else raw
        if line.strip():
            yield result(stand, backend, line, real)


def result(stand: Stand, backend: Backend, line: bytes, real: str = "double") -> tuple[str, bool]:
    """The result of one line, an error line where it cannot be evaluated."""
    given: Any = None
    try:
        if len(line) > LONGEST:
            raise StateError(f"a line of more than {LONGEST} bytes")
        found = read_object(_text(line))
        given = identifier(found)
        request = read_request(stand, found, real)
        values = backend.evaluate(request.state, request.want)
        return _line(given, values), True
    except StateError as error:
        return _line(given, {"error": str(error)}), False


def _line(given: Any, values: dict[str, Any]) -> str:
    """The id as it was given (any JSON value, nested however deep), then the values."""
    return f'{{"id": {json.dumps(given)}, {_members(values)}}}'


def _text(line: bytes) -> str:
    try:
        return line.decode("utf-8")
    except UnicodeDecodeError as error:
        raise StateError(f"not UTF-8: byte 0x{line[error.start]:02x}") from None


def encode(value: Any) -> str:
    """Strict JSON, floats with 17 significant digits, so that they read back as the same bits.

    StateError where a number is not finite. Arrays are lists; a float is never written like an integer.
    """
    match value:
        case dict():
            return "{" + _members(value) + "}"
        case np.ndarray():
            return encode(value.tolist())
        case list() | tuple():
            return "[" + ", ".join(encode(each) for each in value) + "]"
        case float() | np.floating():
            return _float(float(value))
        case np.integer():
            return str(int(value))
    return json.dumps(value, allow_nan=False)


def _members(value: dict[str, Any]) -> str:
    return ", ".join(f"{json.dumps(name)}: {_member(name, each)}" for name, each in value.items())


def _member(name: str, value: Any) -> str:
    try:
        return encode(value)
    except StateError as error:
        reason = str(error)
    raise StateError(reason if ":" in reason else f"{name}: {reason}")


def _float(x: float) -> str:
    if not math.isfinite(x):
        raise StateError("not finite at this state")
    text = f"{x:.17g}"
    return text + ".0" if text.lstrip("-").isdigit() else text


def state_object(state: State) -> dict[str, Any]:
    """The keys of a state, as a line holds them. What is zero is left out."""
    found: dict[str, Any] = {}
    if any(state.position):
        found["position"] = state.position
    if state.angles is not None:
        found["angles"] = state.angles
    if state.quaternion is not None:
        found["quaternion"] = state.quaternion
    for key in ("V", "phi", "phi_dot", "phi_ddot", "V_dot", "tau"):
        if any(getattr(state, key)):
            found[key] = getattr(state, key)
    wrench = {name: value for name, value in state.wrench.items() if any(value)}
    if wrench:
        found["wrench"] = wrench
    return found


def state_line(request: Request) -> str:
    """The line that asks for a request: reading it back gives the same numbers."""
    return _line(request.id, {**state_object(request.state), "want": list(request.want)})
