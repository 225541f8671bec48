"""`mahovik balance`: correction weights from vibration, by influence coefficients or by the model of a stand."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

import click

from mahovik.errors import UsageError
from mahovik.out.cli.options import (
    JSON,
    STAND_FILE_OR_NONE,
    choice,
    command,
    file_option,
    is_given,
    load_stand,
    option,
)
from mahovik.out.cli.output import print_json, print_line, print_table, require_other_file, require_page

if TYPE_CHECKING:
    from mahovik.out.functions.balancing import Balance
    from mahovik.out.functions.correction_planes import PlanesGiven
    from mahovik.out.functions.stand_balancing import StandBalance

CUT = "the search for pieces was cut: a better choice may exist"


@command()
def balance(
    stand_file: str | None = STAND_FILE_OR_NONE,
    influence: str | None = file_option(
        "--influence", "FILE.json", "Read vibration and trial runs, or influence coefficients."
    ),
    method: str = choice(
        "--method",
        ["least-squares", "min-max"],
        "Choose how corrections of --influence are found.",
        default="least-squares",
    ),
    data: tuple[str, ...] = file_option(
        "--data",
        "FILE",
        "Read measured data of the stand at constant speeds.",
        multiple=True,
        reads="measured data",
    ),
    planes: tuple[str, ...] = option(
        "--plane",
        'Set planes of a flywheel, or of "all", at these places on its axis; or by a file, with pieces.',
        metavar="NAME=X,..|FILE.toml",
        multiple=True,
        reads="a file of correction planes",
    ),
    report: str | None = file_option("--report", "FILE.html", "Write a page with charts; needs --data."),
    output: str | None = file_option("-o", "FILE.json", "Write what --json prints."),
    as_json: bool = JSON,
) -> None:
    """Find correction weights of flywheels or of any rotor.

    Of a stand with --data: its flywheels at constant speeds, all at once and without trial weights, by the model.

    Of any rotor with --influence: from the vibration at any number of sensors and speeds before balancing, and with
    trial weights in any number of planes. Angles of corrections are those of the trial weights.
    """
    if (influence is None) == (stand_file is None):
        raise UsageError("give either --influence FILE.json, or STAND.toml with --data FILE")
    if influence is not None and (data or planes or report):
        raise UsageError("--data, --plane, --report: need a stand; --influence takes none of them")
    if stand_file is not None and not data:
        raise UsageError("--data is missing: expected files of measured data of the stand")
    if stand_file is not None and is_given("method"):
        raise UsageError("--method: only with --influence; with --data it is least squares, weighted by noise")
    if output is not None:
        read = [name for name in (influence, stand_file, *data) if name is not None]
        require_other_file(Path(output), read, f"-o {output}", "result")
    if report is not None:
        require_page(report, [name for name in (stand_file, *data) if name is not None])
    from mahovik.out.functions.balancing import balance as by_influence
    from mahovik.out.functions.stand_balancing import balance_stand

    found: Balance | StandBalance
    if influence is not None:
        found = by_influence(influence, method=method)
    else:
        assert stand_file is not None
        found = balance_stand(load_stand(stand_file), data, planes=_planes(planes))
        if report is not None:
            found.report(report)
    if output is not None:
        from mahovik.writing import write

        write(Path(output), json.dumps(found.to_dict(), indent=1, allow_nan=False) + "\n")
    if as_json:
        print_json(found.to_dict())
    elif influence is not None:
        _print(cast("Balance", found))
    else:
        _print_stand(cast("StandBalance", found))


def _planes(given: Sequence[str]) -> PlanesGiven:
    """Planes by flywheel: places as texts with a unit or numbers in m, and tables of files. Raises UsageError."""
    found: dict[str, Sequence[float | str] | Mapping[str, Any]] = {}
    for text in given:
        name, equal, places = text.partition("=")
        if not equal and text.endswith(".toml"):
            from mahovik.out.functions.correction_planes import load_planes

            more = load_planes(Path(text))
        elif equal:
            more = {name: [_place(each.strip()) for each in places.split(",")]}
        else:
            raise UsageError(f"--plane {text}: expected NAME=X,.., as w1=-10mm,10mm, or FILE.toml")
        for key in more:
            if key in found:
                raise UsageError(f"--plane {text}: {key} is given twice")
        found |= more
    return found


def _place(text: str) -> float | str:
    try:
        return float(text)
    except ValueError:
        return text


def _print_stand(found: StandBalance) -> None:
    """Tables of planes, pieces and flywheels, then notes on the data."""
    figures = found.to_dict()
    rows, pieces, wheels, seen = [], [], [], []
    for wheel in figures["flywheels"]:
        name, speed = wheel["name"], f"{wheel['speed']:.6g}"
        for each in wheel["planes"]:
            place = f"{1e3 * each['position']:g}"
            amount, angle = (
                f"{each['correction'][key]:.5g} +- {each['interval'][key]:.2g}" for key in ("g mm", "degrees")
            )
            rows.append((name, place, amount, angle, f"{1e6 * each['residual']:.3g}"))
            for piece in each.get("pieces", ()):
                numbers = (1e3 * piece["amount"] * piece["count"], 1e3 * piece["radius"], piece["degrees"])
                kind = "remove" if piece["remove"] else "add"
                pieces.append((name, place, kind, *(f"{x:.5g}" for x in numbers)))
        static, grade = wheel["static"], wheel["grade"]
        before, left = f"{1e6 * static['before']:.5g}", f"{1e6 * static['residual']:.3g}"
        wheels.append((name, speed, before, left, grade["before"], grade["residual"], f"{wheel['fit']:.3g}"))
        for quantity, change in wheel["vibration"].items():
            full = wheel.get("simulated", {}).get(quantity, {})
            sizes = (f"{x:.4g}" if x is not None else "" for x in (*change.values(), *map(full.get, change)))
            seen.append((name, speed, quantity, *sizes))
    print_table(("flywheel", "plane, mm>", "correction, g mm>", "at, deg>", "residual, g mm>"), rows)
    if pieces:
        print_table(("flywheel", "plane, mm>", "", "mass, g>", "radius, mm>", "at, deg>"), pieces)
    names = ("flywheel", "speed, rad/s>", "static, g mm>", "residual>", "grade", "residual", "fit>")
    print_table(names, wheels)
    names = (
        "flywheel", "speed, rad/s>", "first order", "measured>", "corrected>", "simulated before>", "after>"
    )  # fmt: skip
    print_table(names, seen)
    for wheel in figures["flywheels"]:
        if not wheel.get("proven", True):
            click.echo(f"warning: {wheel['name']}: {CUT}", err=True)
    for note in found.notes:
        print_line(note)


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
            click.echo(f"warning: {CUT}", err=True)
    before, after = (figures["largest"][key] for key in ("before", "after"))
    bound = f"; no weights leave less than {figures['bound']:.6g}" if "bound" in figures else ""
    print_line(f"largest vibration {before:.6g} before, {after:.6g} after{bound}")
