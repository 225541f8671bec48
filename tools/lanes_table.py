"""What lanes are worth: instructions and time of forward and coupled, by lanes and flags, into docs/results/lanes.md.

python tools/lanes_table.py [--flywheels 2,8,64,1000] [--print]

Instructions are callgrind's, of C for x86-64-v3 (AVX2), the same on every machine; times are of this one.
"""

from __future__ import annotations

import os
import subprocess
import tempfile
import time
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from random import Random

import campaign
import numpy as np
from kept import Campaign, Columns, Figures, Measured

from mahovik.core.emit.generate import LANES, Generated, generate_all
from mahovik.core.stand.model import Stand
from mahovik.core.stand.random import BARE, random_stand
from mahovik.core.toolchain.board import build, version
from mahovik.core.toolchain.callgrind import instructions_of_host
from mahovik.core.toolchain.compiler import BITS, FAST
from mahovik.core.toolchain.footprint import STACK_FLAGS, footprint
from mahovik.core.toolchain.targets import TARGETS
from mahovik.core.toolchain.workload import workload
from mahovik.proof.cost.measure import measuring_states
from mahovik.proof.verify.bounds import DOUBLE
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.draw import draw
from mahovik.proof.verify.harness import judge

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
    """Instructions of one call of each of FUNCTIONS, by callgrind."""
    program = replace(made.program, functions=tuple(_functions_to_count(made)))
    text = workload(program, measuring_states(made.program)[:1])
    with tempfile.TemporaryDirectory(prefix="mahovik-") as folder:
        lines = instructions_of_host(COUNTED, made.files, text, Path(folder))
    return {line.function: round(line.instructions / line.calls) for line in lines}


def _functions_to_count(made: Generated) -> Iterator[object]:
    """The functions of the program; of the public ones those that are counted."""
    for f in made.program.functions:
        yield f if f.name in FUNCTIONS or not f.public else replace(f, public=False)


TABLE = Columns(
    {
        "N, lanes": "{}, {}",
        **{f"`{f}` instructions, AVX2": "{:,}" for f in FUNCTIONS},
        **{f"`{f}` ns, {name}": "{:,.0f}" for f in FUNCTIONS for name, _ in BUILDS},
    }
)


def measure(flywheels: int) -> list[tuple[object, ...]]:
    """One row for each number of lanes."""
    stand, rows = stand_of(flywheels), []
    for lanes in LANES:
        made = generate_all(stand, "double", lanes)
        counts = instructions(made)
        found = [times(made, flags, flywheels) for _, flags in BUILDS]
        spent = [ns[i] for i in range(len(FUNCTIONS)) for ns in found]
        rows.append(((flywheels, lanes), *(counts[name] for name in FUNCTIONS), *spent))
        print(*rows[-1], sep="   ", flush=True)
    return rows


def describe(flywheels: int) -> Figures:
    """Cost of a stand of very many flywheels."""
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
    return {
        "flywheels": flywheels,
        "facts": {
            "text of the C, kB": f"{sum(map(len, made.files.values())) / 1000:,.0f}",
            "program and C, generated, s of processor": f"{spent:.1f}",
            "code, bytes": f"{size.text:,}",
            "table, bytes": f"{size.constants[f'{stand.name}_default']:,}",
            **{f"stack of `{f}`, bytes": f"{n:,}" for f, n in stack.items()},
            **{f"`{r.quantity}` of `{r.want}` off the NumPy reference": f"{r.worst:.1e}" for r in rows},
        },
    }


def page(found: Figures) -> str:
    """Both tables."""
    text = f"{found['compiler']}, {found['processor']}; load when begun {found['load']:.0f}.\n\n"
    text += TABLE.text(found["rows"])
    for many in found["many"]:
        head = [f"{many['flywheels']:,} flywheels, 4 lanes", ""]
        text += "\n" + campaign.table(head, [list(fact) for fact in many["facts"].items()])
    return text


def sample(found: Figures, rng: Random) -> Iterator[Measured]:
    """Instructions of three rows; another release of the compiler may take some more or less."""
    for row in rng.sample([row for row in found["rows"] if row["N, lanes"][0] <= 64], 3):
        flywheels, lanes = row["N, lanes"]
        now = instructions(generate_all(stand_of(flywheels), "double", lanes))
        for name in FUNCTIONS:
            kept = row[f"`{name}` instructions, AVX2"]
            yield Measured(f"{flywheels} flywheels, {lanes} lanes, {name}", kept, now[name], 1.02)


CAMPAIGN = Campaign(
    "lanes",
    campaign.Block("docs/results/lanes.md", "lanes: tools/lanes_table.py"),
    page,
    ("proof/cost", "proof/verify", "lanes_table.py", "lanes_clock.c"),
    sample,
)


def main() -> None:
    """Writes the tables between the marks of the page."""
    parser = campaign.parser(__doc__, flywheels=f"2,8,64,{MANY}")
    parser.add_argument("--print", action="store_true", help="to the terminal, not into the page")
    given = parser.parse_args()
    counts = [int(word) for word in given.flywheels.split(",")]
    found = {
        "compiler": version("gcc"),
        "processor": campaign.processor(),
        "load": os.getloadavg()[0],
        "rows": TABLE.rows(row for n in counts for row in measure(n)),
        "many": [describe(n) for n in counts if n >= MANY],
    }
    if given.print:
        print(page(found))
        return
    CAMPAIGN.keep(found)


if __name__ == "__main__":
    main()
