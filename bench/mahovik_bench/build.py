"""Libraries of peers: made once, kept in build/bench under the hash of all that went in."""

from __future__ import annotations

import hashlib
import json
import os
import subprocess
import sys
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from functools import cache
from pathlib import Path

from mahovik.errors import ToolchainError

ROOT = Path(__file__).resolve().parents[2]
NATIVE = ROOT / "bench" / "native"
CACHE = ROOT / "build" / "bench"


@dataclass(frozen=True)
class Effort:
    """What a command took: seconds, and the largest memory of a process of it in MB."""

    seconds: float
    memory: float


@dataclass(frozen=True)
class Built:
    """A shared library. `compiled`: all its sources; `text`, `data`: bytes of code and of constants of `measured`."""

    library: Path
    compiled: Effort
    text: int
    data: int


def measured(command: Sequence[str], folder: Path) -> Effort:
    """Runs a command and says what it took. Raises ToolchainError with what it said first of an error."""
    errors = folder / "stderr"
    with errors.open("wb") as stream:
        done = subprocess.run(
            [_launcher(), *command],
            cwd=folder,
            stdout=subprocess.PIPE,
            stderr=stream,
            stdin=subprocess.DEVNULL,
            env=_environment(),
            check=False,
            text=True,
        )
    if done.returncode != 0:
        said = errors.read_text(encoding="utf-8", errors="replace").strip().splitlines()
        first = next((line for line in said if "rror" in line), said[-1] if said else "no message")
        raise ToolchainError(f"{command[0]}: {first}")
    seconds, memory = done.stdout.splitlines()[-1].split()
    return Effort(float(seconds), int(memory) / 1024)


@cache
def _launcher() -> str:
    """native/launch.c, compiled."""
    program = CACHE / "launch"
    CACHE.mkdir(parents=True, exist_ok=True)
    subprocess.run(["gcc", "-std=c99", "-O2", str(NATIVE / "launch.c"), "-o", str(program)], check=True)
    return str(program)


def _environment() -> dict[str, str]:
    """This one, where a child finds the same modules."""
    return {**os.environ, "PYTHONPATH": os.pathsep.join([str(ROOT / "bench"), str(ROOT / "generator")])}


def key(*parts: object) -> str:
    """Name of a cache entry."""
    return hashlib.sha256("\0".join(map(str, parts)).encode()).hexdigest()[:20]


def compiler_version(compiler: str) -> str:
    """First line of what the compiler says of itself."""
    said = subprocess.run([compiler, "--version"], capture_output=True, text=True, check=True).stdout
    return said.splitlines()[0]


@dataclass(frozen=True)
class Recipe:
    """How a library is made. `sources`: text by file name; of `measured` (all where empty) the sizes are taken."""

    compiler: str
    flags: tuple[str, ...]
    sources: Mapping[str, str]
    measured: tuple[str, ...] = ()
    link: tuple[str, ...] = ()

    def folder(self) -> Path:
        """Where it is kept."""
        native = [(NATIVE / "peer.h").read_text(encoding="utf-8")]
        march = _cpu() if "-march=native" in self.flags else ""
        parts = (compiler_version(self.compiler), march, *self.flags, *self.link, *native)
        return CACHE / key(*parts, *self.measured, json.dumps(dict(self.sources), sort_keys=True))

    def made(self) -> bool:
        """Is it in the cache?"""
        return (self.folder() / "built.json").is_file()

    def build(self) -> Built:
        """The library, from the cache where it is there. Raises ToolchainError."""
        folder = self.folder()
        record = folder / "built.json"
        library = folder / "peer.so"
        if not record.is_file():
            folder.mkdir(parents=True, exist_ok=True)
            for name, text in self.sources.items():
                (folder / name).write_text(text, encoding="utf-8")
            record.write_text(json.dumps(self._compile(folder, library)), encoding="utf-8")
        told = json.loads(record.read_text(encoding="utf-8"))
        return Built(library, Effort(**told["compiled"]), told["text"], told["data"])

    def _compile(self, folder: Path, library: Path) -> dict[str, object]:
        seconds, memory, objects = 0.0, 0.0, []
        sizes = {"text": 0, "data": 0}
        for name in self.sources:
            if not name.endswith((".c", ".cpp")):
                continue
            objects.append(f"{name}.o")
            command = [self.compiler, *self.flags, "-fPIC", f"-I{NATIVE}", "-I.", "-c", name, "-o", objects[-1]]
            effort = measured(command, folder)
            if not self.measured or name in self.measured:
                seconds, memory = seconds + effort.seconds, max(memory, effort.memory)
                for section, size in _sections(folder / objects[-1]):
                    sizes[section] += size
        measured([self.compiler, "-shared", *objects, "-o", str(library), *self.link], folder)
        return {"compiled": asdict(Effort(seconds, memory)), **sizes}


def generated(name: str, *arguments: str) -> tuple[Path, Effort]:
    """The folder of what `python -m mahovik_bench.NAME FOLDER ARGUMENTS` writes, cached by the text of the package."""
    sources = sorted((ROOT / "generator" / "mahovik").rglob("*.py")) if name == "write_own" else []
    sources += [ROOT / "bench" / "mahovik_bench" / f"{each}.py" for each in (name, "cases", "literal")]
    sources += sorted((ROOT / "templates").glob("*.j2")) if name == "write_own" else []
    texts = [path.read_text(encoding="utf-8") for path in sources]
    folder = CACHE / key(name, *arguments, *texts)
    record = folder / "generated.json"
    if not record.is_file():
        folder.mkdir(parents=True, exist_ok=True)
        effort = measured([sys.executable, "-m", f"mahovik_bench.{name}", str(folder), *arguments], folder)
        record.write_text(json.dumps(asdict(effort)), encoding="utf-8")
    return folder, Effort(**json.loads(record.read_text(encoding="utf-8")))


def _sections(compiled: Path) -> list[tuple[str, int]]:
    """Bytes of code and of constants."""
    listing = subprocess.run(["size", "-A", compiled], capture_output=True, text=True, check=True).stdout
    found = []
    for line in listing.splitlines():
        words = line.split()
        if len(words) == 3 and words[1].isdigit():
            if words[0].startswith(".text"):
                found.append(("text", int(words[1])))
            elif words[0].startswith((".rodata", ".data")):
                found.append(("data", int(words[1])))
    return found


def _cpu() -> str:
    """What -march=native depends on."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        return ""
    return next((line for line in lines if line.startswith("flags")), "")
