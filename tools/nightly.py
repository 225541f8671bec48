"""What is too long for every change: each part once for a commit, and a list of those that failed.

python tools/nightly.py [PART ...]

A part that has passed on this commit is not run again, unless files differ from it; `build/nightly` has the output of
each. Exit status 1 where one failed. `make nightly` runs all of them. Campaigns that only measure times, or that search
for an hour, are no part: their rows have no verdict.
"""

from __future__ import annotations

import argparse
import os
import resource
import subprocess
import sys
import time
from functools import partial
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
KEPT = ROOT / "build" / "nightly"

PYTEST = "python -m pytest -q -n 2 --dist worksteal"
COVERED = {"core": 97, "laws": 96, "proof": 94, "use": 94}
"""Least percentage of a wing's lines that the quick tests run; transcripts do not count."""

PARTS = {
    "slow": [f"{PYTEST} -m slow"],
    "targets": ["make targets"],
    "proofs": ["make proofs"],
    "fuzz": ["make fuzz"],
    "faults": ["make faults"],
    "judges": ["python tools/campaign.py judges", "python tools/campaign.py audits"],
    "campaigns": [
        f"python tools/campaign.py {name}" for name in ("verification", "vibration", "planning", "balancing")
    ],
    "coverage": [
        "python -m coverage erase",
        f"python -m coverage run {PYTEST.removeprefix('python ')}",
        "python -m coverage combine",
        *(
            f"python -m coverage report --include=*/{wing}/* --skip-covered --fail-under={percent}"
            for wing, percent in COVERED.items()
        ),
    ],
}
"""Commands of each part, from the root of the repository."""


def git(*words: str) -> str:
    """What git says."""
    return subprocess.run(["git", *words], cwd=ROOT, capture_output=True, text=True, check=True).stdout.strip()


def processor_time() -> float:
    """Seconds of processor of all commands that have ended: they do not depend on what else the machine does."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def run(part: str) -> tuple[bool, str]:
    """Whether all commands of a part pass, and the minutes that they took; its output goes into a file."""
    environment = {**os.environ, "PATH": f"{ROOT / '.venv' / 'bin'}{os.pathsep}{os.environ['PATH']}"}
    start, processor = time.monotonic(), processor_time()
    with (KEPT / f"{part}.log").open("w", encoding="utf-8") as log:
        run_one = partial(subprocess.run, cwd=ROOT, env=environment, stdout=log, stderr=subprocess.STDOUT, check=False)
        passed = [run_one(command.split()).returncode == 0 for command in PARTS[part]]
    wall, processor = time.monotonic() - start, processor_time() - processor
    return all(passed), f"{wall / 60:.0f} min, {processor / 60:.0f} min of processor"


def main() -> int:
    """Runs what is asked for. Returns the exit status."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("parts", nargs="*", metavar="PART", help=", ".join(PARTS))
    parts = parser.parse_args().parts or list(PARTS)
    if unknown := [part for part in parts if part not in PARTS]:
        parser.error(f"unknown part {unknown[0]}: expected one of {', '.join(PARTS)}")
    KEPT.mkdir(parents=True, exist_ok=True)
    commit, clean, failed = git("rev-parse", "--short", "HEAD"), not git("status", "--porcelain"), []
    for part in parts:
        stamp = KEPT / f"{part}.passed"
        if clean and stamp.is_file() and stamp.read_text(encoding="utf-8") == commit:
            print(f"passed before  {part}")
            continue
        passed, duration = run(part)
        print(f"{'passed' if passed else 'FAILED'}  {part}, {duration}", flush=True)
        if not passed:
            failed.append(part)
        elif clean:
            stamp.write_text(commit, encoding="utf-8")
    print(f"{commit}{'' if clean else ' and changes'}: {len(parts) - len(failed)} passed, {len(failed)} failed")
    for part in failed:
        print(f"FAILED  {part}: {(KEPT / f'{part}.log').relative_to(ROOT)}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
