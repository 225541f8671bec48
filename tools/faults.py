"""Plants each fault of tests/faults.toml in a copy of the checkout, and runs the tests that must notice it.

python tools/faults.py [WORD ...] [--again]

A fault survives where its tests pass; it does not apply where the file has not its text once. Verdicts are kept until
the code or its tests change, so that a run goes on where it was interrupted.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import os
import queue
import shutil
import subprocess
import sys
import tempfile
import tomllib
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
LIST = Path("tests/faults.toml")
VERDICTS = ROOT / "build" / "faults" / "verdicts.json"
FORMULAS = "generator/mahovik/core/formula/derived.json"
COPIES = 2
LONGEST = 1200.0  # s
CAUGHT = "caught"


@dataclass(frozen=True)
class Fault:
    """One changed text in one file; `tests`: pytest ids under tests/, of quick ones."""

    kind: str
    fault: str
    file: str
    before: str
    after: str
    tests: tuple[str, ...]

    @property
    def name(self) -> str:
        """Kind and description."""
        return f"{self.kind}: {self.fault}"


def read_faults(words: Sequence[str]) -> list[Fault]:
    """The faults of the list that have all of the words in kind, description or file."""
    tables = tomllib.loads((ROOT / LIST).read_text(encoding="utf-8"))
    faults = [Fault(kind, **(entry | {"tests": tuple(entry["tests"])})) for kind in tables for entry in tables[kind]]
    return [fault for fault in faults if all(word in f"{fault.name} {fault.file}" for word in words)]


def copy_checkout(folder: Path) -> None:
    """Copy the files that git knows, as they are now."""
    listed = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, check=True).stdout
    for name in filter(None, listed.decode().split("\0")):
        if (ROOT / name).is_file():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, folder / name)


def state_of(copy: Path) -> str:
    """Hash of what decides whether a fault is noticed."""
    digest = hashlib.sha256((copy / "pyproject.toml").read_bytes())
    for path in sorted(path for part in ("generator", "templates", "tests") for path in (copy / part).rglob("*")):
        if path.is_file() and path != copy / LIST:
            digest.update(path.relative_to(copy).as_posix().encode() + b"\0" + path.read_bytes())
    return digest.hexdigest()


def environment(copy: Path) -> dict[str, str]:
    """Variables of processes that import the copy."""
    return os.environ | {"PYTHONPATH": str(copy / "generator"), "CI": "1"}


def run_tests(copy: Path, tests: Sequence[str], *options: str) -> tuple[int, str]:
    """Exit status of pytest, and the end of what it printed."""
    ids = [f"tests/{test}" for test in tests]
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", *options, *ids]
    try:
        done = subprocess.run(
            command, cwd=copy, env=environment(copy), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
            check=False, timeout=LONGEST,
        )  # fmt: skip
    except subprocess.TimeoutExpired:
        return -1, f"no end in {LONGEST:g} s"
    return done.returncode, "\n".join(done.stdout.splitlines()[-15:])


def judge(copy: Path, fault: Fault) -> str:
    """Plant the fault in the copy, derive again where it is in the derivation, run its tests, take it out again."""
    text = path.read_text(encoding="utf-8") if (path := copy / fault.file).is_file() else ""
    if (count := text.count(fault.before)) != 1:
        return f"DOES NOT APPLY: its text is {count} times in {fault.file}"
    derives = "/derive" in fault.file
    changed = (path, copy / FORMULAS) if derives else (path,)
    originals = [Path(shutil.copy2(file, f"{file}.original")) for file in changed]
    path.write_text(text.replace(fault.before, fault.after), encoding="utf-8")
    try:
        if derives:
            subprocess.run([sys.executable, "tools/formulas.py"], cwd=copy, env=environment(copy), check=True)
        status, said = run_tests(copy, fault.tests, "-x")
    finally:
        for original, file in zip(originals, changed, strict=True):
            original.replace(file)  # with its time, by which Python knows what it has compiled
    return {0: "SURVIVED", 1: CAUGHT}.get(status, f"NO VERDICT: pytest ended with {status}\n{said}")


def main() -> int:
    """Plants what is asked for. Returns the exit status."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("words", nargs="*", metavar="WORD", help="only faults that have every word")
    parser.add_argument("--again", action="store_true", help="forget the verdicts so far")
    options = parser.parse_args()
    chosen = read_faults(options.words)
    kept = json.loads(VERDICTS.read_text()) if VERDICTS.is_file() and not options.again else {}
    copies = queue.Queue[Path]()
    VERDICTS.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix="mahovik-faults-") as folder:
        for number in range(COPIES):
            copy_checkout(copy := Path(folder) / str(number))
            copies.put(copy)
        state = state_of(copy)
        keys = {fault: hashlib.sha256(json.dumps([state, asdict(fault)]).encode()).hexdigest() for fault in chosen}
        left = [fault for fault in chosen if kept.get(keys[fault]) != CAUGHT]
        print(f"{len(chosen)} faults, {len(left)} to be planted", flush=True)
        tests = sorted({test for fault in left for test in fault.tests})
        status, said = run_tests(copy, tests) if tests else (0, "")
        if status:
            print(f"{said}\nnot all of these tests pass without a fault: nothing was planted")
            return 1

        def take(fault: Fault) -> str:
            copy = copies.get()
            try:
                return judge(copy, fault)
            finally:
                copies.put(copy)

        with ThreadPoolExecutor(COPIES) as pool:
            for fault, verdict in zip(left, pool.map(take, left), strict=True):
                print(f"{verdict}  {fault.name}", flush=True)
                kept[keys[fault]] = verdict
                VERDICTS.write_text(json.dumps(kept))
    red = [fault for fault in chosen if kept[keys[fault]] != CAUGHT]
    print(*(f"{kept[keys[fault]]}  {fault.name}" for fault in red), sep="\n", end="\n" if red else "")
    print(f"{len(chosen) - len(red)} of {len(chosen)} faults are caught")
    return 1 if red else 0


if __name__ == "__main__":
    sys.exit(main())
