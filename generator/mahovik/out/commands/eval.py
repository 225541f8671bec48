"""`eval`: states in, answers out, one JSON object a line."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, Annotated, Any, Literal

from mahovik.errors import CheckError, MahovikError
from mahovik.out.arguments import StandGiven, command, text_of_keys
from mahovik.out.result import Result
from mahovik.signatures import HIDDEN

if TYPE_CHECKING:
    from mahovik.out.api.stands import Stand

StatesGiven = Annotated[Mapping[str, Any] | str | Iterable[Mapping[str, Any] | str] | None, HIDDEN]
"""States as mappings or lines of JSON, or one; None: the lines of standard input."""


@command(needs={"backend=c": ("real",)})
def eval(
    stand: StandGiven,
    states: StatesGiven = None,
    *,
    backend: Literal["c", "numpy", "casadi"] = "c",
    real: Literal["double", "float"] = "double",
) -> Result:
    """Evaluate states from standard input.

    One JSON object per line; a result line for each, in order. With a task `inverse` answers for its rows, `torque_for`
    with drive torques within what the motors have, and `torque`, `mounts`, `points` take the motion that results.

    A state that cannot be evaluated gives an error line in its place; the exit status is then 1. In Python `states` are
    mappings or lines, or one, and `answers` of the result is the list of what the lines hold.

    Args:
        stand: the stand file.
        backend: evaluate by c, the generated C; numpy, the literal reference; or casadi, the second derivation.
        real: element type of the C.

    Raises:
        ToolchainError: the C does not compile.
        CheckError: a state of standard input cannot be evaluated.
    """
    from mahovik.out.api.stands import Stand
    from mahovik.proof.verify import backends

    machine = Stand.of(stand)
    makers = {"numpy": backends.NumpyBackend, "casadi": backends.CasadiBackend}
    by = makers[backend](machine) if backend in makers else backends.KeptBackend(machine, real)
    failed, answers = 0, list[dict[str, Any]]()
    for line, good in _evaluated(machine, by, states, real):
        failed += not good
        if states is None:
            sys.stdout.write(f"{line}\n")
            sys.stdout.flush()
        else:
            answers.append(json.loads(line))
    problem = f"{failed} of the states cannot be evaluated, see their lines"
    if failed and states is None:
        raise CheckError(problem)
    messages = [f"error: {problem}"] if failed else []
    return Result(
        f"{len(answers)} states of {machine.name}", meta={"answers": answers}, messages=messages, ok=not failed
    )


def _evaluated(stand: Stand, backend: Any, states: Any, real: str) -> Iterator[tuple[str, bool]]:
    """A line of each state, and whether it was evaluated."""
    from mahovik.out.api.states import States, keys_of_state
    from mahovik.proof.verify.states import evaluate_lines, split_lines

    if states is None:
        yield from evaluate_lines(stand, backend, split_lines(sys.stdin.buffer), real)
        return
    for state in [states] if isinstance(states, Mapping | str | States) else states:
        try:
            line = state if isinstance(state, str) else text_of_keys(keys_of_state(state, stand), schema=False)
        except MahovikError as error:
            identity = state.get("id") if isinstance(state, Mapping) else None
            yield text_of_keys({"id": identity, "error": str(error)}, schema=False), False
        else:
            yield from evaluate_lines(stand, backend, [line.encode()], real)
