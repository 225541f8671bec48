"""`eval`: states in, answers out, one JSON object a line."""

from __future__ import annotations

import json
import sys
from collections.abc import Generator, Iterable, Mapping
from typing import Annotated, Any, Literal

from mahovik.errors import UsageError
from mahovik.out.arguments import StandGiven
from mahovik.out.result import Result

States = Annotated[Iterable[Mapping[str, Any] | str] | None, ""]
"""States as mappings or lines of JSON; None: the lines of standard input."""


def eval(
    stand: StandGiven,
    states: States = None,
    *,
    backend: Literal["c", "numpy", "casadi"] = "c",
    real: Literal["double", "float"] = "double",
) -> Generator[str, None, Result]:
    """Evaluate states from standard input.

    One JSON object per line; a result line for each, in order. `mahovik new adapter` writes the contract of both. With
    a task `inverse` answers for its rows, `torque_for` with drive torques within what the motors have, and `torque`,
    `mounts`, `points` take the motion that results.

    A state that cannot be evaluated gives an error line in its place; the exit status is then 1.

    Args:
        stand: the stand file.
        backend: evaluate by c, the generated C; numpy, the literal reference; or casadi, the second derivation.
        real: element type of the C.

    Raises:
        UsageError: a backend without float.
        ToolchainError: the C does not compile.
    """
    from mahovik.out.api.stands import Stand
    from mahovik.proof.verify import backends
    from mahovik.proof.verify.states import evaluate_lines, split_lines

    if real == "float" and backend != "c":
        raise UsageError(f"real float: only backend=c has it, not {backend}")
    machine = Stand.of(stand)
    makers = {"numpy": backends.NumpyBackend, "casadi": backends.CasadiBackend}
    by = makers[backend](machine) if backend in makers else backends.KeptBackend(machine, real)
    lines = split_lines(sys.stdin.buffer) if states is None else map(_line, states)
    failed = 0
    for line, good in evaluate_lines(machine, by, lines, real):
        failed += not good
        yield line
    messages = [f"error: {failed} of the states cannot be evaluated, see their lines"] if failed else []
    return Result("", messages=messages, ok=not failed)


def _line(state: Mapping[str, Any] | str) -> bytes:
    return (state if isinstance(state, str) else json.dumps(dict(state))).encode()
