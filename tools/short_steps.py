"""What rounding takes from a million short steps in float, without and with a carry: docs/results/short-steps.md.

python tools/short_steps.py [--print]
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import campaign
import numpy as np
from kept import Campaign, Columns, Figures

import mahovik
from mahovik.core.stand.state import State, rest_state
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.functions.carries import end_of_steps

STEPS, DT = 1_000_000, 1e-4
POSITION, SPEED, TORQUE, V, OMEGA = 200.0, 100.0, 1e-4, 5e-3, 1e-3  # m, rad/s, N m, m/s, rad/s

FORMS = (("double", "step"), ("float", "step"), ("float", "step_carried"))
"""The first is what the others are compared with."""


def start() -> State:
    """sat4 200 m from the origin, its wheels turning."""
    rest = rest_state(mahovik.example("sat4"))
    moving = replace(rest, position=(POSITION, 0.0, 0.0), V=(V, 0.0, 0.0, OMEGA, 0.0, 0.0))
    return replace(moving, phi=(-1.0, -1 / 3, 1 / 3, 1.0), phi_dot=(SPEED,) * 4, tau=(TORQUE,) * 4)


def errors(end: dict[str, Any], exact: dict[str, Any]) -> dict[str, float]:
    """Distance of a state from the exact one, by quantity."""
    off = {name: np.asarray(end[name]) - np.asarray(exact[name]) for name in exact}
    turns = np.angle(np.exp(1j * off["phi"]))
    return {
        "position": float(np.linalg.norm(off["position"])),
        "attitude": 2.0 * float(np.linalg.norm(off["attitude"])),
        "omega": float(np.linalg.norm(off["V"][3:])),
        "speeds": float(np.max(np.abs(off["phi_dot"]))),
        "phases": float(np.max(np.abs(turns))),
    }


def measure() -> list[dict[str, Any]]:
    """One row for each quantity."""
    state = start()
    backends = {real: CBackend(mahovik.example("sat4"), real) for real in ("double", "float")}
    ends = [end_of_steps(backends[real], name, state, STEPS * DT, STEPS, 4) for real, name in FORMS]
    exact = ends[0]
    sizes = {
        "position": f"{V * STEPS * DT:.2g} m",
        "attitude": "a turn",
        "omega": f"{np.linalg.norm(exact['V'][3:]):.2g} rad/s",
        "speeds": f"{max(exact['phi_dot']):.5g} rad/s",
        "phases": f"{SPEED * STEPS * DT / (2 * np.pi):.2g} turns",
    }
    plain, carried = (errors(end, exact) for end in ends[1:])
    units = {"position": "m", "omega": "rad/s", "speeds": "rad/s"}
    return TABLE.rows(
        (name, sizes[name], *([f"{found[name]:.1e}", units.get(name, "rad")] for found in (plain, carried)))
        for name in sizes
    )


TABLE = Columns({"quantity": "{}", "moved by": "{}", "error of `step`": "{} {}", "of `step_carried`": "{} {}"}, 2)


def page(found: Figures) -> str:
    """The table."""
    return (
        f"`sat4` {POSITION:g} m from the origin, moving at {V * 1e3:g} mm/s, its four wheels at {SPEED:g} rad/s and "
        f"driven by {TORQUE * 1e3:g} mN m each: {STEPS:,} steps of {DT:g} s and order 4, in `float`; compared with "
        f"`{FORMS[0][1]}` in `double`.\n\n{TABLE.text(found['rows'])}"
    )


CAMPAIGN = Campaign(
    "short-steps",
    campaign.Block("docs/results/short-steps.md", "steps"),
    page,
)


def main() -> None:
    """Measures, keeps, renders the page."""
    given = campaign.parser(__doc__, print=False).parse_args()
    found = {"rows": measure()}
    if given.print:
        print(page(found))
    else:
        CAMPAIGN.keep(found)


if __name__ == "__main__":
    main()
