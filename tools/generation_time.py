"""How long generation, commands and the C compiler take: writes the tables of docs/results/generation.md.

python tools/generation_time.py [--repeat 5] [--only generation|start|profile] [--no-page]

Every run is a process of its own: wall-clock and processor seconds, and peak memory; the least of
the repetitions, of commands also the median. Exit status 1 where a limit is exceeded.

Python keeps the modules that it has compiled, as after an installation by pip, whatever the environment says. What is
held to a limit is the smaller of wall-clock and processor seconds: other work on the machine adds to the first, and
processes side by side to the second.
"""

from __future__ import annotations

import os
import platform
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import campaign
import start_profile
from kept import Campaign, Columns, Figures

from mahovik.core.formula.cache import VARIABLE
from mahovik.stands import path

PARTS = ("generation", "start", "profile")
COUNTS = (2, 8, 64, 1000)
"""Flywheels."""
KINDS = ("bare", "everything")

DRAW = """
import sys
import numpy as np
from mahovik.core.stand.random import BARE, EVERYTHING, random_stand
from mahovik.core.stand.write import dumps
kind, count = sys.argv[1], int(sys.argv[2])
features = BARE if kind == "bare" else EVERYTHING
print(dumps(random_stand(np.random.default_rng([1986, count]), count, features, name=f"{kind}{count}")))
"""
"""Writes a stand. In a process of its own: what this one has imported would count as memory of those it starts."""

MOST_GENERATION, MOST_MEMORY, MOST_COMPILE = 3.0, 300.0, 2.0
"""s, MB, s: generation with at most 64 flywheels, also without a cache; memory; compiler.

Processor seconds, equal to wall-clock seconds on a machine without other work: each is a process of one thread.
"""

AT_ONCE, SOON, REPORT = 0.25, 0.6, 6.0
"""s: help, lists; `rest`; `report` of a run of ten seconds."""

GENERATE = ("generate", "STAND.toml", "-o", "out")

STARTS: tuple[tuple[tuple[str, ...], float], ...] = (
    (("--help",), AT_ONCE),
    (("--version",), AT_ONCE),
    (("new", "--list"), AT_ONCE),
    (("generate", "--help"), AT_ONCE),
    (("check", "STAND.toml"), 0.30),
    (("check", "MANY.toml"), 1.5),
    (("eval", "STAND.toml", "--backend", "numpy"), 0.25),
    (("eval", "STAND.toml"), 0.25),
    (("rest", "STAND.toml"), SOON),
    (GENERATE, 0.9),
    ((*GENERATE, "--no-cache"), 2.2),
    (("verify", "STAND.toml"), 12.0),
    (("report", "STAND.toml", "--run", "run.csv", "-o", "report.html"), REPORT),
)
"""Commands, and the limit of each, s: STAND.toml is bench8, MANY.toml has MANY flywheels; `eval` gets no state."""

MANY = 204

PROFILED = (("check", "STAND.toml"), ("eval", "STAND.toml", "--backend", "numpy"), GENERATE, (*GENERATE, "--no-cache"))
"""Commands whose start is taken apart."""

BUILD = "import mahovik; mahovik.build(mahovik.load('STAND.toml'))"

SECOND = """
import time, mahovik
first = mahovik.load("STAND.toml")
mahovik.build(first)
second = first.replace({"w1.unbalance.static": "%.6f g mm" % (1.0 + time.time() % 1.0)})
clock, processor = time.perf_counter(), time.process_time()
mahovik.build(second)
print(time.perf_counter() - clock, time.process_time() - processor)
"""
"""Builds a stand of the structure of another that is built already, with numbers that none had before."""


@dataclass(frozen=True)
class Spent:
    """Figures of a process: wall-clock seconds, processor seconds, MB."""

    clock: float
    processor: float
    memory: float

    @property
    def cells(self) -> tuple[float, float, float]:
        """Cells of a row of a table."""
        return self.clock, self.processor, self.memory


def run(command: Sequence[str], env: Mapping[str, str], cwd: Path | None = None) -> Spent:
    """One process. Raises SystemExit where it fails."""
    begin = time.perf_counter()
    process = subprocess.Popen(command, env=dict(env), stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, cwd=cwd)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        raise SystemExit(f"{' '.join(command)}: exit status {process.returncode}")
    return Spent(time.perf_counter() - begin, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024)


def least(command: Sequence[str], env: Mapping[str, str], repeat: int) -> Spent:
    """The least of each figure over repetitions."""
    return _least([run(command, env) for _ in range(repeat)])


def _least(found: Sequence[Spent]) -> Spent:
    return Spent(min(s.clock for s in found), min(s.processor for s in found), max(s.memory for s in found))


WHAT = ("cold", "warm", "gcc -O2")
GENERATION = Columns({"stand, N": "{}", **dict.fromkeys(WHAT, "{:.2f}")})
"""Each figure is a list of wall-clock seconds, processor seconds, MB."""
START = Columns(
    {
        "command": "{}", "s": "{:.2f}", "processor, s": "{:.2f}", "MB": "{:.0f}", "median, s": "{:.2f}",
        "limit, s": "{:g}", "verdict": "{}",
    }
)  # fmt: skip


PROFILE = Columns({"command": "{}", **dict.fromkeys((*start_profile.PARTS, "all"), "{:.0f}")})


class Measurement:
    """All of it, with the limits that were exceeded."""

    def __init__(self, folder: Path, repeat: int) -> None:
        self.passed_limits: list[str] = []
        self._folder = folder
        self._repeat = repeat
        self._env = {**os.environ, VARIABLE: str(folder / "cache"), "PYTHONPYCACHEPREFIX": str(folder / "modules")}
        self._env.pop("PYTHONDONTWRITEBYTECODE", None)

    def _check_limit(self, what: str, found: float, most: float) -> None:
        if found > most:
            self.passed_limits.append(f"{what}: {found:.2f}, at most {most:g}")

    def _command(self, *arguments: str) -> list[str]:
        return [sys.executable, "-m", "mahovik", *arguments]

    def generation(self) -> list[dict[str, Any]]:
        """`generate` without a cache and with a warm one, and the compiler on what it made."""
        rows = []
        for kind in KINDS:
            for count in COUNTS:
                name = f"{kind}{count}"
                stand = self._folder / f"{name}.toml"
                stand.write_text(_random_stand(kind, count), encoding="utf-8")
                out = self._folder / name
                command = self._command("generate", str(stand), "-o", str(out))
                cold = least([*command, "--no-cache"], self._env, self._repeat)
                run(command, self._env)
                warm = least(command, self._env, self._repeat)
                flags = ["-std=c99", "-O2", "-ffp-contract=off", "-c", str(out / f"{name}.c"), "-o", os.devnull]
                compiled = least(["gcc", *flags], self._env, self._repeat)
                rows.append((f"{kind}, {count}", cold.cells, warm.cells, compiled.cells))
                print(*rows[-1], sep="   ", flush=True)
                if count <= 64:
                    self._check_limit(f"generation without a cache, {name}, s", cold.processor, MOST_GENERATION)
                    self._check_limit(f"generation, {name}, s", warm.processor, MOST_GENERATION)
                self._check_limit(f"memory, {name}, MB", max(cold.memory, warm.memory), MOST_MEMORY)
                self._check_limit(f"gcc -O2, {name}, s", compiled.processor, MOST_COMPILE)
        return GENERATION.rows(rows)

    def start(self) -> list[dict[str, Any]]:
        """Commands and functions as a user starts them, in a folder with the stand and a run of it."""
        self._files()
        rows = []
        for arguments, most in STARTS:
            repeat = self._repeat if most > 2.0 else 2 * self._repeat
            found = self._runs(self._command(*arguments), repeat)
            rows.append(self._row(f"`mahovik {' '.join(arguments)}`", found, most))
        python = [sys.executable, "-c"]
        rows.append(self._row("`import mahovik`", self._runs([*python, "import mahovik"], 2 * self._repeat), 0.15))
        first = []
        for _ in range(self._repeat):
            shutil.rmtree(self._folder / "cache" / "models", ignore_errors=True)
            first.append(run([*python, BUILD], self._env, self._folder))
        rows.append(self._row("`mahovik.build` of a stand, the first of its structure: whole process", first, 4.0))
        second = "`mahovik.build` of a second stand of that structure, the call"
        found = [self._second(kept=False) for _ in range(self._repeat)]
        rows.append(self._row(f"{second}, where this process built the first", found, 0.2))
        found = [self._second(kept=True) for _ in range(2 * self._repeat)]
        rows.append(self._row(f"{second}, where another process did", found, 0.2))
        for what, code in (("Python alone", "pass"), ("Python and `import numpy, pydantic`", "import numpy, pydantic")):
            rows.append(self._row(what, self._runs([*python, code], 2 * self._repeat), None))
        return START.rows(rows)

    def profile(self) -> list[dict[str, Any]]:
        """Where the time of some commands goes, ms."""
        self._files()
        rows = []
        for arguments in PROFILED:
            found = start_profile.profile(arguments, self._env, self._folder, self._repeat + 1)
            rows.append((f"`mahovik {' '.join(arguments)}`", *found.parts.values(), found.total))
            print(*rows[-1], sep="   ", flush=True)
        return PROFILE.rows(rows)

    def _files(self) -> None:
        (self._folder / "STAND.toml").write_text(path("bench8").read_text(encoding="utf-8"), encoding="utf-8")
        (self._folder / "MANY.toml").write_text(_random_stand("bare", MANY), encoding="utf-8")
        run(self._command("simulate", "STAND.toml", "--until", "10", "-o", "run.csv"), self._env, self._folder)

    def _runs(self, command: Sequence[str], repeat: int) -> list[Spent]:
        """Figures of repetitions, after one that fills the caches."""
        run(command, self._env, self._folder)
        return [run(command, self._env, self._folder) for _ in range(repeat)]

    def _second(self, kept: bool) -> Spent:
        """The second build; `kept`: the library of the first is in the cache."""
        if not kept:
            shutil.rmtree(self._folder / "cache" / "models", ignore_errors=True)
        done = subprocess.run(
            [sys.executable, "-c", SECOND],
            env=self._env,
            cwd=self._folder,
            stdout=subprocess.PIPE,
            text=True,
            check=True,
        )
        clock, processor = map(float, done.stdout.split())
        return Spent(clock, processor, 0.0)

    def _row(self, what: str, found: Sequence[Spent], most: float | None) -> tuple[Any, ...]:
        """A row of the table of commands; its limit is checked."""
        best = _least(found)
        held = min(best.clock, best.processor)
        if most is not None:
            self._check_limit(f"{what}, s", held, most)
        verdict = None if most is None else "ok" if held <= most else "exceeded"
        memory = best.memory or None
        row = (what, best.clock, best.processor, memory, statistics.median(s.clock for s in found), most, verdict)
        print(*row, sep="   ", flush=True)
        return row


def _random_stand(kind: str, count: int) -> str:
    """The file of a random stand."""
    command = [sys.executable, "-c", DRAW, kind, str(count)]
    return subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True).stdout


def machine() -> Figures:
    """Machine of the measurement."""
    gcc = subprocess.run(["gcc", "-dumpfullversion"], capture_output=True, text=True, check=True).stdout.strip()
    return {
        "processor": campaign.processor(),
        "cores": os.cpu_count(),
        "python": platform.python_version(),
        "gcc": gcc,
        "load": os.getloadavg()[1],
    }


def _with_machine(found: Figures, table: str) -> str:
    on = found["machine"]
    verdict = "".join(f"* {line}\n" for line in found["exceeded"]) or "None.\n"
    return (
        f"On {on['processor']}, {on['cores']} cores, Python {on['python']}, gcc {on['gcc']}; processes that wanted to "
        f"run meanwhile, on average: {on['load']:.1f}.\n\n{table}\nLimits that were exceeded:\n\n{verdict}"
    )


def generation_page(found: Figures) -> str:
    """The table of `generate` and the compiler."""
    head = ["stand, N", *(title for what in WHAT for title in (f"{what}, s", "processor, s", "MB"))]
    rows = []
    for row in found["rows"]:
        cells = [f"{x:{form}}" for what in WHAT for x, form in zip(row[what], (".2f", ".2f", ".0f"), strict=True)]
        rows.append([row["stand, N"], *cells])
    return _with_machine(found, campaign.table(head, rows))


def start_page(found: Figures) -> str:
    """The table of commands."""
    return _with_machine(found, START.text(found["rows"]))


def profile_page(found: Figures) -> str:
    """The table of parts."""
    return f"Milliseconds, on the machine above.\n\n{PROFILE.text(found['rows'])}"


def _campaign(name: str, part: str, page: Callable[[Figures], str]) -> Campaign:
    block = campaign.Block("docs/results/generation.md", f"figures: tools/generation_time.py {part}")
    return Campaign(name, block, page)


GENERATION_CAMPAIGN = _campaign("generation", "generation", generation_page)
START_CAMPAIGN = _campaign("start", "start", start_page)
PROFILE_CAMPAIGN = _campaign("profile", "profile", profile_page)

CAMPAIGNS = {"generation": GENERATION_CAMPAIGN, "start": START_CAMPAIGN, "profile": PROFILE_CAMPAIGN}


def main() -> None:
    """Measure, print, write the page. Exit status 1 where a limit is passed."""
    parser = campaign.parser(__doc__, repeat=5)
    parser.add_argument("--only", choices=PARTS)
    parser.add_argument("--no-page", action="store_true", help="print only")
    asked = parser.parse_args()
    failed = False
    for part in PARTS if asked.only is None else (asked.only,):
        with tempfile.TemporaryDirectory() as scratch:
            found = Measurement(Path(scratch), asked.repeat)
            rows = getattr(found, part)()
        each = CAMPAIGNS[part]
        figures = {"machine": machine(), "rows": rows, "exceeded": found.passed_limits}
        failed |= bool(found.passed_limits)
        print(each.page(figures))
        if not asked.no_page:
            each.keep(figures)
    raise SystemExit(1 if failed else 0)


if __name__ == "__main__":
    main()
