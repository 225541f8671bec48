"""`mahovik replay`: a flight log, step by step, bit for bit."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from mahovik.errors import UsageError
from mahovik.out.cli.options import JSON, STAND_FILE_OR_NONE, choice, command, file_option, load_stand, option
from mahovik.out.cli.output import print_json
from mahovik.out.cli.stand_first import FURTHER, STAND, needed_option, stand_first
from mahovik.out.progress import progress

if TYPE_CHECKING:
    from mahovik.core.stand.model import Stand
    from mahovik.use.simulate.flight_log import Damage, Start
    from mahovik.use.simulate.replay import Machine, Outcome


@command()
def replay(
    stand_file: str | None = STAND_FILE_OR_NONE,
    further: tuple[str, ...] = FURTHER,
    log_file: str | None = needed_option("--log", "LOG", "Replay this flight log, binary or text of a console."),
    output: str | None = file_option(
        "-o", "FILE.csv|FILE.jsonl", "Write the states, in columns or as lines for `eval`."
    ),
    wanted: int | None = option(
        "--step", "Show step K, as a line for `eval` and all bits in hex.", metavar="K", type=int
    ),
    tested: int | None = option(
        "--emit-test", "Write NAME_step_K.c, step K as a unit test in C.", metavar="K", type=int
    ),
    against: str | None = file_option("--against", "DIR", "Replay the C in this folder, which was used in flight."),
    backend: str = choice(
        "--backend",
        ["c", "interpreter"],
        "Replay by c, or by interpreter, which needs no compiler and is slow.",
        default="c",
    ),
    as_json: bool = JSON,
) -> None:
    """Replay a flight log.

    Repeats every step logged by NAME_recorder.c, and compares each state with the log's, bit for bit. LOG is binary,
    or text of a serial console with lines @89a0.... Without STAND.toml the stand file is found by the name and physics
    in the log: in this folder, beside the log, or among the examples.

    Exit status 1 if a state differs or the log is damaged; an end in the middle of a record is only noted.
    """
    from mahovik.use.simulate import flight_log
    from mahovik.use.simulate import replay as replays
    from mahovik.use.simulate.replay import check_format
    from mahovik.writing import probe

    stand_file, (log,) = stand_first(stand_file, further, {"--log": log_file}, former=("--log", STAND), least=1)
    if output is not None:
        check_format(Path(output))
        probe(Path(output))
    data, notes = flight_log.load(Path(log))
    records = list(flight_log.records(data))
    starts = [r for r in records if isinstance(r, flight_log.Start)]
    if not starts:
        raise UsageError(f"{log}: " + "; ".join(r.message for r in records if isinstance(r, flight_log.Damage)))
    stand, source = _stand(starts[0], stand_file, Path(log))
    for start in starts:
        replays.check_stand(stand, start, source)
        if start.real != starts[0].real:
            raise UsageError(f"{log}: begins with {starts[0].real}, at byte {start.offset} it has {start.real}")
    folder = Path(against) if against is not None else None
    machine = replays.machine(stand, starts[0].real, backend, folder)
    session = _Session(stand, machine, starts[0], wanted, tested, Path(output) if output is not None else None)
    with progress(f"replay {Path(log).name}, records", len(records)) as stage:
        for done, found in enumerate(replays.replay(machine, records), start=1):
            session.take(found)
            stage.at(done)
    session.finish(notes, as_json)


def _stand(start: Start, stand_file: str | None, log: Path) -> tuple[Stand, str]:
    """The stand of a log, and its file. Raises StandError, UsageError."""
    from mahovik import stands
    from mahovik.core.stand.identity import identities
    from mahovik.errors import StandError
    from mahovik.proof.verify.delivery import under_name

    if stand_file is not None:
        stand = load_stand(stand_file)
        return under_name(stand, start.stand, start.physics) or stand, stand_file
    name = f"{start.stand}.toml"
    places = [Path(name), log.parent / name]
    if start.stand in stands.names():
        places.append(Path(stands.path(start.stand)))
    for place in places:
        if not place.is_file():
            continue
        try:
            stand = load_stand(str(place))
        except StandError:
            continue
        if identities(stand).physics == start.physics:
            return stand, str(place)
    raise UsageError(
        f'{log}: of the stand "{start.stand}", physics {start.physics}: no {name} of it here, beside the log or among '
        "the examples; give its stand file"
    )


class _Session:
    """Counts, shows and writes the results of a replay."""

    def __init__(
        self, stand: Stand, machine: Machine, start: Start, wanted: int | None, tested: int | None, output: Path | None
    ) -> None:
        self._stand, self._machine, self._start = stand, machine, start
        self._wanted, self._tested, self._output = wanted, tested, output
        self._lines: list[str] = []
        self._said: list[str] = []
        self._steps = self._refused = 0
        self._first: Outcome | None = None
        self._last: Outcome | None = None
        self._damage: list[Damage] = []

    def take(self, found: Outcome | Damage) -> None:
        """One step, or damage."""
        from mahovik.use.simulate.flight_log import Damage

        if isinstance(found, Damage):
            self._damage.append(found)
            return
        self._first = self._first or found
        self._last = found
        self._steps += 1
        self._refused += found.status < 0
        if self._output is not None:
            self._lines.append(self._state_text(found))
        if found.step.count == self._wanted:
            self._show(found)
            self._wanted = None
        if found.step.count == self._tested:
            self._emit_test(found)
            self._tested = None

    def _state_text(self, found: Outcome) -> str:
        from mahovik.errors import StateError
        from mahovik.use.simulate.replay import check_format, csv_row, eval_line

        assert self._output is not None
        if check_format(self._output) == ".csv":
            return csv_row(found)
        try:
            return eval_line(found, self._machine.generated.layout.inputs) + "\n"
        except StateError as error:
            raise UsageError(f"-o {self._output}: step {found.step.count}: {error}; write .csv instead") from None

    def _show(self, found: Outcome) -> None:
        from mahovik.use.simulate.replay import step_dump

        self._said += step_dump(found, self._machine.generated.layout.inputs)

    def _emit_test(self, found: Outcome) -> None:
        from mahovik.core.emit.replay_test import replay_test
        from mahovik.use.simulate.replay import step_inputs
        from mahovik.writing import write

        path = Path(f"{self._stand.name}_step_{found.step.count}.c")
        name, inputs = step_inputs(self._machine.generated, found.step)
        carry = found.carry_after.tolist() if found.step.carried else None
        if carry is not None:
            inputs["carry"] = found.carry
        before, after = ({k: v.tolist() for k, v in each.items()} for each in (found.before, found.after))
        text = replay_test(
            self._stand, self._machine.generated, path.name, found.step.count,
            name, inputs, before, after, found.status, found.table, carry,
        )  # fmt: skip
        write(path, text)
        self._said.append(f"{path}   step {found.step.count} as a unit test: build it with {self._stand.name}.c")

    def finish(self, notes: list[str], as_json: bool) -> None:
        """Write files and the last line. Exit status 1 if a state differs or something is missing."""
        from mahovik.use.simulate.replay import check_format, csv_heading, explain
        from mahovik.writing import write

        for text in self._said:
            click.echo(text, err=as_json)
        for note in notes:
            click.echo(f"note: {note}", err=True)
        if self._output is not None:
            first = csv_heading(self._start.flywheels) if check_format(self._output) == ".csv" else ""
            write(self._output, first + "".join(self._lines))
            click.echo(f"{click.format_filename(self._output)}   {len(self._lines)} steps", err=as_json)
        for damage in self._damage:
            click.echo(f"{'note' if damage.end else 'error'}: {damage.message}", err=True)
        for asked, missing in (("--step", self._wanted), ("--emit-test", self._tested)):
            if missing is not None:
                raise UsageError(f"{asked} {missing}: no such step among those that could be replayed")
        differs = self._last is not None and not self._last.equal
        if as_json:
            print_json(self._plain(differs))
        if self._last is not None and self._first is not None:
            equal = self._steps - differs
            refused = f", {self._refused} of them refused, as in the log" if self._refused else ""
            click.echo(
                f"{'' if differs else 'all '}{equal} steps bit for bit: {self._stand.name}, {self._start.real}, "
                f"steps {self._first.step.count} to {self._last.step.count - differs}{refused}",
                err=as_json,
            )
            if differs:
                click.echo(f"error: step {self._last.step.count} differs: {self._last.difference}", err=True)
                click.echo(f"error: {explain(self._machine, self._stand, self._start)}", err=True)
        elif not self._damage:
            click.echo("no step in the log", err=as_json)
        if differs or any(not damage.end for damage in self._damage):
            raise SystemExit(1)

    def _plain(self, differs: bool) -> dict[str, Any]:
        first, last = self._first, self._last
        return {
            "stand": self._stand.name,
            "physics": self._start.physics,
            "real": self._start.real,
            "first_step": None if first is None else first.step.count,
            "steps_equal": self._steps - differs,
            "steps_refused": self._refused,
            "differs_at": last.step.count if differs and last is not None else None,
            "difference": str(last.difference) if differs and last is not None else None,
            "damage": [damage.message for damage in self._damage],
        }
