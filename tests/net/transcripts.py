"""Transcripts: what commands print and write, with their exit statuses, as a person sees it.

`transcripts/NAME.sh` is run by sh in an empty folder where `mahovik` is the command, $STANDS the folder of example
stands, $INPUTS that of files, and $PYTHON an interpreter that has mahovik. `NAME.out` holds each command, what
it printed to either stream, the files that are new after it, and its exit status if that is not 0.
"""

from __future__ import annotations

import difflib
import os
import re
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

import mahovik

FOLDER = Path(__file__).parent / "transcripts"
PLACES = {
    "$STANDS": Path(mahovik.__file__).parent / "stands",
    "$INPUTS": Path(__file__).parent / "inputs",
    "$PYTHON": Path(sys.executable),
}

COMMAND = """#!/bin/sh
printf '$ mahovik'
for word; do case $word in *' '*) printf ' "%s"' "$word";; *) printf ' %s' "$word";; esac; done
echo
find . -type f | sort > "$SCRATCH/before"
PATH=${ONLY_PATH:-$PATH} "$PYTHON" -c "$PROGRAM" "$@"
status=$?
find . -type f | sort | comm -13 "$SCRATCH/before" - | sed 's,^./,wrote ,'
[ $status = 0 ] || echo "exit status $status"
exit $status
"""
"""Stands before each command of a transcript."""

PROGRAM = 'import sys; sys.argv[0] = "mahovik"; from mahovik.__main__ import run; run()'

MARKS = (
    (re.compile(r"\b\d+\.\d+\.\d+\b"), "VERSION"),
    (re.compile(r"\b[0-9a-f]{64}\b|\b[0-9a-f]{16}\b"), "HASH"),  # of the package, and of numbers with all their digits
    (re.compile(r"-?\b\d+(?:\.\d+)?e-(?:0[5-9]|[1-9]\d)\b|\b0\.0e\+00\b"), "TINY"),  # rounding, or hardly more
    (re.compile(r"(?<=  )(?:[a-z]|\d+ of )\S*(?: \S+)*(?= +ok)"), "STATE"),  # of equal rounding, where it is largest
)
"""What depends on the machine, and the mark in its place."""

LONG = re.compile(r"-?\b\d+\.\d{9,}(?:e[-+]\d+)?\b")
"""Numbers of JSON in full, of which BLAS and iterations may leave other last digits: six digits stay."""


def names() -> list[str]:
    """Names of all transcripts."""
    return sorted(file.stem for file in FOLDER.glob("*.sh"))


def transcript(name: str) -> str:
    """Run the commands of a transcript."""
    with tempfile.TemporaryDirectory() as scratch, tempfile.TemporaryDirectory() as folder:
        command = Path(scratch) / "mahovik"
        command.write_text(COMMAND, encoding="utf-8")
        command.chmod(0o755)
        hidden = ("CC", "CI", "FORCE_COLOR", "MAHOVIK_CACHE")
        environment = {key: value for key, value in os.environ.items() if key not in hidden} | {
            **{key[1:]: str(path) for key, path in PLACES.items()},
            "PATH": f"{scratch}:{os.environ['PATH']}",
            "SCRATCH": scratch,
            "PROGRAM": PROGRAM,
            "PYTHONUNBUFFERED": "1",
            "NO_COLOR": "1",
            "LC_ALL": "C.UTF-8",
        }
        run = subprocess.run(
            ["sh", FOLDER / f"{name}.sh"],
            cwd=folder,
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            encoding="utf-8",
            check=False,
            timeout=600,
        )
        return marked(run.stdout, {**PLACES, "$SCRATCH": Path(scratch), ".": Path(folder)})


def marked(text: str, places: dict[str, Path]) -> str:
    """The text without what depends on the machine; of a command with a mark without the widths of columns."""
    for name, path in places.items():
        text = text.replace(str(path), name)
    parts = re.split(r"^(?=\$ mahovik)", text, flags=re.MULTILINE)
    return "\n".join(line.rstrip() for part in parts for line in _marked(part).splitlines()) + "\n"


def _marked(text: str) -> str:
    after = LONG.sub(lambda number: f"{float(number[0]):.6g}", text)
    for pattern, mark in MARKS:
        after = pattern.sub(mark, after)
    if after == text:
        return text
    for wide, narrow in ((r"\n +", "\n "), (r"(?<=\S) {2,}", "  "), (r"─{3,}", "───")):
        after = re.sub(wide, narrow, after)
    return after


def accepted(name: str) -> str | None:
    """The transcript as it was accepted; None: it is new."""
    file = FOLDER / f"{name}.out"
    return file.read_text(encoding="utf-8") if file.is_file() else None


def accepted_names() -> list[str]:
    """Names of the transcripts that were accepted."""
    return sorted(file.stem for file in FOLDER.glob("*.out"))


def forget(name: str) -> None:
    """Remove what was accepted."""
    (FOLDER / f"{name}.out").unlink()


def accept(name: str, text: str) -> None:
    """Keep a transcript."""
    (FOLDER / f"{name}.out").write_text(text, encoding="utf-8", newline="\n")


def differences(before: str, now: str) -> Iterator[str]:
    """Lines of a small diff, each after the command that it belongs to."""
    lines = difflib.unified_diff(before.splitlines(), now.splitlines(), n=0, lineterm="")
    yield from (f"  {line}" for line in lines if not line.startswith(("---", "+++")))
