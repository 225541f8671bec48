"""docs/results/planted-faults.md: the table of faults and what catches them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from faults.catalogue import FAULTS
from faults.checks import CHECKS
from faults.derivation import DERIVED
from fuzz.test_harness import FAULTS as FUZZED
from second.test_mutations import MUTATIONS
from toolchain.test_eva import FAULTS as EVA

NOT_RUN = ("not planted yet",)


def text(how: Mapping[str, Sequence[str]]) -> str:
    """The tables; `how`: what each check said of a fault."""
    parts = [f"{len(FAULTS)} in the C, {len(DERIVED)} in the derivation, {len(MUTATIONS)} in the second one, "]
    parts.append(f"{len(EVA)} for Frama-C Eva, {len(FUZZED)} for the fuzzer.\n")
    kinds = dict.fromkeys(fault.kind for fault in FAULTS)
    for kind in kinds:
        parts.append(
            f"\n## {kind[0].upper()}{kind[1:]}\n\n| fault | planted in | caught by | how it showed |\n"
            "|---|---|---|---|\n"
        )
        for f in FAULTS:
            if f.kind == kind:
                said = cell(how.get(f.name, NOT_RUN)[0])
                parts.append(f"| {f.name} | {f.place}, {f.host} | {', '.join(f.caught_by)} | {said} |\n")
    parts.append("\n## The derivation\n\nCaught by `comparison`, in `tests/verify/test_mutations.py`.\n\n")
    parts.append("| fault | planted in | what must differ |\n|---|---|---|\n")
    parts += [f"| {cell(name)} | {where} | {', '.join(found)} |\n" for name, (where, found) in DERIVED.items()]
    parts.append("\n## The second derivation\n\nCaught by the comparison with the reference, in ")
    parts.append("`tests/second/test_mutations.py`.\n\n| fault | planted in |\n|---|---|\n")
    parts += [f"| {name} | `{_place(module)}` |\n" for name, (module, _, _) in MUTATIONS.items()]
    parts.append("\n## Seen by Frama-C Eva\n\nPlanted in the C of demo3, in `tests/toolchain/test_eva.py`.\n\n")
    parts.append("| fault | driver that sees it |\n|---|---|\n")
    parts += [f"| {name} | `{driver}` |\n" for name, (driver, _, _) in EVA.items()]
    parts.append("\n## Found by fuzzing\n\nPlanted in the C of demo3, in `tests/fuzz/test_harness.py`.\n\n")
    parts.append("| fault | what the harness says |\n|---|---|\n")
    parts += [f"| {f.name} | {cell(f.said)} |\n" for f in FUZZED]
    parts.append("\n## The checks\n\n| check | what it does | where the project runs it |\n|---|---|---|\n")
    parts += [f"| {c.name} | {c.meaning} | {c.where} |\n" for c in CHECKS.values()]
    return "".join(parts)


def _place(module: str) -> str:
    """The file of a module of the second derivation, `chart`, or of a law's part in it, `laws.leg`."""
    stem, _, law = module.partition(".")
    return f"laws/{law}/second.py" if law else f"proof/second/{stem}.py"


def cell(words: str) -> str:
    """Words for a cell of a table, not too many."""
    plain = words.replace("|", "\\|").replace("‘", "'").replace("’", "'")
    return plain if len(plain) <= 110 else f"{plain[:107].rstrip()}..."
