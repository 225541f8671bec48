"""`mahovik verify`: the generated C, or any other program, against the literal reference and the second derivation."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from mahovik.errors import UsageError
from mahovik.out.cli.arguments import (
    console,
    fast_option,
    given,
    lanes_option,
    load_stand,
    real_option,
    stand_argument,
    table,
)
from mahovik.out.cli.json_output import json_option, print_json_text
from mahovik.out.cli.progress import progress

if TYPE_CHECKING:
    from mahovik.core.stand.model import Stand
    from mahovik.proof.verify.report import Report


@click.command()
@stand_argument
@click.option("--states", default=200, show_default=True, type=click.IntRange(1, 1_000_000), help="Number of states.")
@click.option("--seed", default=1, show_default=True, type=click.IntRange(0), help="Seed of the random states.")
@json_option("Print the table as JSON.")
@click.option("--junit", metavar="FILE", type=click.Path(), help="Also write the table as JUnit XML.")
@click.option(
    "-o", "worst", metavar="FILE", type=click.Path(), help="Worst states, for `eval`; default on failure only."
)
@click.option("--against", metavar="DIR", type=click.Path(), help="Judge the C in this folder, not a fresh copy.")
@click.option(
    "--with", "command", metavar="COMMAND", help="Judge a program that reads states; {stand}: the stand file."
)
@click.option(
    "--want", metavar="NAME,...", help="Wants that the program of --with must offer; default: those it offers."
)
@click.option(
    "--timeout", default=300.0, show_default=True, type=click.FloatRange(0.1), help="Time limit of --with, s."
)
@click.option("--judges", is_flag=True, help="Judge by Pinocchio, MuJoCo and, if possible, Basilisk.")
@click.option("--rigorous", is_flag=True, help="The true error of the C, by enclosures of the exact answer.")
@click.option("--bare", is_flag=True, help="With --judges: the stand without fluid, stream, suspension, legs.")
@click.option(
    "--targets",
    metavar="NAME,...",
    help="Check for the same bits on processors: all, quick, m7,rv64gc,...; both element types.",
)
@real_option
@lanes_option
@fast_option
def verify(
    stand_file: str,
    states: int,
    seed: int,
    as_json: bool,
    junit: str | None,
    worst: str | None,
    against: str | None,
    command: str | None,
    want: str | None,
    timeout: float,
    judges: bool,
    targets: str | None,
    bare: bool,
    rigorous: bool,
    real: str,
    lanes: int | None,
    fast: bool,
) -> None:
    """Judge C or any program by the reference.

    Generates the C of a stand, compiles it with warnings as errors, evaluates random and extreme states, and compares
    every quantity with the literal reference (worst), and that with the second derivation (second; between: it and the
    C), relative to its natural scale. Exit status 0 only if all agree.
    """
    if real == "float" and (judges or command is not None):
        raise UsageError("--real float: only for the generated C, not with --judges, --with")
    if (lanes is not None or fast) and (judges or command is not None):
        raise UsageError("--lanes, --fast: only for the generated C, not with --judges, --with")
    if fast and targets is not None:
        raise UsageError("--fast: its bits are not reproducible, so not with --targets, which compares them")
    if command is not None and against is not None:
        raise UsageError("--with, --against: give only one of them")
    if judges and (command is not None or against is not None):
        raise UsageError("--judges judges a fresh copy: not with --with, --against")
    if bare and not judges:
        raise UsageError("--bare needs --judges")
    if want is not None and command is None:
        raise UsageError("--want needs --with")
    if rigorous and (judges or command is not None or targets is not None):
        raise UsageError("--rigorous measures the C: not with --judges, --with, --targets")
    if targets is not None:
        if judges or command is not None or against is not None or worst is not None:
            raise UsageError("--targets runs the self-test of a fresh copy: not with --judges, --with, --against, -o")
        from mahovik.out.cli.targets import verify_on_targets

        reals = (real,) if given("real") else None
        sweep = states if given("states") else None
        verify_on_targets(load_stand(stand_file), targets, reals, sweep, as_json, junit, lanes or 1)
        return
    wants = read_wants(want)
    stand = load_stand(stand_file)
    if rigorous:
        from mahovik.out.cli.rounding import verify_rigorously

        measured = verify_rigorously(stand, seed, states, against, real, as_json).report
        _conclude(measured, as_json, junit, worst)
        return
    if judges:
        from mahovik.proof.verify.judges.compare import verify_judges

        with progress(f"judge {stand.name}", states) as stage:
            found = verify_judges(stand, seed=seed, count=states, bare=bare, progress=stage.at)
    elif command is not None:
        from mahovik.proof.verify.foreign import verify_program

        with progress(f"judge {command}"):
            found = verify_program(stand, command, stand_file, wants=wants, seed=seed, count=states, timeout=timeout)
    else:
        found = _verify_c(stand, seed, states, against, real, lanes, fast)
    finish(found, as_json, junit, worst)


def read_wants(text: str | None) -> tuple[str, ...]:
    """The wants of `--want`. Raises UsageError."""
    if text is None:
        return ()
    from mahovik.contract.functions import WANTS
    from mahovik.nearest import meant

    names = tuple(dict.fromkeys(name.strip() for name in text.split(",")))
    for name in names:
        if name not in WANTS:
            raise UsageError(f'--want: unknown "{name}"{meant(name, WANTS)}')
    return names


def _verify_c(
    stand: Stand, seed: int, states: int, against: str | None, real: str, lanes: int | None, fast: bool
) -> Report:
    from mahovik.proof.verify.harness import verify_c

    with progress(f"verify {stand.name}", states) as stage:
        return verify_c(
            stand,
            seed=seed,
            count=states,
            against=None if against is None else Path(against),
            real=real,
            lanes=lanes,
            fast=fast,
            progress=stage.at,
        )


def finish(
    found: Report,
    as_json: bool,
    junit: str | None,
    worst: str | None,
    more: Mapping[str, Any] | None = None,
    words: Sequence[str] = (),
) -> None:
    """Print the report, and exit with its verdict.

    `more` is added to the JSON, `words` are printed as lines below the table.
    """
    from mahovik.proof.verify.report import as_json as json_text

    if as_json:
        print_json_text(json_text(found, more))
    else:
        _print(found)
        for line in words:
            click.echo(line)
    _conclude(found, as_json, junit, worst)


def _conclude(found: Report, as_json: bool, junit: str | None, worst: str | None) -> None:
    """Write the requested files, and exit with the verdict as status."""
    if found.error:
        click.echo(f"error: {found.error}", err=True)
    try:
        _write(found, as_json, junit, worst)
    except UsageError as error:
        if found.passed:
            raise
        click.echo(f"error: {error}", err=True)  # the verdict is more important
    if not found.passed:
        raise SystemExit(1)


def _write(found: Report, as_json: bool, junit: str | None, worst: str | None) -> None:
    from mahovik.proof.verify.files import write
    from mahovik.proof.verify.report import as_junit, worst_lines

    if junit is not None:
        write(Path(junit), as_junit(found))
    lines = worst_lines(found)
    if lines and (worst is not None or not found.passed):
        target = Path(worst) if worst is not None else Path(f"{found.stand}-worst.jsonl")
        write(target, lines)
        click.echo(f"worst states: {click.format_filename(target)}", err=as_json)


def _print(found: Report) -> None:
    from rich.text import Text

    from mahovik.contract.functions import WANTS
    from mahovik.proof.verify.report import conclusion, one_bound

    out = console()
    third = any(row.second is not None for row in found.rows)
    head = f"{found.judged} of {found.stand}   structure {found.structure}, physics {found.physics}   seed {found.seed}"
    out.print(Text(head))
    if found.left_out:
        out.print(Text(f"the stand without: {', '.join(found.left_out)}", "yellow"))
    pairs = ("second>", "between>") if third else ()
    bound = () if one_bound(found) else ("accepted>",)
    by = "judge" if any(row.want and row.want not in WANTS for row in found.rows) else "want"
    rows = table("quantity", by, "states>", "worst>", *bound, *pairs, "at state", "verdict")
    for row in found.rows:
        judged = row.verdict in ("ok", "FAILED") and row.want
        style = "green" if row.verdict == "ok" else "red" if row.failed else "yellow"
        verdict = Text(row.verdict, style)
        for words in (row.disagreement, row.reason):
            if words:
                verdict.append(f"  {words}")
        rows.add_row(
            Text(row.quantity),
            row.want,
            str(row.states) if row.states else "",
            f"{row.worst:.1e}" if judged else "",
            *(f"{row.tolerance:.0e}" if judged and row.tolerance else "" for _ in bound),
            *("" if off is None else f"{off:.1e}" for off in (row.second, row.between) if third),
            Text(row.state),
            verdict,
        )
    if found.rows:
        out.print(rows)
    out.print(Text("FAILED" if found.error else conclusion(found), "bold green" if found.passed else "bold red"))
