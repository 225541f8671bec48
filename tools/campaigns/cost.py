"""Instructions, stack and code of public functions of the example stands on emulated processors."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Iterator

from campaigns import Rows, Table
from mahovik.core.stand import load
from mahovik.proof.cost import measure as measure_costs
from mahovik.proof.cost import parse_targets
from mahovik.stands import names, path

OPTIONS = {"targets": "m4,m7", "functions": "forward,torque,coupled,inverse,inverse_fast,step,prepare"}

REALS = {"m4": "float", "m7": "double"}
"""Element types that the processors calculate with; others are measured with both."""

SHOWN = ("forward", "torque", "coupled", "inverse_fast", "step")


def measure(options: Namespace) -> Iterator[tuple[str | int | None, ...]]:
    """A row for each stand, function and target; no instructions where the function refuses the measured states."""
    functions = options.functions.split(",")
    for name in names():
        stand = load(path(name))
        pairs = [pair for target in options.targets.split(",") for pair in parse_targets(target, REALS.get(target))]
        for target in measure_costs(stand, pairs).targets:
            for cost in target.functions:
                if cost.function in functions:
                    where = f"{target.target}, {target.real}"
                    yield (
                        name,
                        len(stand.flywheels),
                        cost.function,
                        where,
                        cost.instructions or None,
                        cost.stack,
                        cost.code,
                    )


def control_loop_functions(rows: Rows) -> Rows:
    """The functions of a control loop on the largest example stand."""
    return [row for row in rows if row["stand"] == "bench8" and row["function"] in SHOWN]


def claim(rows: Rows) -> str:
    """The usual function of the usual stand."""
    cost = {(row["stand"], row["target"], row["function"]): row["instructions"] for row in rows}
    words = [
        f"{cost['bench8', target, 'forward']:,} instructions on {title} in `{target.partition(', ')[2]}`"
        for target, title in (("m4, float", "a Cortex-M4F"), ("m7, double", "a Cortex-M7"))
    ]
    return f"`forward` of `bench8`, eight flywheels, takes {' and '.join(words)}"


TABLES = {
    "cost": Table(
        measure,
        {
            "stand": "`{}`", "flywheels": "{}", "function": "`{}`", "target": "{}", "instructions": "{:,}",
            "stack, bytes": "{:,}", "code, bytes": "{:,}",
        },
        claim,
        note="Instructions, not cycles, of the costliest of four ordinary states, checks included, at -O2 "
        "([targets](c-interface.md#what-changes-the-bits)). `mahovik verify --cost` measures a stand of yours.",
        shown=control_loop_functions,
    )
}  # fmt: skip
