"""Where the time of a command goes: imports by library, reading the stand, the rest. Part of generation_time.

Python reports what each import takes (`-X importtime`). Marks in the same stream tell when the reading of the stand
file begins and ends, so that imports inside it are not counted twice.
"""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

LIBRARIES = {
    "NumPy": ("numpy",),
    "pydantic": ("pydantic", "pydantic_core", "annotated_types", "typing_extensions", "typing_inspection"),
    "click, rich": ("click", "rich", "markdown_it", "mdurl", "pygments"),
    "Jinja, cffi": ("jinja2", "markupsafe", "cffi", "_cffi_backend", "pycparser"),
    "SymPy": ("sympy", "mpmath", "gmpy2", "flint"),
    "mahovik": ("mahovik",),
}
"""Packages by the title of their column. All others are of Python's own library."""

OTHERS, READING, REST = "Python's library", "reading", "mechanics, text, files"

PARTS = (OTHERS, *LIBRARIES, READING, REST)
"""Columns of the table, ms."""

WATCHED = """
import sys, time
print("BEGIN", time.perf_counter(), file=sys.stderr, flush=True)
import mahovik.core.stand as stands
load = stands.load
def watched(*given):
    print("MARK", time.perf_counter(), file=sys.stderr, flush=True)
    try:
        return load(*given)
    finally:
        print("MARK", time.perf_counter(), file=sys.stderr, flush=True)
stands.load = watched
from mahovik.__main__ import run
sys.argv = ["mahovik", *sys.argv[1:]]
try:
    run()
finally:
    print("END", time.perf_counter(), file=sys.stderr, flush=True)
"""
"""Runs a command in a process whose imports are timed."""


@dataclass
class Profile:
    """Milliseconds of a command by PARTS, and their sum."""

    total: float = 0.0
    parts: dict[str, float] = field(default_factory=lambda: dict.fromkeys(PARTS, 0.0))


def profile(arguments: Sequence[str], env: Mapping[str, str], cwd: Path, repeat: int) -> Profile:
    """The quickest of the repetitions. Raises SystemExit where the command fails."""
    return min((_once(arguments, env, cwd) for _ in range(repeat)), key=lambda each: each.total)


def _once(arguments: Sequence[str], env: Mapping[str, str], cwd: Path) -> Profile:
    command = [sys.executable, "-X", "importtime", "-c", WATCHED, *arguments]
    done = subprocess.run(
        command, env=dict(env), cwd=cwd, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False
    )
    if done.returncode != 0:
        raise SystemExit(f"mahovik {' '.join(arguments)}: exit status {done.returncode}\n{done.stderr[-2000:]}")
    return parse(done.stderr)


def parse(lines: str) -> Profile:
    """The profile of what a process wrote: imports, marks around the reading, the end.

    What Python imports before the first line of a program is left out: every program in Python pays it.
    """
    found = Profile()
    marks: list[float] = []
    inside = begin = 0.0
    for line in lines.splitlines():
        words = line.split()
        if line.startswith("import time:") and words[2].isdigit():
            spent = int(words[2]) / 1000
            found.parts[_part(words[-1])] += spent
            inside += spent if len(marks) % 2 else 0.0
        elif line.startswith("MARK "):
            marks.append(float(words[1]))
        elif line.startswith("BEGIN "):
            begin, found.parts = float(words[1]), dict.fromkeys(PARTS, 0.0)
        elif line.startswith("END "):
            found.total = 1000 * (float(words[1]) - begin)
    found.parts[READING] = 1000 * sum(end - start for start, end in zip(marks[::2], marks[1::2], strict=True)) - inside
    found.parts[REST] = found.total - sum(found.parts.values())
    return found


def _part(module: str) -> str:
    package = module.partition(".")[0]
    return next((title for title, packages in LIBRARIES.items() if package in packages), OTHERS)
