"""Time of generation and of the C compiler, of commands as a user starts them, and of an install in a fresh clone.

Every run is a process of its own; kept are the least of the repetitions, and peak memory. Python keeps the modules that
it has compiled, as after an installation by pip. A limit holds for the smaller of wall-clock and processor seconds:
other work on the machine adds to the first, and processes side by side to the second.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from argparse import Namespace
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from campaigns import ROOT, Row, Rows, Table
from mahovik.core.toolchain.store import VARIABLE
from mahovik.stands import path

OPTIONS = {"repeat": 5}

COUNTS = (2, 8, 64, 1000)
"""Flywheels."""
KINDS = ("bare", "everything")

DRAW = """
import sys
import numpy as np
from mahovik.core.stand.random import BARE, EVERYTHING, random_stand
from mahovik.core.stand.stand_file import dumps
kind, count = sys.argv[1], int(sys.argv[2])
features = BARE if kind == "bare" else EVERYTHING
print(dumps(random_stand(np.random.default_rng([1986, count]), count, features, name=f"{kind}{count}")))
"""
"""Writes a stand. In a process of its own: what this one has imported would count as memory of those it starts."""

BUILD = "import mahovik; mahovik.build(mahovik.load('STAND.toml'))"

STARTS: tuple[tuple[tuple[str, ...], float], ...] = (
    (("--help",), 0.25),
    (("new", "--list"), 0.25),
    (("generate", "--help"), 0.25),
    (("check", "STAND.toml"), 0.25),
    (("check", "MANY.toml"), 2.0),
    (("eval", "STAND.toml"), 0.25),
    (("generate", "STAND.toml", "-o", "out"), 1.2),
    (("verify", "STAND.toml"), 8.0),
    (("report", "STAND.toml", "-o", "report.html"), 6.0),
)
"""Commands and their limits, s: STAND.toml is bench8, MANY.toml has 1,000 flywheels; `eval` gets no state."""

INSTALL, DEMO, TESTS = 'pip install ".[report]"', "make demo", "make setup-test"


@dataclass(frozen=True)
class Spent:
    """Wall-clock seconds, processor seconds and MB of a process."""

    clock: float
    processor: float
    memory: float


def run(command: Sequence[str], env: Mapping[str, str], folder: Path) -> Spent:
    """One process. Raises SystemExit where it fails."""
    begin = time.perf_counter()
    quiet = subprocess.DEVNULL
    process = subprocess.Popen(command, env=dict(env), stdin=quiet, stdout=quiet, cwd=folder)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        raise SystemExit(f"{' '.join(command)}: exit status {process.returncode}")
    return Spent(time.perf_counter() - begin, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024)


def least(command: Sequence[str], env: Mapping[str, str], folder: Path, repeat: int) -> Spent:
    """The least time and the largest memory over repetitions, after a run that fills the caches."""
    run(command, env, folder)
    runs = [run(command, env, folder) for _ in range(repeat)]
    return Spent(min(s.clock for s in runs), min(s.processor for s in runs), max(s.memory for s in runs))


def environment(folder: Path) -> dict[str, str]:
    """Variables of the processes: caches and compiled modules in the folder."""
    caches = {VARIABLE: str(folder / "cache"), "PYTHONPYCACHEPREFIX": str(folder / "modules")}
    return {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"} | caches


def mahovik(*arguments: str) -> list[str]:
    """The command."""
    return [sys.executable, "-m", "mahovik", *arguments]


def generation(options: Namespace) -> Iterator[tuple[Any, ...]]:
    """`generate`, and the compiler on what it made."""
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        env = environment(folder)
        for kind in KINDS:
            for count in COUNTS:
                name = f"{kind}{count}"
                draw = [sys.executable, "-c", DRAW, kind, str(count)]
                text = subprocess.run(draw, stdout=subprocess.PIPE, text=True, check=True).stdout
                (folder / f"{name}.toml").write_text(text, encoding="utf-8")
                command = mahovik("generate", f"{name}.toml", "-o", name)
                made = least(command, env, folder, options.repeat)
                flags = ["-std=c99", "-O2", "-ffp-contract=off", "-c", f"{name}/{name}.c", "-o", os.devnull]
                compiled = least(["gcc", *flags], env, folder, options.repeat)
                yield f"{kind}, {count}", made.processor, compiled.processor, made.memory


def start(options: Namespace) -> Iterator[tuple[Any, ...]]:
    """Commands as a user starts them, in a folder with the stands."""
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        env = environment(folder)
        (folder / "STAND.toml").write_text(path("bench8").read_text(encoding="utf-8"), encoding="utf-8")
        draw = [sys.executable, "-c", DRAW, KINDS[0], "1000"]
        text = subprocess.run(draw, stdout=subprocess.PIPE, text=True, check=True).stdout
        (folder / "MANY.toml").write_text(text, encoding="utf-8")
        python = [sys.executable, "-c"]
        commands = [(f"mahovik {' '.join(words)}", mahovik(*words), most) for words, most in STARTS]
        commands += [("import mahovik", [*python, "import mahovik"], 0.15), (BUILD, [*python, BUILD], 4.0)]
        for what, command, most in commands:
            spent = least(command, env, folder, options.repeat)
            yield what, spent.clock, spent.processor, spent.memory, most


def disk(folder: Path) -> float:
    """Disk that a folder takes, MB."""
    files = (Path(root) / name for root, folders, names in os.walk(folder) for name in (*folders, *names))
    return sum(file.lstat().st_blocks * 512 for file in files) / 1e6


def install(options: Namespace) -> Iterator[tuple[str, float, float]]:
    """`pip install` in a new environment, then `make demo` and `make setup-test`, in a fresh clone."""
    base = getattr(sys, "_base_executable", sys.executable)
    env = {name: value for name, value in os.environ.items() if name not in ("PYTHONPATH", "VIRTUAL_ENV")}
    with tempfile.TemporaryDirectory() as scratch:
        clone, venv = Path(scratch) / "mahovik", Path(scratch) / "venv"
        subprocess.run(["git", "clone", "-q", ROOT, clone], check=True)
        run([base, "-m", "venv", str(venv)], env, clone)
        pip = [str(venv / "bin" / "pip"), "install", "-q", ".[report]"]
        yield INSTALL, run(pip, env, clone).clock, disk(venv)
        for command in (DEMO, TESTS):
            yield command, run([*command.split(), f"PYTHON={base}"], env, clone).clock, disk(clone / ".venv")


def is_soon(row: Row) -> bool:
    """Whether a command keeps its limit."""
    return bool(min(row["seconds"], row["processor, s"]) <= row["limit, s"])


def claim_of_generation(rows: Rows) -> str:
    """The time of eight flywheels, and the longest."""
    seconds = {row["stand, flywheels"]: row["cold, s"] for row in rows}
    return (
        f"C of a stand with eight flywheels and every law is generated in {seconds['everything, 8']:.1f} s, of a "
        f"thousand in {seconds['everything, 1000']:.0f} s"
    )


def claim_of_start(rows: Rows) -> str:
    """Three commands."""
    seconds = {row["command"]: row["seconds"] for row in rows}
    words = [f"`{name}` {seconds[f'mahovik {name} STAND.toml']:.2f} s" for name in ("check", "eval", "verify")]
    return f"A command needs, imports included: {', '.join(words)}"


def claim_of_install(rows: Rows) -> str:
    """Time and disk."""
    words = [f"`{row['command']}` {row['seconds']:.0f} s and {row['MB'] / 1000:.1f} GB" for row in rows]
    return f"An install takes: {', '.join(words)}"


TABLES = {
    "generation": Table(
        generation,
        {"stand, flywheels": "{}", "cold, s": "{:.2f}", "gcc -O2, s": "{:.2f}", "MB": "{:.0f}"},
        claim_of_generation,
        note="Processor seconds of `generate` and of the compiler on its C, and the memory of `generate`.",
    ),
    "start": Table(
        start,
        {"command": "`{}`", "seconds": "{:.2f}", "processor, s": "{:.2f}", "MB": "{:.0f}", "limit, s": "{:g}"},
        claim_of_start,
        is_soon,
        "Commands as a user starts them; STAND.toml is bench8, MANY.toml has 1,000 flywheels.",
    ),
    "install": Table(
        install,
        {"command": "`{}`", "seconds": "{:.0f}", "MB": "{:.0f}"},
        claim_of_install,
        note="In a fresh clone; the last command adds to the environment of the one before. Times include downloads of "
        "what was not in pip's cache.",
    ),
}
