"""`mahovik rest`: static equilibrium of a stand."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import click

from mahovik.errors import UsageError
from mahovik.out.cli.arguments import console, load_stand, stand_argument, table
from mahovik.out.cli.json_output import json_option, print_json

if TYPE_CHECKING:
    from mahovik.core.stand.model import Stand
    from mahovik.use.study.rest import Rest


@click.command()
@stand_argument
@click.option(
    "--phase", "phases", multiple=True, metavar="NAME=ANGLE", help='Phase of a flywheel, "w1=90 deg"; default 0.'
)
@json_option("Print JSON; `simulate --start` reads it.")
def rest(stand_file: str, phases: tuple[str, ...], as_json: bool) -> None:
    """Find the static equilibrium.

    Flywheels are at rest at their phases; no run-time wrench acts. Exit status 1 if there is no equilibrium.
    """
    stand = load_stand(stand_file)
    phi = read_phases(stand, phases)
    from mahovik.use.study.rest import rest as find

    found = find(stand, phi)
    if as_json:
        from mahovik.proof.verify.evaluate import state_object

        free = [list(direction) for direction in found.free]
        state = state_object(found.state)
        values = {"name": stand.name, "state": state, "V_dot": found.V_dot, "free": free, "unstable": found.unstable}
        print_json(values)
        return
    _print(found, stand)


def read_phases(stand: Stand, given: tuple[str, ...]) -> list[float]:
    """Phases (rad) by flywheel. Raises UsageError."""
    from mahovik.contract.quantities import BOUNDS
    from mahovik.core.stand.units import ANGLE, QuantityError, number
    from mahovik.nearest import meant

    names = [s.name for s in stand.flywheels]
    phi = [0.0] * len(names)
    for each in given:
        name, _, text = each.partition("=")
        if name not in names:
            raise UsageError(f'--phase {each}: unknown flywheel "{name}"{meant(name, names, "the stand has none")}')
        try:
            phi[names.index(name)] = float(text)
        except ValueError:
            try:
                phi[names.index(name)] = number(text, ANGLE)
            except QuantityError as error:
                raise UsageError(f"--phase {each}: {error}") from None
        if not abs(phi[names.index(name)]) <= BOUNDS["MAX_PHASE"].value:
            raise UsageError(f"--phase {each}: out of range")
    return phi


def plain(x: float, digits: int = 9) -> float:
    """Rounded for print, without a negative zero."""
    return round(x, digits) + 0.0


def _print(found: Rest, stand: Stand) -> None:
    out = console()
    state = found.state
    turn = 2 * math.degrees(
        math.atan2(math.hypot(*(state.quaternion or (1, 0, 0, 0))[1:]), (state.quaternion or (1,))[0])
    )
    out.print(f"[bold]{stand.name}[/bold] rests, turned by {turn:.6g} deg from E0")
    rows = table("position of O1 in E0, m", "quaternion", "remaining V_dot>")
    rows.add_row(
        "  ".join(f"{plain(x):.9f}" for x in state.position),
        "  ".join(f"{plain(x):.9f}" for x in state.quaternion or ()),
        f"{max(map(abs, found.V_dot)):.2g}",
    )
    out.print(rows)
    if found.free:
        free = table("free to", "shift in E1: x", "y", "z", "turn about an axis in E1: x", "y", "z")
        for direction in found.free:
            kinds = ("shift",) * any(direction[:3]) + ("turn",) * any(direction[3:])
            free.add_row(" and ".join(kinds), *(f"{plain(x, 6):.6g}" for x in direction))
        out.print(free)
    if found.unstable:
        out.print("warning: unstable, the stand would leave this pose", style="yellow")
