"""Plants each fault of tests/faults.toml in a copy of the checkout, and runs the tests that must notice it.

python tools/faults.py [WORD ...] [--again]

A fault survives where its tests pass; its place is missing, or there twice, where its text is. Verdicts are kept in
build/faults until the code or its tests change, so that a run goes on where it was interrupted.
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
import threading
import time
import tomllib
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
LIST = ROOT / "tests" / "faults.toml"
VERDICTS = ROOT / "build" / "faults" / "verdicts.json"
COPIES = 2
LONGEST = 600.0
"""Seconds for the tests of one fault."""

CAUGHT, SURVIVED = "caught", "SURVIVED"


@dataclass(frozen=True)
class Fault:
    """One changed text in one file.

    tests    pytest ids under tests/, the least set that must notice it; nightly: with slow ones among them
    """

    kind: str
    fault: str
    file: str
    before: str
    after: str
    tests: tuple[str, ...]
    nightly: bool = False

    @property
    def name(self) -> str:
        """Kind and description."""
        return f"{self.kind}: {self.fault}"


def read_faults(words: Sequence[str] = ()) -> list[Fault]:
    """All faults of the list, or those that have each of the words in kind, description or file."""
    tables = tomllib.loads(LIST.read_text(encoding="utf-8"))
    faults = [
        Fault(kind, **(entry | {"tests": tuple(entry["tests"])}))
        for kind, entries in tables.items()
        for entry in entries
    ]
    return [each for each in faults if all(word in f"{each.name} {each.file}" for word in words)]


def copy_checkout(folder: Path) -> Path:
    """A copy of the files that git knows, as they are now."""
    listed = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, check=True).stdout
    for name in filter(None, listed.decode().split("\0")):
        if (ROOT / name).is_file():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, folder / name)
    return folder


def state_of(copy: Path) -> str:
    """Hash of what decides whether a fault is noticed."""
    found = hashlib.sha256()
    for part in ("generator", "templates", "tests"):
        for path in sorted(
            each for each in (copy / part).rglob("*") if each.is_file() and each != copy / "tests/faults.toml"
        ):
            found.update(path.relative_to(copy).as_posix().encode() + b"\0" + path.read_bytes())
    return found.hexdigest()


def run_tests(copy: Path, tests: Sequence[str], nightly: bool, *options: str) -> tuple[int, str]:
    """Exit status of pytest, and what it printed last."""
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", *options]
    command += ["-m", "not fuzz"] if nightly else []
    environment = os.environ | {"PYTHONPATH": str(copy / "generator"), "CI": "1"}
    ids = [f"tests/{each}" for each in tests]
    try:
        done = subprocess.run(
            [*command, *ids], cwd=copy, env=environment, capture_output=True, text=True, check=False, timeout=LONGEST
        )
    except subprocess.TimeoutExpired:
        return -1, f"no end in {LONGEST:g} s"
    return done.returncode, "\n".join(done.stdout.splitlines()[-15:])


def judge(copy: Path, fault: Fault) -> str:
    """Plant the fault in the copy, run its tests, take it out again."""
    path = copy / fault.file
    text = path.read_text(encoding="utf-8") if path.is_file() else ""
    if text.count(fault.before) != 1:
        return f"DOES NOT APPLY: its text is {text.count(fault.before)} times in {fault.file}"
    shutil.copy2(path, original := path.with_name(path.name + ".original"))
    path.write_text(text.replace(fault.before, fault.after), encoding="utf-8")
    try:
        status, said = run_tests(copy, fault.tests, fault.nightly, "-x")
    finally:
        original.replace(path)  # with its time, by which Python knows what it has compiled
    return {0: SURVIVED, 1: CAUGHT}.get(status, f"NO VERDICT: pytest ended with {status}\n{said}")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("words", nargs="*", metavar="WORD", help="only faults that have this word")
    parser.add_argument("--again", action="store_true", help="forget the verdicts so far")
    given = parser.parse_args()
    chosen = read_faults(given.words)
    kept = json.loads(VERDICTS.read_text()) if VERDICTS.is_file() and not given.again else {}
    lock, red = threading.Lock(), []
    with tempfile.TemporaryDirectory(prefix="mahovik-faults-") as folder:
        copies: queue.Queue[Path] = queue.Queue()
        for number in range(COPIES):
            copies.put(copy_checkout(Path(folder) / str(number)))
        state = state_of(Path(folder) / "0")
        keys = {each: hashlib.sha256(json.dumps([state, asdict(each)]).encode()).hexdigest() for each in chosen}
        left = [each for each in chosen if kept.get(keys[each]) != CAUGHT]
        print(f"{len(chosen)} faults, {len(left)} to be planted", flush=True)
        for nightly in (False, True):
            tests = sorted({test for each in left if each.nightly is nightly for test in each.tests})
            status, said = run_tests(Path(folder) / "0", tests, nightly, "-n", str(COPIES)) if tests else (0, "")
            if status:
                print(f"{said}\nthese tests do not pass without a fault: nothing was planted")
                return 1

        def take(fault: Fault) -> None:
            copy, begin = copies.get(), time.monotonic()
            verdict = judge(copy, fault)
            copies.put(copy)
            with lock:
                print(f"{verdict}  {fault.name} ({time.monotonic() - begin:.0f} s)", flush=True)
                kept[keys[fault]] = verdict
                VERDICTS.parent.mkdir(parents=True, exist_ok=True)
                VERDICTS.write_text(json.dumps(kept))

        with ThreadPoolExecutor(COPIES) as pool:
            list(pool.map(take, left))
    red = [each for each in chosen if kept[keys[each]] != CAUGHT]
    for each in red:
        print(f"{kept[keys[each]].splitlines()[0]}  {each.name}", file=sys.stderr)
    print(f"{len(chosen) - len(red)} of {len(chosen)} faults are caught")
    return 1 if red else 0


if __name__ == "__main__":
    sys.exit(main())
