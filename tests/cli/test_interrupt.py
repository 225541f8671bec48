"""Ctrl-C, as a real signal to a process of its own: what is kept, what is said, and that nothing is left behind."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

import pytest

from cli.run import DEMO3
from cli.test_terminal import RUN
from toolchain.quick import quick

ENDS = 60.0
"""s in which a command must end; it takes a fraction of one, and this machine may be busy."""

STARTED: list[subprocess.Popen[str]] = []
"""Processes that the running test has started."""


@pytest.fixture(autouse=True)
def nothing_is_left() -> Iterator[None]:
    """Ends what a failed test has started."""
    yield
    for process in STARTED:
        if process.poll() is None:
            process.kill()
            process.communicate()
    STARTED.clear()


COMPILER = """#!/bin/sh
case "$*" in *-dM*) exit 0 ;; esac
echo $$ > "{folder}/parent"
sleep 300 &
echo $! > "{folder}/child"
trap 'rm -f "{folder}/parent"; exit 1' TERM
wait
"""
"""A compiler that says what it is and then never ends, with a part of its own, as gcc has cc1."""


SLOW_MOVES = f"""
import os, time
move = os.replace
def slow(*given):
    time.sleep(0.3)
    move(*given)
os.replace = slow
{RUN}
"""
"""The command line, where a file takes its place slowly."""


@dataclass
class Started:
    """A command that runs, with a folder for its temporary files."""

    arguments: tuple[str, ...]
    folder: Path
    env: dict[str, str] = field(default_factory=dict)
    code: str = RUN

    def __post_init__(self) -> None:
        self.scratch = self.folder / "scratch"
        self.work = self.folder / "work"
        self.scratch.mkdir()
        self.work.mkdir()
        self.process = subprocess.Popen(
            [sys.executable, "-c", self.code, *self.arguments],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            cwd=self.work,
            env={**os.environ, "TMPDIR": str(self.scratch), **self.env},
        )
        STARTED.append(self.process)

    def until(self, condition: Callable[[], bool]) -> Started:
        """Waits for it."""
        end = time.monotonic() + 60.0
        while not condition():
            assert time.monotonic() < end
            assert self.process.poll() is None, self.process.communicate()
            time.sleep(0.02)
        return self

    def compiled(self) -> Started:
        """Waits until its C is loaded: the folder of the compiler has come and gone."""
        self.until(lambda: any(self.scratch.iterdir()))
        return self.until(lambda: not any(self.scratch.iterdir()))

    def interrupt(self) -> tuple[str, str]:
        """Ctrl-C, to this process alone: what it says. Asserts what holds for all commands."""
        self.process.send_signal(signal.SIGINT)
        output, complaint = self.process.communicate(timeout=ENDS)
        assert "Traceback" not in complaint
        assert list(self.scratch.iterdir()) == []
        assert not list(self.work.rglob(".*"))
        return output, complaint


def has_ended(pid: int) -> bool:
    """Whether no such process runs; one that has ended and that nobody has asked for is gone."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] == "Z"
    except OSError:
        return True


BUILD = """
import sys, mahovik
try:
    mahovik.build(mahovik.example("demo3"))
except KeyboardInterrupt:
    print("error: interrupted; no file is half written", file=sys.stderr)
    sys.exit(130)
"""
"""The Python interface, in place of the command line."""


@pytest.mark.parametrize(
    ("arguments", "code"),
    quick(
        1,
        [
            (("simulate", DEMO3, "--until", "1", "-o", "run.csv"), RUN),
            (("report", DEMO3, "-o", "r.html"), RUN),
            ((), BUILD),
        ],
    ),
    ids=["simulate", "report", "build"],
)
def test_while_it_compiles(arguments: tuple[str, ...], code: str, tmp_path: Path) -> None:
    """No process of the compiler goes on, and its temporary files are gone."""
    compiler = tmp_path / "compiler"
    compiler.write_text(COMPILER.format(folder=tmp_path))
    compiler.chmod(0o755)
    started = Started(arguments, tmp_path, {"CC": str(compiler), "MAHOVIK_CACHE": str(tmp_path / "cache")}, code)
    child = tmp_path / "child"
    started.until(lambda: child.exists() and child.read_text().strip() != "")
    pids = [int((tmp_path / name).read_text()) for name in ("parent", "child")]
    _, said = started.interrupt()
    assert (started.process.returncode, said) == (130, "error: interrupted; no file is half written\n")
    assert list(started.work.iterdir()) == []
    assert not (tmp_path / "parent").exists()
    assert all(map(has_ended, pids))


@pytest.mark.parametrize("moves", [0, 1, 2])
def test_while_it_writes(moves: int, tmp_path: Path) -> None:
    """Some files are in place, others not yet: the old ones come back, all of them."""
    folder = tmp_path / "work"
    started = Started(("new", "bench8", "-o", str(folder)), tmp_path, code=SLOW_MOVES)
    started.until(lambda: len(list(folder.glob("bench8*"))) >= moves and any(folder.glob(".*")))
    _, said = started.interrupt()
    assert (started.process.returncode, said) == (130, "error: interrupted; no file is half written\n")
    assert list(folder.iterdir()) == []
