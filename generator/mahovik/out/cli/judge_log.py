"""`mahovik judge-log`: the log of a self-test from a real board."""

from __future__ import annotations

from pathlib import Path

import click

from mahovik.errors import UsageError
from mahovik.out.cli.options import JSON, STAND_FILE_OR_NONE, command, load_stand, names_of_functions, option
from mahovik.out.cli.output import print_json
from mahovik.out.cli.stand_first import FURTHER, STAND, needed_option, stand_first


@command("judge-log")
def judge_log(
    stand_file: str | None = STAND_FILE_OR_NONE,
    further: tuple[str, ...] = FURTHER,
    log_file: str | None = needed_option("--log", "LOG", "Judge this output of the self-test on the board."),
    only: tuple[str, ...] | None = option(
        "--only",
        "Judge the log of these functions, or all, as `generate --only` was given; default: those of its default.",
        metavar="NAME,NAME|all",
        parse=names_of_functions,
    ),
    as_json: bool = JSON,
) -> None:
    """Judge the log of a self-test from a board.

    Every function must report PASS. With the stand file, the identities must match it, no function may be missing, and
    the hashes of the sweep must be those of this machine. Text added by a serial terminal is ignored. The name of
    `generate --prefix` is read from the log; functions other than those by default need --only, since a log that lost
    lines looks like one.
    Exit status 0 only if every check passed.
    """
    from mahovik.core.stand.content import TABLE, content
    from mahovik.errors import CheckError
    from mahovik.proof.verify.selftest import judge_log as judge

    stand_file, (log,) = stand_first(stand_file, further, {"--log": log_file}, former=("--log", STAND), least=1)
    text = content(Path(log), TABLE).decode("utf-8", "replace")
    if only is not None and stand_file is None:
        raise UsageError("--only: found no stand file, expected STAND.toml, from which the functions are generated")
    found = judge(text, log, load_stand(stand_file) if stand_file is not None else None, only or ())
    if as_json:
        print_json(
            {
                "runs": [
                    {
                        "stand": run.stand,
                        "real": run.real,
                        "structure": run.structure,
                        "physics": run.physics,
                        "functions": sorted(run.functions),
                        "sweep": run.sweep,
                    }
                    for run in found.runs
                ],
                "problems": found.problems,
                "checked": found.checked,
                "unchecked": found.unchecked,
            }
        )
    if found.problems:
        raise CheckError("\n".join(f"{click.format_filename(log)}: {line}" for line in found.problems))
    for run in () if as_json else found.runs:
        states = f"{len(run.functions)} functions, {run.sweep} states"
        click.echo(f"PASS   {run.stand} {run.real}, structure {run.structure}, physics {run.physics}: {states}")
    if not as_json:
        click.echo(f"checked: {'; '.join(found.checked)}")
        for line in found.unchecked:
            click.echo(f"not checked: {line}")
    if stand_file is not None and found.unchecked:
        raise SystemExit(1)
