"""Times of mahovik's C and of other programs, on the same states in one process: bench/mahovik_bench.

The other programs have an environment of their own, .venv-bench (`make bench`).
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
import timeit
from argparse import Namespace
from collections.abc import Callable, Iterator
from typing import Any

from campaigns import ROOT, Row, Rows, Table

OPTIONS = {"sizes": "2,6,8,12", "repetitions": 200, "budget": 330.0}
"""Numbers of flywheels; repetitions; seconds after which no compiling is begun."""

COLUMNS = {
    "work": "`{}`", "flywheels": "{}", "program": "{}", "least": "{:,.0f}", "median": "{:,.0f}", "chained": "{:,.0f}",
    "ratio": "{:.2f}", "instructions": "{:,.0f}", "difference": "{:.0e}", "code": "{:,}", "compiled": "{:.1f}",
    "generated": "{:.1f}",
}  # fmt: skip
"""Times of a call in ns: least, median, and where each call waits for the one before; bytes; seconds."""

SCALAR, NATIVE, BATCH = "mahovik -O2", "mahovik -O3 native", "mahovik batch native"
MAHOVIK = (SCALAR, NATIVE, BATCH)


def measure(options: Namespace) -> Iterator[tuple[Any, ...]]:
    """A row for each work, number of flywheels and program."""
    sys.path.append(str(ROOT / "bench"))
    from mahovik_bench.run import PROGRAMS
    from mahovik_bench.run import measure as rows

    sizes = [int(word) for word in options.sizes.split(",")]
    for row in rows(sizes, tuple(PROGRAMS), options.repetitions, options.budget, print):
        yield tuple(row.get(title) for title in COLUMNS)


def by_size(rows: Rows) -> Rows:
    """Least times by number of flywheels: of our builds, and of every other program its fastest."""
    sizes = sorted({row["flywheels"] for row in rows})
    table: dict[tuple[str, str], dict[str, Any]] = {}
    for row in rows:
        program = row["program"]
        name = program if program in MAHOVIK else program.split()[0]
        if row["least"] is not None and name != "mahovik":
            head = {"work": row["work"], "program": name}
            line = table.setdefault((row["work"], name), head | dict.fromkeys(f"N = {N}" for N in sizes))
            key = f"N = {row['flywheels']}"
            line[key] = row["least"] if line[key] is None else min(line[key], row["least"])
    places = {work: place for place, work in enumerate(dict.fromkeys(row["work"] for row in rows))}
    return sorted(table.values(), key=lambda line: places[line["work"]])


def claim(rows: Rows) -> str:
    """Times of the scalar C for eight flywheels, beside the fastest other program."""
    lines = [line for line in by_size(rows) if line["N = 8"] is not None]
    words = []
    for work in ("forward", "coupled", "torque"):
        (scalar,) = (line for line in lines if (line["work"], line["program"]) == (work, SCALAR))
        peers: list[Row] = [line for line in lines if line["work"] == work and line["program"] not in MAHOVIK]
        fastest = min(peers, key=lambda line: line["N = 8"])
        words.append(f"`{work}` {scalar['N = 8']:.0f} ns ({fastest['program']}: {fastest['N = 8']:.0f})")
    (batch,) = (line["N = 8"] for line in lines if (line["work"], line["program"]) == ("forward", BATCH))
    return (
        f"With eight flywheels a call takes, beside the fastest other program, {', '.join(words)}; `forward` of a "
        f"state in a batch {batch:.0f} ns"
    )


NOTE = (
    "Least time of independent calls, ns, by number of flywheels N; of every other program its fastest build, *-O2* "
    "and *native* are flags of the compiler. A free carrier without gravity and fluid; all programs are in one "
    "process, get the same states and take turns. The others solve more general problems: Pinocchio and MuJoCo take "
    "any tree of joints at run time, and RNEA and `mj_inverse` give the wrench on the carrier as well. mahovik checks "
    "every input of every call, the others check none. CasADi, SymPy and SymForce are given the literal equations."
)


SECONDS, LEAST_RATIO = 8, 5.0
"""Simulated seconds; how many times the script `Model.simulate` is to be faster, start and files left out."""


def measure_exciters(options: Namespace) -> Iterator[tuple[Any, ...]]:
    """Least times of the two exciters of docs/howto/two-exciters.md: of the whole process, and of the integration."""
    sys.path.append(str(ROOT / "bench"))
    import numpy as np
    from mahovik_bench import exciters

    import mahovik
    from mahovik import stands

    stand, regime = stands.path("two_exciters"), str(stands.servo_and_regime("two_exciters")["regime"])
    times, model = np.arange(100 * SECONDS + 1) / 100.0, mahovik.build(mahovik.load(stand))
    with tempfile.TemporaryDirectory() as folder:
        script = [sys.executable, exciters.__file__, str(stand), str(SECONDS), f"{folder}/script.csv"]
        command = [sys.executable, "-m", "mahovik", "simulate", str(stand), "--regime", regime]
        command += ["--until", str(SECONDS), "--every", "0.01", "-o", f"{folder}/run.csv"]
        wholes = [
            _least(lambda line=line: subprocess.run(line, check=True, capture_output=True))
            for line in (script, command)
        ]
    curves = exciters.curves_of(stand)
    inside = [
        _least(lambda: exciters.lagrange(2.5, curves, SECONDS, times, exciters.RTOL)),
        _least(lambda: model.simulate(SECONDS, regime=regime, every=0.01)),
    ]
    yield "SciPy script", wholes[0], 1.0, inside[0], 1.0
    yield "mahovik", wholes[1], wholes[0] / wholes[1], inside[1], inside[0] / inside[1]


def _least(work: Callable[[], Any], times: int = 5) -> float:
    """Least time of some, s."""
    return min(timeit.repeat(work, number=1, repeat=times))


def exciters_claim(rows: Rows) -> str:
    """How many times faster than the script."""
    _, ours = rows
    return (
        f"Eight seconds of two exciters with motor curves take {ours['whole process']:.2f} s by `mahovik simulate`, "
        f"{ours['ratio']:.1f} times less than a script on SciPy's `solve_ivp`, and {ours['integration']:.2f} s, "
        f"{ours['its ratio']:.0f} times less, by `Model.simulate`"
    )


EXCITERS = {
    "program": "{}", "whole process": "{:.2f}", "ratio": "{:.1f}", "integration": "{:.3f}", "its ratio": "{:.1f}",
}  # fmt: skip
EXCITERS_NOTE = (
    "The script (bench/mahovik_bench/exciters.py) has Lagrange's equations of the plane motion, by hand, and is as "
    "accurate. The whole process has start, reading and a CSV file of the motion; seconds, the least of five."
)

TABLES = {
    "times": Table(measure, COLUMNS, claim, note=NOTE, shown=by_size),
    "exciters": Table(
        measure_exciters, EXCITERS, exciters_claim, note=EXCITERS_NOTE,
        good=lambda row: row["program"] != "mahovik" or row["its ratio"] >= LEAST_RATIO,
    ),
}  # fmt: skip
