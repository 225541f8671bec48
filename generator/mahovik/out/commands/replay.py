"""`replay`: a flight log, step by step, bit for bit."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from mahovik.errors import UsageError
from mahovik.out.arguments import FilePath, Folder, Progressing, StandGiven, command
from mahovik.out.notices import Progress, notify
from mahovik.out.result import Result, column

if TYPE_CHECKING:
    from mahovik.core.stand.model import Stand
    from mahovik.use.simulate.replay import Damage, Machine, Outcome, Start

PARTS = {"position": "xyz", "attitude": "wxyz", "V": "uvwpqr"}


@command()
def replay(
    stand: StandGiven,
    *,
    log: FilePath,
    against: Folder | None = None,
    step: int | None = None,
    progress: Progressing = None,
) -> Result:
    """Replay a flight log.

    Repeats every step logged by NAME_recorder.c, and compares each state with the log's, bit for bit. The log is
    binary, or text of a serial console with lines @89a0.... Columns are the states after each step.

    Exit status 1 if a state differs or the log is damaged; an end in the middle of a record is only noted.

    Args:
        stand: the stand file.
        log: replay this flight log.
        against: replay the C in this folder, which was used in flight; default newly generated C.
        step: show this step, as a line for `eval` and all bits in hex.

    Raises:
        UsageError: no flight log, no such step.
        CheckError: the log is of another stand, or of another default table.
    """
    from mahovik.core.stand.structure import under_name
    from mahovik.out.api.stands import Stand
    from mahovik.use.simulate import replay as replays

    log = Path(log)
    data, notes = replays.load(log)
    records = list(replays.records(data))
    starts = [record for record in records if isinstance(record, replays.Start)]
    if not starts:
        raise UsageError(f"{log}: " + "; ".join(r.message for r in records if isinstance(r, replays.Damage)))
    flown = Stand.of(stand)
    model = under_name(flown, starts[0].stand, starts[0].physics) or flown
    for start in starts:
        replays.check_stand(model, start, str(stand))
        if start.real != starts[0].real:
            raise UsageError(f"{log}: begins with {starts[0].real}, at byte {start.offset} it has {start.real}")
    machine = replays.c_machine(model, starts[0].real, None if against is None else Path(against))
    outcomes: list[Outcome] = []
    damage: list[replays.Damage] = []
    for done, event in enumerate(replays.replay(machine, records), start=1):
        if isinstance(event, replays.Damage):
            damage.append(event)
        else:
            outcomes.append(event)
        notify(progress, Progress(f"replay {log.name}, records", done, len(records)))
    messages = [f"note: {note}" for note in notes]
    if step is not None:
        outcome = next((row for row in outcomes if row.step.count == step), None)
        if outcome is None:
            raise UsageError(f"step {step}: no such step among those that could be replayed")
        messages += replays.step_dump(outcome, machine.generated.layout.inputs)
    messages += [f"{'note' if part.end else 'error'}: {part.message}" for part in damage]
    return _result(model, machine, starts[0], outcomes, messages, damage)


def _result(
    stand: Stand, machine: Machine, start: Start, outcomes: list[Outcome], messages: list[str], damage: list[Damage]
) -> Result:
    """States after each step, and whether they are those of the log."""
    from mahovik.contract.status import status_words
    from mahovik.use.simulate.replay import explain, members

    last = outcomes[-1] if outcomes else None
    differs = last is not None and not last.equal
    refused = sum(outcome.status < 0 for outcome in outcomes)
    equal = len(outcomes) - differs
    if outcomes:
        more = f", {refused} of them refused, as in the log" if refused else ""
        first, end = outcomes[0].step.count, outcomes[-1].step.count - differs
        all_ = "" if differs else "all "
        messages.append(f"{all_}{equal} steps bit for bit: {stand.name}, {start.real}, steps {first} to {end}{more}")
    elif not damage:
        messages.append("no step in the log")
    if last is not None and differs:
        messages += [
            f"error: step {last.step.count} differs: {last.difference}",
            f"error: {explain(machine, stand, start)}",
        ]
    names = [s.name for s in stand.flywheels]
    columns = [
        column("step", "", [outcome.step.count for outcome in outcomes]),
        column("status", "", [status_words(outcome.status) for outcome in outcomes]),
    ]
    for name in members(start.flywheels):
        rows = np.array([outcome.after[name] for outcome in outcomes], dtype=np.float64)
        columns.append(column(name, "", rows.reshape(len(outcomes), -1), list(PARTS.get(name, names))))
    meta = {
        "stand": stand.name, "physics": start.physics, "real": start.real,
        "first_step": outcomes[0].step.count if outcomes else None, "steps_equal": equal, "steps_refused": refused,
        "differs_at": last.step.count if last is not None and differs else None,
        "difference": last.difference if last is not None and differs else None,
        "damage": [part.message for part in damage],
    }  # fmt: skip
    good = not differs and all(part.end for part in damage)
    title = f"{stand.name}, {start.real}"
    details = [*(one.name for one in columns), *meta]
    return Result(title, columns, rows="steps", meta=meta, messages=messages, ok=good, details=details)
