"""`mahovik balance`: correction weights from vibration and influence coefficients."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING

import click

from mahovik.out.cli.options import JSON, choice, command, file_option
from mahovik.out.cli.output import print_json, print_line, print_table, require_other_file

if TYPE_CHECKING:
    from mahovik.out.functions.balancing import Balance


@command()
def balance(
    influence: str = file_option(
        "--influence", "FILE.json", "Read vibration and trial runs, or influence coefficients.", required=True
    ),
    method: str = choice(
        "--method", ["least-squares", "min-max"], "Minimise this of the vibration.", default="least-squares"
    ),
    output: str | None = file_option("-o", "FILE.json", "Write what --json prints."),
    as_json: bool = JSON,
) -> None:
    """Find correction weights of a rotor.

    From the vibration at any number of sensors and speeds before balancing, and with trial weights in any number of
    planes. Angles are those of the weights on the rotor and of the vibration behind its mark, both in degrees.
    """
    if output is not None:
        require_other_file(Path(output), [influence], f"-o {output}", "result")
    from mahovik.out.functions.balancing import balance as find

    found = find(influence, method=method)
    if output is not None:
        from mahovik.writing import write

        write(Path(output), json.dumps(found.to_dict(), indent=1, allow_nan=False) + "\n")
    if as_json:
        print_json(found.to_dict())
    else:
        _print(found)


def _print(found: Balance) -> None:
    """Tables of planes, sensors and pieces."""
    figures = found.to_dict()
    columns, values = ["plane>", "correction>"], [figures["w"]]
    if "add" in figures:
        columns.append("to add to the trial weights>")
        values.append(figures["add"])
    if "made" in figures:
        columns.append("made>")
        values.append(figures["made"]["w"])
    print_table(columns, ((str(k), *row) for k, row in enumerate(zip(*values, strict=True))))
    left = [figures["left"], *([figures["made"]["left"]] if "made" in figures else [])]
    names = ("sensor>", "left>", *(("left by pieces>",) if "made" in figures else ()))
    print_table(names, ((str(m), *row) for m, row in enumerate(zip(*left, strict=True))))
    if "made" in figures:
        rows = []
        for each in figures["made"]["pieces"]:
            numbers = (f"{each[key]:.6g}" for key in ("degrees", "amount", "radius", "count"))
            rows.append((str(each["plane"]), *numbers, "hole" if each["remove"] else "weight"))
        print_table(("plane>", "at, deg>", "amount>", "radius>", "count>", ""), rows)
        if not figures["made"]["proven"]:
            click.echo("warning: the search for pieces was cut: a better choice may exist", err=True)
    before, after = (figures["largest"][key] for key in ("before", "after"))
    bound = f"; no weights leave less than {figures['bound']:.6g}" if "bound" in figures else ""
    print_line(f"largest vibration {before:.6g} before, {after:.6g} after{bound}")
