"""Frama-C Eva on the C of the example stands, and static checks: compilers, analyser, cppcheck with MISRA C:2012.

Outcomes of Eva are kept in build/proofs by the SHA-256 of C, drivers and script: a second run repeats only what has
changed.
"""

from __future__ import annotations

import hashlib
import json
import sys
from argparse import Namespace
from collections import Counter
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict
from pathlib import Path
from typing import Any

from checks import Proof, count_by_rule, findings, prove, warnings_of

from campaigns import CORES, REALS, ROOT, Row, Rows, Table, side_by_side
from mahovik.contract.functions import ALL
from mahovik.core.emit.delivery import delivery
from mahovik.core.emit.eva import Driver, drivers, eva_files
from mahovik.core.emit.generate import generate_all
from mahovik.core.emit.names import VERIFICATION
from mahovik.core.stand import Stand, load, loads
from mahovik.core.toolchain.checks import DEVIATIONS, STANDING_FINDINGS
from mahovik.stands import names, path
from mahovik.writing import write_all

OPTIONS: dict[str, Any] = {"stands": "", "drivers": "", "quick": False, "tried": False, "jobs": CORES}
"""`drivers`: only these, as in the script; `tried`: also functions without a claim; `quick`: QUICK alone."""

QUICK = {
    "demo3": (
        *("any_forward", "any_torque", "any_wrap", "bits_step", "normal_prepare"),
        *("routine_sincos", "routine_sqrt", "routine_check_state", "routine_check_motion"),
    )
}
"""Proofs that every change must pass: a stand, in both precisions."""

LIMIT = 1800
"""Seconds a driver may take."""

FADING = "\nfading_damping = { linear = [3, 9, 9, 0.2, 2, 2], rate = 3 }\n"
"""Damping of the carrier that fades: no example stand has it, nor the exponential that it takes."""

LISTED = {**DEVIATIONS, **STANDING_FINDINGS}


def stand_of(name: str) -> Stand:
    """An example stand, or `fading3`: demo3 with damping that fades."""
    if name != "fading3":
        return load(path(name))
    text = path("demo3").read_text(encoding="utf-8").replace('name = "demo3"', f'name = "{name}"', 1)
    return loads(text.replace("[carrier]\n", "[carrier]" + FADING, 1), name)


def write_drivers(name: str, real: str) -> tuple[Path, tuple[Driver, ...]]:
    """Emit C, drivers and script of a stand into a folder; the script, and all drivers."""
    stand = stand_of(name)
    made = generate_all(stand, real)
    files = {**made.files, **eva_files(stand, made)}
    digest = hashlib.sha256("".join(text for _, text in sorted(files.items())).encode()).hexdigest()[:16]
    folder = ROOT / "build" / "proofs" / f"{name}-{real}-{digest}"
    write_all(folder, files)
    return folder / f"{VERIFICATION}{name}_eva.sh", drivers(made.program)


def outcome(script: Path, driver: Driver) -> Proof:
    """One driver's outcome, kept or new."""
    name = f"{driver.set}_{driver.function}"
    kept = script.parent / f"{name}.json"
    if kept.exists():
        return Proof(**json.loads(kept.read_text(encoding="utf-8")))
    (proof,) = prove(script, [name], LIMIT, script.parent / "logs")
    kept.write_text(json.dumps(asdict(proof)), encoding="utf-8")
    return proof


def is_wanted(stand: str, driver: Driver, options: Namespace) -> bool:
    """Whether the options ask for a driver."""
    name = f"{driver.set}_{driver.function}"
    if options.quick:
        return name in QUICK[stand]
    return name in options.drivers.split(",") if options.drivers else driver.claimed or options.tried


def eva(options: Namespace) -> Iterator[tuple[Any, ...]]:
    """A row for each driver."""
    stands = list(QUICK) if options.quick else options.stands.split(",") if options.stands else [*names(), "fading3"]
    work = []
    for stand in stands:
        for real in REALS:
            script, every = write_drivers(stand, real)
            work += [(stand, real, script, driver) for driver in every if is_wanted(stand, driver, options)]
    with ThreadPoolExecutor(options.jobs) as pool:
        proofs = pool.map(lambda item: outcome(*item[2:]), work)
        for (stand, real, _, driver), proof in zip(work, proofs, strict=True):
            yield stand, real, driver.function, driver.set, driver.claimed, proof.alarms, proof.unproved, proof.seconds


def is_proved(row: Row) -> bool:
    """Whether a driver came without alarm."""
    return bool(row["alarms"] == row["unproved"] == 0)


def claim_of_eva(rows: Rows) -> str:
    """How many of the claimed are proved."""
    claimed = [row for row in rows if row["claimed"]]
    functions = {row["function"] for row in claimed if row["set"] != "routine"}
    stands = {row["stand"] for row in rows}
    return (
        f"Frama-C Eva proves {sum(map(is_proved, claimed))} of {len(claimed)} claims of no undefined behaviour, of "
        f"{len(functions)} functions of {len(stands)} stands in `double` and `float`"
    )


def by_function(rows: Rows) -> Rows:
    """A row for each function and set of inputs, over stands and element types."""
    merged = []
    for function, inputs, claimed in dict.fromkeys((row["function"], row["set"], row["claimed"]) for row in rows):
        same = [row for row in rows if (row["function"], row["set"]) == (function, inputs)]
        proved = f"{sum(map(is_proved, same))} of {len(same)}"
        merged.append({"function": function, "set": inputs, "proved": proved, "claimed": "yes" if claimed else "no"})
    return merged


def examine(stand: str, real: str) -> tuple[list[str], Counter[str]]:
    """Complaints of compilers and analyser about a stand's C, and its findings by rule."""
    folder = ROOT / "build" / "static-checks" / f"{stand}-{real}"
    write_all(folder, delivery(load(path(stand)), real, ALL, ("selftest", "recorder")))
    files = [f"{stand}.c", f"{VERIFICATION}{stand}_recorder.c"]  # firmware: not the self-test
    return warnings_of(folder, [*files, f"{VERIFICATION}{stand}_selftest.c"]), count_by_rule(findings(folder, files))


def static(options: Namespace) -> Iterator[tuple[Any, ...]]:
    """A row for each rule, and one for each complaint; rules that are listed and kept by every stand are wrong too."""
    stands = options.stands.split(",") if options.stands else names()
    pairs = [(stand, real) for stand in stands for real in REALS]
    seen: dict[str, Counter[str]] = {real: Counter() for real in REALS}
    for (stand, real), (complaints, counts) in zip(
        pairs, side_by_side(examine, options.jobs, *zip(*pairs, strict=True)), strict=True
    ):
        seen[real] += counts
        for line in complaints:
            print(f"{stand} {real}: {line}", file=sys.stderr)
            yield "warning", 1, 1, f"{stand} {real}", "no"
    for rule in dict.fromkeys((*LISTED, *seen["double"], *seen["float"])):
        counted = [seen[real][rule] for real in REALS]
        listed = rule in LISTED and (any(counted) or bool(options.stands))
        yield rule, *counted, LISTED.get(rule, "not among the listed deviations"), "yes" if listed else "no"


def claim_of_static(rows: Rows) -> str:
    """How many rules are not kept."""
    return (
        f"Compilers and analyser have no complaint; {len(rows)} rules of MISRA C:2012 and of cppcheck are not kept, "
        "each with its reason"
    )


TABLES = {
    "eva": Table(
        eva,
        {
            "stand": "{}", "real": "{}", "function": "`{}`", "set": "{}", "claimed": "{}", "alarms": "{}",
            "unproved": "{}", "seconds": "{}",
        },
        claim_of_eva,
        lambda row: not row["claimed"] or is_proved(row),
        "*Proved*: of how many stands and element types there is no alarm "
        "([sets of inputs](verification.md#frama-c-eva)).",
        by_function,
    ),
    "static": Table(
        static,
        {"rule": "{}", "double": "{:,}", "float": "{:,}", "reason": "{}", "listed": "{}"},
        claim_of_static,
        lambda row: row["listed"] == "yes",
        "Findings in the C of the examined stands with the flight recorder "
        "([static checks](verification.md#static-checks)).",
        hidden=("listed",),
    ),
}  # fmt: skip
