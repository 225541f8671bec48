"""Output of `mahovik replay`: states as lines of `eval` or as columns, one step in full."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from mahovik.contract.status import status_words
from mahovik.errors import StateError, UsageError
from mahovik.proof.verify.evaluate import encode
from mahovik.use.simulate.flight_log import members
from mahovik.use.simulate.replay import Outcome

FORMATS = (".csv", ".jsonl")


def check(path: Path) -> None:
    """Check the name of the output file. Raises UsageError."""
    if path.suffix not in FORMATS:
        raise UsageError(f"-o {path}: expected a name that ends in {' or '.join(FORMATS)}")


def csv_heading(flywheels: int) -> str:
    """Column titles of a CSV file."""
    return ",".join(["step", "status", *(f"{m}[{i}]" for m, n in members(flywheels).items() for i in range(n))]) + "\n"


def csv_row(outcome: Outcome) -> str:
    """One row of a CSV file: the state after a step, in digits that read back to the same bits."""
    numbers = [repr(number) for values in outcome.after.values() for number in _plain(values)]
    return ",".join([str(outcome.step.count), status_words(outcome.status), *numbers]) + "\n"


def eval_line(outcome: Outcome, wrenches: Sequence[str]) -> str:
    """The line of `mahovik eval` with the state before a step and its inputs. Raises StateError: not finite."""
    return encode(state_object(outcome, wrenches))


def state_object(outcome: Outcome, wrenches: Sequence[str]) -> dict[str, Any]:
    """The keys of that line; zeros are left out."""
    step, before = outcome.step, outcome.before
    found: dict[str, Any] = {"id": f"step {step.count}", "quaternion": _plain(before["attitude"])}
    drive = "phi_ddot" if step.driven else "tau"
    given = {name: before[name] for name in before if name != "attitude"} | {drive: step.drive}
    found |= {name: _plain(values) for name, values in given.items() if np.any(values)}
    pushed = {body: _plain(step.wrench[6 * i : 6 * i + 6]) for i, body in enumerate(wrenches)}
    if any(any(six) for six in pushed.values()):
        found["wrench"] = {body: six for body, six in pushed.items() if any(six)}
    return found | {"want": ["forward" if step.driven or not len(step.drive) else "coupled"]}


def step_dump(outcome: Outcome, wrenches: Sequence[str]) -> Iterator[str]:
    """Lines that show one step: its line of `eval`, then all of it in hexadecimal."""
    step = outcome.step
    try:
        yield eval_line(outcome, wrenches)
    except StateError as error:
        yield json.dumps({"id": f"step {step.count}", "error": str(error)})
    yield f"step {step.count}, {'step_driven' if step.driven else 'step'}: {status_words(outcome.status)}"
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


def _hexadecimal(name: str, values: Any) -> str:
    return f"{name} {' '.join(float(v).hex() for v in values)}"


def _plain(values: Any) -> list[float]:
    return [float(v) for v in values]
