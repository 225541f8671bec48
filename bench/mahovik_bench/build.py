"""Libraries of peers: made once, kept in build/bench under the hash of all that went in."""

from __future__ import annotations

import hashlib
import json
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import asdict, dataclass
from pathlib import Path
from threading import Lock

from mahovik.errors import ToolchainError

ROOT = Path(__file__).resolve().parents[2]
NATIVE = ROOT / "bench" / "native"
CACHE = ROOT / "build" / "bench"


@dataclass(frozen=True)
class Effort:
    """Cost of a command: seconds, and the largest memory of a process of it in MB."""

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
            [str(tool("launch.c")), *command],
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


def tool(source: str, *flags: str) -> Path:
    """A C file of native/, compiled to a program or library, and kept."""
    path = NATIVE / source
    made = CACHE / f"{path.stem}-{key(path.read_text(encoding='utf-8'), *flags)}"
    with _TOOLS:
        if not made.is_file():
            with filling(made.with_suffix(".folder")) as folder:
                unfinished = folder / made.name
                command = ["gcc", "-std=gnu11", "-O2", str(path), "-o", str(unfinished), *flags]
                subprocess.run(command, check=True)
                unfinished.replace(made)
    return made


_TOOLS = Lock()


@contextmanager
def filling(folder: Path) -> Iterator[Path]:
    """A scratch folder that becomes `folder` when it is full: no other thread or process sees half of it."""
    folder.parent.mkdir(parents=True, exist_ok=True)
    scratch = Path(tempfile.mkdtemp(prefix="unfinished-", dir=folder.parent))
    try:
        yield scratch
        if any(scratch.iterdir()) and not folder.exists():
            with suppress(OSError):  # another was faster
                scratch.rename(folder)
    finally:
        shutil.rmtree(scratch, ignore_errors=True)


def _environment() -> dict[str, str]:
    """This one, where a child finds the same modules."""
    return {**os.environ, "PYTHONPATH": os.pathsep.join([str(ROOT / "bench"), str(ROOT / "generator")])}


def key(*parts: object) -> str:
    """Name of a cache entry."""
    return hashlib.sha256("\0".join(map(str, parts)).encode()).hexdigest()[:20]


def compiler_version(compiler: str) -> str:
    """First line of the compiler's `--version`."""
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
            with filling(folder) as scratch:
                for name, text in self.sources.items():
                    (scratch / name).write_text(text, encoding="utf-8")
                compiled = self._compile(scratch, scratch / library.name)
                (scratch / record.name).write_text(json.dumps(compiled), encoding="utf-8")
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
    sources = sorted((ROOT / "generator" / "mahovik").rglob("*.py")) if name == "own" else []
    sources += [ROOT / "bench" / "mahovik_bench" / f"{module}.py" for module in (name, "cases", "harmonic", "literal")]
    sources += sorted((ROOT / "templates").glob("*.j2")) if name == "own" else []
    texts = [path.read_text(encoding="utf-8") for path in sources]
    folder = CACHE / key(name, *arguments, *texts)
    record = folder / "generated.json"
    if not record.is_file():
        with filling(folder) as scratch:
            effort = measured([sys.executable, "-m", f"mahovik_bench.{name}", str(scratch), *arguments], scratch)
            (scratch / record.name).write_text(json.dumps(asdict(effort)), encoding="utf-8")
    return folder, Effort(**json.loads(record.read_text(encoding="utf-8")))


def _sections(compiled: Path) -> list[tuple[str, int]]:
    """Code and constants of a compiled file: the name of each section and its size, bytes."""
    listing = subprocess.run(["size", "-A", compiled], capture_output=True, text=True, check=True).stdout
    sizes = []
    for line in listing.splitlines():
        words = line.split()
        if len(words) == 3 and words[1].isdigit():
            if words[0].startswith(".text"):
                sizes.append(("text", int(words[1])))
            elif words[0].startswith((".rodata", ".data")):
                sizes.append(("data", int(words[1])))
    return sizes


def _cpu() -> str:
    """What -march=native depends on."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        return ""
    return next((line for line in lines if line.startswith("flags")), "")
