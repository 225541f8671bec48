"""The example stands on processors: the same bits as here, and no function that costs more than was accepted.

python tests/net/processors.py                       one target of each kind, this machine among them
python tests/net/processors.py --all                 every target for bench8, and the costs of five
python tests/net/processors.py --accept "SENTENCE"   keep the costs of five as they are now; the sentence says why

`cost.json` has instructions, stack and code of every function by stand, target and element type. A figure more than 2 %
above the accepted one, one that was never accepted and one of another compiler are failures: names of stands, or all.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Iterator, Mapping
from typing import Any

import mahovik
from mahovik.core.stand import Stand
from mahovik.core.toolchain.targets import TARGETS, Target
from mahovik.proof.cost import USUAL, TargetCost, measure
from mahovik.proof.verify.check import conclusion
from mahovik.proof.verify.selftest import parse_targets, verify_targets
from net import FOLDER, record

COSTS = FOLDER / "cost.json"
HOST = ("host", "double")
ONE_OF_A_KIND = (HOST, ("m4", "float"), ("rv64gc", "double"))
"""This machine, a Cortex-M, a RISC-V; both element types."""

FIGURES = ("instructions", "stack", "code")
"""Figures of a function that are compared."""

RISE = 0.02
"""Least relative rise that counts: figures of one compiler are the same in every run, without noise."""


def named(pairs: tuple[tuple[str, str], ...]) -> list[tuple[Target, str]]:
    """Targets by their names, with element types."""
    return [(TARGETS[target], real) for target, real in pairs]


def accepted_costs(target: TargetCost) -> dict[str, Any]:
    """Accepted costs of a target."""
    functions = {f.function: [getattr(f, figure) for figure in FIGURES] for f in target.functions}
    return {
        "compiler": target.compiler,
        "text": target.text,
        "constants": target.constants,
        "functions": functions,
    }


def text(costs: Mapping[str, Any]) -> str:
    """Accepted costs as JSON with a line for each function, so that a change is a line."""
    lines = []
    for stand, targets in sorted(costs.items()):
        rows = []
        for key, row in sorted(targets.items()):
            functions = ",\n".join(f"    {json.dumps(name)}: {json.dumps(f)}" for name, f in row["functions"].items())
            rest = ", ".join(
                f"{json.dumps(name)}: {json.dumps(row[name])}" for name in ("compiler", "text", "constants")
            )
            rows.append(f'  {json.dumps(key)}: {{{rest}, "functions": {{\n{functions}}}}}')
        lines.append(f" {json.dumps(stand)}: {{\n" + ",\n".join(rows) + "}")
    return "{\n" + ",\n".join(lines) + "\n}\n"


def figures(row: Mapping[str, Any]) -> dict[str, Any]:
    """All figures of the costs of a target, by what they are of."""
    functions = {
        f"{name}, {what}": n for name, of in row["functions"].items() for what, n in zip(FIGURES, of, strict=True)
    }
    tables = {f"constants {table}": size for table, size in row["constants"].items()}
    return {"code of the whole file": row["text"], **tables, **functions}


def changes(name: str, before: Mapping[str, Any], now: Mapping[str, Any]) -> Iterator[str]:
    """Lines about figures of a stand that are not those that were accepted, and about targets that are new or gone."""
    for target in sorted(before.keys() | now.keys()):
        if target not in before or target not in now:
            yield f"{name} {target}: {'new' if target in now else 'gone'}"
            continue
        old, new = ({"compiler": row["compiler"], **figures(row)} for row in (before[target], now[target]))
        yield from (
            f"{name} {target}: {what}: {old.get(what)}, now {new.get(what)}"
            for what in {**old, **new}
            if old.get(what) != new.get(what)
        )


def rises(name: str, before: Mapping[str, Any], now: Mapping[str, Any]) -> Iterator[str]:
    """Lines about what of a stand costs more than was accepted, or was not accepted, or is not there any more."""
    for target, row in now.items():
        where = f"{name}: {target.replace(' ', ', ')}"
        if target not in before:
            yield f"{where}: not accepted"
            continue
        if before[target]["compiler"] != row["compiler"]:
            yield f"{where}: accepted figures are of {before[target]['compiler']}, this is {row['compiler']}"
            continue
        old, new = figures(before[target]), figures(row)
        for what in {**old, **new}:
            if what not in old or what not in new:
                yield f"{where}: {what}: {'not accepted' if what in new else 'is not there any more'}"
            elif new[what] > old[what] * (1 + RISE):
                more = f"{100 * (new[what] / old[what] - 1):.1f} % more" if old[what] else "there was none"
                yield f"{where}: {what}: {old[what]} accepted, now {new[what]}, {more}"


def differing_bits(name: str, stand: Stand, everything: bool) -> Iterator[str]:
    """Lines about targets whose bits are not those of this machine, or that did not run."""
    words = "all" if everything and name == "bench8" else "quick"
    report = verify_targets(stand, parse_targets(words) if everything else named(ONE_OF_A_KIND))
    if not report.passed:
        yield f"{name}: {conclusion(report)}"
        yield from (f"{name}: {row.judged}: {row.words}" for row in report.rows if row.verdict != "ok")


def main() -> int:
    """Compare or accept. Returns the exit status."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--all", action="store_true")
    parser.add_argument("--accept", metavar="SENTENCE")
    parser.add_argument("stands", nargs="*", default=mahovik.examples())
    options = parser.parse_args()
    before = json.loads(COSTS.read_text(encoding="utf-8")) if COSTS.is_file() else {}
    pairs = named((*USUAL, HOST) if options.all or options.accept else ONE_OF_A_KIND)
    wrong, changed = [], list[str]()
    for name in options.stands:
        stand = mahovik.example(name)
        costs = measure(stand, pairs, recorder=True)
        now = {f"{t.target} {t.real}": accepted_costs(t) for t in costs.targets}
        if options.accept:
            changed += changes(name, before.get(name, {}), now)
            before[name] = now
            continue
        lines = [*differing_bits(name, stand, options.all), *rises(name, before.get(name, {}), now)]
        print(*(lines or [f"{name}: same bits, no rise of cost on {len(pairs)} targets"]), sep="\n", flush=True)
        wrong += lines
    if options.accept:
        COSTS.write_text(text(before), encoding="utf-8", newline="\n")
        print(*changed, sep="\n")
        record(options.accept, [f"cost of {name}" for name in dict.fromkeys(line.split()[0] for line in changed)])
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
