"""Plants every fault, runs the checks that must catch it, and writes docs/results/planted-faults.md.

python tools/planted_faults.py

Exit status 1 where a fault is not caught, or a check finds something where none is planted.
"""

from __future__ import annotations

import os
import sys
import tempfile
from pathlib import Path

import campaign
from kept import Campaign, Figures

sys.path.insert(0, str(campaign.ROOT / "tests"))


def page(found: Figures) -> str:
    """All faults, with what the first check said of each."""
    from faults import page as tables

    return tables.text(found["shown"])


CAMPAIGN = Campaign(
    "planted-faults",
    campaign.Block("docs/results/planted-faults.md", "faults: tools/planted_faults.py"),
    page,
)


def main() -> int:
    campaign.parser(__doc__).parse_args()
    os.chdir(campaign.ROOT)
    from faults.catalogue import FAULTS
    from faults.checks import outcome
    from faults.emitted import Emitted
    from faults.fault import planted

    missed = []
    how: dict[str, list[str]] = {}
    for host, check in sorted({(fault.host, name) for fault in FAULTS for name in fault.caught_by}, key=str):
        with tempfile.TemporaryDirectory() as folder:
            if said := outcome(check, Emitted(host, Path(folder))):
                missed.append(f"without a fault, {check} finds in {host}: {said}")
    for fault in FAULTS:
        with tempfile.TemporaryDirectory() as folder:
            made = planted(fault, Path(folder))
            how[fault.name] = [outcome(check, made) for check in fault.caught_by]
        missed += [
            f"{fault.name} is not caught by {check}"
            for check, said in zip(fault.caught_by, how[fault.name], strict=True)
            if not said
        ]
        print(f"{fault.name}: {how[fault.name][0]}", flush=True)
    for line in missed:
        print(line, file=sys.stderr)
    if not missed:
        CAMPAIGN.keep({"shown": how})
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
