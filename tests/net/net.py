"""The net: is the C of 67 stands still the same text, does every study answer and every command print the same?

python tests/net/net.py                       compare; exit status 1 where something differs
python tests/net/net.py --accept "SENTENCE"   keep what differs; the sentence says which judge shows it right

Words before the options choose cases by parts of their names. `c.json` has hashes of the C, `answers/` numbers of
`eval` and of studies, `transcripts/` what commands print, `accepted.md` why they changed. It takes two processes.
"""

from __future__ import annotations

import argparse
import json
import multiprocessing
import sys
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import answers
import emitted
import transcripts

FOLDER = Path(__file__).parent
HASHES = FOLDER / "c.json"
ANSWERS = FOLDER / "answers"
ACCEPTED = FOLDER / "accepted.md"
SHOWN = 8
"""Differences that are shown of a case."""


def measure(task: tuple[str, str]) -> tuple[str, str, Any]:
    """The hashes or answers of a case, or the error that stopped it."""
    kind, name = task
    try:
        if kind == "answer":
            return kind, name, answers.answer(name)
        if kind == "transcript":
            return kind, name, transcripts.transcript(name)
        stand, options = next((stand, options) for case, stand, options in emitted.cases() if case == name)
        return kind, name, emitted.emitted(stand, options)
    except Exception as error:  # one case that fails does not hide the others
        return kind, name, {"failed": f"{type(error).__name__}: {error}"}


def accepted(kind: str, name: str) -> Any:
    """Hashes or answers of a case that were accepted; None: it is new."""
    if kind == "answer":
        file = ANSWERS / _file(name)
        return json.loads(file.read_text(encoding="utf-8")) if file.is_file() else None
    if kind == "transcript":
        return transcripts.accepted(name)
    return json.loads(HASHES.read_text(encoding="utf-8")).get(name) if HASHES.is_file() else None


def compare(kind: str, name: str, now: Any) -> list[str]:
    """Lines that say where a case differs from what was accepted."""
    before = accepted(kind, name)
    if isinstance(now, dict) and "failed" in now:
        return [f"{name}: {now['failed']}"]
    if before is None:
        return [f"{name}: new"]
    if kind == "answer":
        return [f"{name}{line}" for line in answers.differences(before, now, answers.CASES[name][0].relative)]
    if kind == "transcript":
        return [f"{name}: {line}" for line in transcripts.differences(before, now)]
    changed = [
        f"{part[:-1]} {key}"
        for part in ("files", "functions")
        for key in sorted(before[part].keys() | now[part].keys())
        if before[part].get(key) != now[part].get(key)
    ]
    return [f"{name}: {line}" for line in changed]


def accept(measured: Iterable[tuple[str, str, Any]], *, complete: bool) -> None:
    """Keep the cases as they are now; hashes of cases that were not measured stay unless all were."""
    ANSWERS.mkdir(exist_ok=True)
    hashes = {} if complete or not HASHES.is_file() else json.loads(HASHES.read_text(encoding="utf-8"))
    for kind, name, now in measured:
        if kind == "answer":
            (ANSWERS / _file(name)).write_text(_rows(now) + "\n", encoding="utf-8", newline="\n")
        elif kind == "transcript":
            transcripts.accept(name, now)
        else:
            hashes[name] = now
    HASHES.write_text(_rows(dict(sorted(hashes.items()))) + "\n", encoding="utf-8", newline="\n")


def orphans(tasks: Iterable[tuple[str, str]]) -> list[tuple[str, str]]:
    """Cases that were accepted and are measured no more."""
    hashes = json.loads(HASHES.read_text(encoding="utf-8")) if HASHES.is_file() else {}
    kept = {("c", name) for name in hashes} | {("transcript", name) for name in transcripts.accepted_names()}
    by_file = {_file(name): name for name in answers.CASES}
    kept |= {("answer", by_file.get(file.name, file.stem)) for file in ANSWERS.glob("*.json")}
    return sorted(kept - set(tasks))


def forget(kind: str, name: str) -> None:
    """Remove what was accepted of a case that is measured no more; hashes go when all are written again."""
    if kind == "answer":
        (ANSWERS / _file(name)).unlink()
    elif kind == "transcript":
        transcripts.forget(name)


def record(sentence: str, names: Iterable[str]) -> None:
    """Keep the sentence that says why these cases changed, if any did."""
    if not (listed := ", ".join(names)):
        return
    with ACCEPTED.open("a", encoding="utf-8") as file:
        file.write(f"* {sentence} ({listed})\n")


def _file(name: str) -> str:
    return f"{name.replace(' ', '-')}.json"


def _rows(value: dict[str, Any]) -> str:
    """JSON with a line for each entry, so that a change is a line."""
    return "{\n" + ",\n".join(f" {json.dumps(key)}: {json.dumps(one)}" for key, one in value.items()) + "\n}"


def main() -> int:
    """Compare or accept. Returns the exit status."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--accept", metavar="SENTENCE")
    parser.add_argument("words", nargs="*", help="cases whose names contain one of these; all by default")
    options = parser.parse_args()
    tasks = [("answer", name) for name in answers.CASES] + [("c", name) for name, _, _ in emitted.cases()]
    tasks += [("transcript", name) for name in transcripts.names()]
    tasks = [task for task in tasks if not options.words or any(word in task[1] for word in options.words)]
    with multiprocessing.get_context("spawn").Pool(2) as pool:
        measured = sorted(pool.imap_unordered(measure, tasks))
    gone = [] if options.words else orphans(tasks)
    differing = {(kind, name): lines for kind, name, now in measured if (lines := compare(kind, name, now))}
    differing |= {(kind, name): [f"{name}: accepted, and measured no more"] for kind, name in gone}
    for lines in differing.values():
        print(*lines[:SHOWN], *([f"  and {len(lines) - SHOWN} more"] if len(lines) > SHOWN else []), sep="\n")
    print(f"{len(tasks) + len(gone) - len(differing)} passed, {len(differing)} failed")
    if not options.accept:
        return 1 if differing else 0
    if any(isinstance(now, dict) and "failed" in now for _, _, now in measured):
        print("not accepted: a case failed")
        return 1
    accept(measured, complete=not options.words)
    for kind, name in gone:
        forget(kind, name)
    everything = len(differing) == len(tasks) and not options.words
    record(options.accept, ["all"] if everything else [name for _, name in differing])
    return 0


if __name__ == "__main__":
    sys.exit(main())
