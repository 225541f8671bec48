"""`mahovik judge-log`: the log of a self-test from a real board."""

from __future__ import annotations

from pathlib import Path

import click

from mahovik.out.cli.arguments import load_stand
from mahovik.out.cli.json_output import json_option, print_json


@click.command("judge-log")
@click.argument("log", metavar="LOG", type=click.Path())
@click.argument("stand_file", metavar="[STAND.toml]", type=click.Path(), required=False)
@json_option()
def judge_log(log: str, stand_file: str | None, as_json: bool) -> None:
    """Judge the log of a self-test from a board.

    Every function must report PASS. With the stand file, the identities must match it, no function may be missing, and
    the hashes of the sweep must be those of this machine. Text added by a serial terminal is ignored.
    Exit status 0 only if every check passed.
    """
    from mahovik.core.stand.content import TABLE, content
    from mahovik.errors import CheckError
    from mahovik.proof.verify.judge_log import judge_log as judge

    text = content(Path(log), TABLE).decode("utf-8", "replace")
    found = judge(text, log, load_stand(stand_file) if stand_file is not None else None)
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
