"""What `forward` of held carriers costs beside that of the free one: docs/results/held.md.

python tools/held_cost.py [--print]
"""

from __future__ import annotations

import re
import subprocess
import tempfile
from dataclasses import replace
from pathlib import Path
from typing import Any

import campaign
from kept import Campaign, Columns, Figures

import mahovik
from mahovik.core.emit.generate import generate_all
from mahovik.core.stand.hold import FREEDOMS
from mahovik.core.stand.model import Hold, Stand

COMPILER = ("gcc", "-std=c99", "-O2", "-ffp-contract=off")
FUNCTIONS = ("forward", "coupled")
HOLDS: dict[str, tuple[str, ...] | None] = {
    "free": None,
    "hinge": ("pitch",),
    "rail": ("x",),
    "pivot": ("roll", "pitch", "yaw"),
    "plane": ("x", "z", "pitch"),
}

PROGRAM = """#include "NAME.h"
int main(void)
{
    const NAME_state x = {.attitude = {1}, .V = {0, 0, 0, 0, 1, 0}, .phi = {0, 1, 2}, .phi_dot = {100, 90, 80}};
    NAME_real given[3] = {1, 2, 3}, V_dot[6], phi_ddot[3], u_dot[6];
    (void)u_dot;
    if (NAME_forward(&NAME_default, &x, given, V_dotRATES) != 0) { return 1; }
    return NAME_coupled(&NAME_default, &x, given, 0, V_dot, phi_ddotRATES) != 0;
}
"""


def stand_of(name: str) -> Stand:
    """demo3, which has three flywheels, with weight; held about a point below it where it is held."""
    stand = mahovik.example("demo3")
    stand = replace(stand, name="held", gravity=(0.0, 0.0, -9.81))
    ways = HOLDS[name]
    if ways is None:
        return stand
    freedoms = tuple(FREEDOMS[way] for way in ways)
    return replace(stand, hold=Hold(freedoms, (0.0, 0.0, -0.2), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)))


def instructions(name: str) -> dict[str, int]:
    """Instructions of a call of each function, with all that it calls, by callgrind."""
    stand = stand_of(name)
    with tempfile.TemporaryDirectory(prefix="mahovik-") as folder:
        for file, text in generate_all(stand).files.items():
            if file in (f"{stand.name}.c", f"{stand.name}.h"):
                Path(folder, file).write_text(text, encoding="utf-8")
        program = PROGRAM.replace("RATES", "" if stand.hold is None else ", u_dot").replace("NAME", stand.name)
        Path(folder, "main.c").write_text(program, encoding="utf-8")
        plain = f"-D{stand.name.upper()}_PLAIN_NAMES"
        subprocess.run([*COMPILER, plain, "main.c", f"{stand.name}.c", "-o", "main"], cwd=folder, check=True)
        return {function: _count(folder, f"{stand.name}_{function}") for function in FUNCTIONS}


def _count(folder: str, symbol: str) -> int:
    options = ["--tool=callgrind", "--callgrind-out-file=/dev/null", f"--toggle-collect={symbol}"]
    done = subprocess.run(["valgrind", *options, "./main"], cwd=folder, capture_output=True, text=True, check=True)
    (found,) = re.findall(r"Collected : (\d+)", done.stderr)
    return int(found)


def measure() -> list[dict[str, Any]]:
    """A row for each hold."""
    counts = {name: instructions(name) for name in HOLDS}
    free = counts["free"]
    return TABLE.rows(
        (
            name,
            ", ".join(HOLDS[name] or ()),
            *(x for f in FUNCTIONS for x in (counts[name][f], f"{100 * counts[name][f] / free[f]:.0f} %")),
        )
        for name in HOLDS
    )


TABLE = Columns(
    {"carrier": "{}", "freedoms": "{}", "`forward`": "{:,}", "of free": "{}", "`coupled`": "{:,}", "of the free": "{}"},
    2,
)


def page(found: Figures) -> str:
    """The table."""
    return (
        "`demo3` with weight, held about a point below it; instructions of a call by callgrind, "
        f"`{' '.join(COMPILER)}`.\n\n{TABLE.text(found['rows'])}"
    )


CAMPAIGN = Campaign("held", campaign.Block("docs/results/held.md", "held"), page)


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
