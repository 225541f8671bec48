"""`mahovik rest`: static equilibrium of a stand."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from mahovik.errors import UsageError
from mahovik.out.cli.options import STAND_FILE, command, json_option, load_stand, option
from mahovik.out.cli.output import print_json, print_line, print_table

if TYPE_CHECKING:
    from mahovik.core.stand.model import Stand
    from mahovik.use.study.rest import Rest


@command()
def rest(
    stand_file: str = STAND_FILE,
    phases: tuple[str, ...] = option(
        "--phase", 'Set the phase of a flywheel, "w1=90 deg"; default 0.', metavar="NAME=ANGLE", multiple=True
    ),
    as_json: bool = json_option("Print JSON, which `simulate --start` reads."),
) -> None:
    """Find the static equilibrium.

    Flywheels are at rest at their phases; no run-time wrench acts. Exit status 1 if there is no equilibrium.
    """
    stand = load_stand(stand_file)
    phi = read_phases(stand, phases)
    from mahovik.out.functions.equilibrium import rest as find

    found = find(stand, phi)
    if as_json:
        print_json(found.to_dict())
        return
    _print(found.result, stand)


def read_phases(stand: Stand, given: tuple[str, ...]) -> list[float]:
    """Phases (rad) by flywheel. Raises UsageError."""
    from mahovik.contract.quantities import BOUNDS
    from mahovik.core.stand.units import ANGLE, QuantityError, number
    from mahovik.nearest import suggestion

    names = [s.name for s in stand.flywheels]
    phi = [0.0] * len(names)
    for each in given:
        name, _, text = each.partition("=")
        if name not in names:
            raise UsageError(
                f'--phase {each}: unknown flywheel "{name}"{suggestion(name, names, "the stand has none")}'
            )
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
    quaternion = found.state.quaternion or (1.0, 0.0, 0.0, 0.0)
    turn = 2 * math.degrees(math.atan2(math.hypot(*quaternion[1:]), quaternion[0]))
    print_line(f" rests, turned by {turn:.6g} deg from E0", name=stand.name)
    pose = ("  ".join(f"{plain(x):.9f}" for x in part) for part in (found.state.position, quaternion))
    left = f"{max(map(abs, found.V_dot)):.2g}"
    print_table(("position of O1 in E0, m", "quaternion", "remaining V_dot>"), [(*pose, left)])
    if found.free:
        rows = []
        for direction in found.free:
            kinds = ("shift",) * any(direction[:3]) + ("turn",) * any(direction[3:])
            rows.append((" and ".join(kinds), *(f"{plain(x, 6):.6g}" for x in direction)))
        print_table(("free to", "shift in E1: x", "y", "z", "turn about an axis in E1: x", "y", "z"), rows)
    if found.unstable:
        print_line("warning: unstable, the stand would leave this pose", "yellow")
