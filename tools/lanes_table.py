"""What lanes are worth: instructions and time of forward and coupled, by lanes and flags, into docs/results/lanes.md.

python tools/lanes_table.py [--flywheels 2,8,64,1000] [--print]

Instructions are callgrind's, of C for x86-64-v3 (AVX2), the same on every machine; times are of this one.
"""

from __future__ import annotations

import os
import subprocess
import tempfile
import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import campaign
import numpy as np

from mahovik.core.emit.generate import LANES, Generated, generate_all
from mahovik.core.stand.model import Stand
from mahovik.core.stand.random import BARE, random_stand
from mahovik.core.toolchain.board import build, version
from mahovik.core.toolchain.callgrind import instructions_of_host
from mahovik.core.toolchain.compiler import BITS, FAST
from mahovik.core.toolchain.footprint import STACK_FLAGS, footprint
from mahovik.core.toolchain.targets import TARGETS
from mahovik.core.toolchain.workload import workload
from mahovik.proof.cost.states import measuring_states
from mahovik.proof.verify.bounds import DOUBLE
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.draw import draw
from mahovik.proof.verify.harness import judge

BLOCK = campaign.Block("docs/results/lanes.md", "lanes: tools/lanes_table.py")

FUNCTIONS = ("forward", "coupled")
MANY = 1000
"""Flywheels from which only one state is counted, and the whole is described as well."""

BUILDS = (
    ("-O2", ("-O2", *BITS)),
    ("-O3 native, same bits", ("-O3", "-march=native", "-fno-tree-slp-vectorize", *BITS)),
    ("--fast", FAST),
)
COUNTED = replace(TARGETS["host-gcc-v3"], optimisation="-O3")


def stand_of(flywheels: int) -> Stand:
    """A carrier with flywheels in free space, general in every number."""
    return random_stand(np.random.default_rng(flywheels), flywheels, BARE, f"lanes{flywheels}")


def times(made: Generated, flags: Sequence[str], flywheels: int) -> list[float]:
    """Least ns of each of FUNCTIONS."""
    name = made.program.name
    with tempfile.TemporaryDirectory(prefix="mahovik-") as folder:
        for file, text in made.files.items():
            (Path(folder) / file).write_text(text, encoding="ascii")
        calls = max(20, 40_000 // flywheels)
        words = (f"-DSTAND={name}", f'-DHEADER="{name}.h"', f"-DFLYWHEELS={flywheels}", f"-DCALLS={calls}")
        sources = (str(campaign.ROOT / "tools" / "lanes_clock.c"), f"{name}.c")
        command = ["gcc", "-std=c99", *flags, "-I.", *words, *sources, "-o", "clock", "-lm"]
        subprocess.run(command, check=True, cwd=folder)
        printed = subprocess.run([f"{folder}/clock"], check=True, capture_output=True, text=True).stdout
    return [float(line) for line in printed.split()]


def instructions(made: Generated) -> dict[str, int]:
    """Of one call of each of FUNCTIONS, by callgrind."""
    program = replace(made.program, functions=tuple(_counted(made)))
    text = workload(program, measuring_states(made.program)[:1])
    with tempfile.TemporaryDirectory(prefix="mahovik-") as folder:
        lines = instructions_of_host(COUNTED, made.files, text, Path(folder))
    return {line.function: round(line.instructions / line.calls) for line in lines}


def _counted(made: Generated) -> Iterator[object]:
    """The functions of the program; of the public ones those that are counted."""
    for f in made.program.functions:
        yield f if f.name in FUNCTIONS or not f.public else replace(f, public=False)


def measured(flywheels: int) -> list[list[str]]:
    """A row a number of lanes."""
    stand, rows = stand_of(flywheels), []
    for lanes in LANES:
        made = generate_all(stand, "double", lanes)
        counts = instructions(made)
        found = [times(made, flags, flywheels) for _, flags in BUILDS]
        cells = [f"{counts[name]:,}" for name in FUNCTIONS]
        cells += [f"{ns[i]:,.0f}" for i in range(len(FUNCTIONS)) for ns in found]
        rows.append([f"{flywheels}, {lanes}", *cells])
        print(" | ".join(rows[-1]), flush=True)
    return rows


def described(flywheels: int) -> str:
    """What a stand of very many flywheels takes."""
    stand = stand_of(flywheels)
    begin = time.process_time()
    made = generate_all(stand, "double", 4)
    spent = time.process_time() - begin
    target = TARGETS["host"]
    with tempfile.TemporaryDirectory(prefix="mahovik-") as name:
        folder = Path(name)
        build(target, {**made.files, "main.c": "int main(void) { return 0; }\n"}, folder, extra=STACK_FLAGS)
        size = footprint("gcc", folder / f"{stand.name}.o")
    backend = CBackend(stand, lanes=4)
    rows = judge(stand, backend, draw(stand, 1, 2, "double"), ("forward", "coupled", "torque"), DOUBLE)
    stack = {f: size.stack_of(f"{stand.name}_{f}") for f in (*FUNCTIONS, "step", "coupled_jacobian")}
    facts: Mapping[str, str] = {
        "text of the C, kB": f"{sum(map(len, made.files.values())) / 1000:,.0f}",
        "program and C, generated, s of processor": f"{spent:.1f}",
        "code, bytes": f"{size.text:,}",
        "table, bytes": f"{size.constants[f'{stand.name}_default']:,}",
        **{f"stack of `{f}`, bytes": f"{n:,}" for f, n in stack.items()},
        **{f"`{r.quantity}` of `{r.want}` off the NumPy reference": f"{r.worst:.1e}" for r in rows},
    }
    return campaign.table([f"{flywheels:,} flywheels, 4 lanes", ""], [list(fact) for fact in facts.items()])


def main() -> None:
    """Writes the tables between the marks of the page."""
    parser = campaign.parser(__doc__, flywheels=f"2,8,64,{MANY}")
    parser.add_argument("--print", action="store_true", help="to the terminal, not into the page")
    given = parser.parse_args()
    counts = [int(word) for word in given.flywheels.split(",")]
    head = ["N, lanes", *(f"`{f}` instructions, AVX2" for f in FUNCTIONS)]
    head += [f"`{f}` ns, {name}" for f in FUNCTIONS for name, _ in BUILDS]
    text = f"{version('gcc')}, {campaign.processor()}; load when begun {os.getloadavg()[0]:.0f}.\n\n"
    text += campaign.table(head, [row for n in counts for row in measured(n)])
    for n in counts:
        text += f"\n{described(n)}" if n >= MANY else ""
    if given.print:
        print(text)
        return
    BLOCK.write(text)


if __name__ == "__main__":
    main()
