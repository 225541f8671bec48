"""Processes of a campaign, each a real one: client, scheduler and workers, which tests kill, stop and continue."""

from __future__ import annotations

import os
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

TESTS = Path(__file__).resolve().parents[1]
PATIENCE = 60.0
"""s in which something must happen; it takes a few, and this machine may be busy."""

CLIENT = """
import signal, sys
from pathlib import Path
from campaigns.stub import load_stub
from mahovik.errors import MahovikError
from mahovik.out.campaign.face import Campaign
signal.signal(signal.SIGINT, signal.default_int_handler)
if __name__ == "__main__":
    file, out, workers, scheduler = sys.argv[1:]
    try:
        campaign = Campaign(file, load=load_stub)
        found = campaign.run(out, workers=int(workers) or None, scheduler=scheduler or None)
    except MahovikError as error:
        print(f"error: {error}")
        sys.exit(error.exit_status)
    except KeyboardInterrupt:
        print("interrupted")
        sys.exit(130)
    print(*found.status.lines(), *found.given_up, sep="\\n")
    sys.exit(0 if found.status.complete else 1)
"""

WORKER = """
import os, signal, sys, mahovik
from distributed.cli.dask_worker import main
{planted}
main([sys.argv[1], "--nthreads", "1", "--no-nanny", "--no-dashboard", "--memory-limit", "0", "--name", sys.argv[2]])
"""


SCHEDULER = """
import sys, dask
dask.config.set({{"distributed.scheduler.worker-ttl": "{ttl}"}})
from distributed.cli.dask_scheduler import main
main(["--host", "127.0.0.1", "--port", sys.argv[1], "--no-dashboard", "--dashboard-address", "127.0.0.1:0"])
"""


class Processes:
    """Processes of one test."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.started: list[subprocess.Popen[str]] = []

    def start(self, code: str, *arguments: str) -> subprocess.Popen[str]:
        """Start Python with some code, in a group of its own; all it prints goes to one pipe."""
        env = {**os.environ, "PYTHONPATH": str(TESTS), "OMP_NUM_THREADS": "1", "DASK_LOGGING__DISTRIBUTED": "critical"}
        process = subprocess.Popen(
            [sys.executable, "-c", code, *arguments],
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            cwd=self.folder,
            env=env,
            start_new_session=True,
        )
        self.started.append(process)
        return process

    def client(self, file: Path, out: Path, workers: int = 0, scheduler: str = "") -> subprocess.Popen[str]:
        """Start a client that runs the campaign of a file."""
        return self.start(CLIENT, str(file), str(out), str(workers), scheduler)

    def scheduler(self, ttl: str = "30s") -> tuple[str, subprocess.Popen[str]]:
        """Start a scheduler that gives up workers of which it does not hear for some time: address, process."""
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port = free.getsockname()[1]
        process = self.start(SCHEDULER.format(ttl=ttl), str(port))
        until(lambda: listens(port))
        return f"tcp://127.0.0.1:{port}", process

    def worker(self, scheduler: str, name: str, planted: str = "") -> subprocess.Popen[str]:
        """Start a worker, a process without another that starts it again."""
        return self.start(WORKER.format(planted=planted), scheduler, name)

    def end(self) -> None:
        """End all, and all that they have started."""
        for process in self.started:
            for one in (signal.SIGCONT, signal.SIGKILL):
                try:
                    os.killpg(process.pid, one)
                except ProcessLookupError:
                    break
            process.communicate()


@contextmanager
def processes(folder: Path) -> Iterator[Processes]:
    """Processes that end with the body."""
    found = Processes(folder)
    try:
        yield found
    finally:
        found.end()


def listens(port: int) -> bool:
    """Whether some process listens at a port of this machine."""
    with socket.socket() as tried:
        return tried.connect_ex(("127.0.0.1", port)) == 0


def until(condition: Callable[[], bool]) -> None:
    """Wait for it."""
    end = time.monotonic() + PATIENCE
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.02)


def finish(process: subprocess.Popen[str]) -> str:
    """Output of a process, which must end by itself, and without a traceback."""
    said, _ = process.communicate(timeout=6 * PATIENCE)
    assert "Traceback" not in said, said
    return said


def shard_files(out: Path) -> list[Path]:
    """Shards that are in their places."""
    return sorted(out.glob("rows/*/*.parquet"))
