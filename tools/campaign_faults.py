"""A campaign whose workers are killed at random, then the scheduler, then the client; every sample is there at the end.

python tools/campaign_faults.py [--kills 20] [--seed 1]

Writes docs/results/campaign-faults.md; some minutes. All are real processes, and are killed by SIGKILL.
"""

from __future__ import annotations

import os
import random
import signal
import socket
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import campaign
from kept import Campaign as Kept
from kept import Columns, Figures

from mahovik.out.campaign.dataset import Status, status
from mahovik.out.campaign.face import Campaign

FILE = """
schema = 1
stand = "sat4"
samples = 120000
shard = 200
[vary]
"rw*.unbalance.static" = { normal = ["1 g mm", "0.3 g mm"] }
"carrier.mass" = { tolerance = "0.5 kg" }
[over]
regime = { default = { speed = "2000 rpm" } }
until = "1 s"
dt = "0.5 ms"
[[quantity]]
name = "shake"
what = "rms acceleration"
at = "acc1"
"""

WORKERS = 2
WAIT = (0.1, 1.5)
"""s between a worker that computes and its end, drawn evenly."""

PATIENCE = 300.0
"""s in which something must go on."""

SCHEDULER = "from distributed.cli.dask_scheduler import main; import sys; main(sys.argv[1:])"
WORKER = "from distributed.cli.dask_worker import main; import sys; main(sys.argv[1:])"


@dataclass
class Cluster:
    """Processes of a campaign, which are killed and started again."""

    folder: Path
    port: str = ""
    scheduler: Any = None
    workers: list[Any] = field(default_factory=list)

    def start(self) -> None:
        """Start a scheduler and its workers."""
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            self.port = str(free.getsockname()[1])
        self.scheduler = self._process(SCHEDULER, "--host", "127.0.0.1", "--port", self.port, "--no-dashboard")
        self._await_scheduler()
        self.workers = [self.worker() for _ in range(WORKERS)]

    def _await_scheduler(self) -> None:
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            with socket.socket() as tried:
                if tried.connect_ex(("127.0.0.1", int(self.port))) == 0:
                    time.sleep(2.0)  # it listens before it answers
                    return
            time.sleep(0.1)

    @property
    def address(self) -> str:
        """Address of the scheduler."""
        return f"tcp://127.0.0.1:{self.port}"

    def worker(self) -> Any:
        """Start a worker."""
        return self._process(WORKER, self.address, "--nthreads", "1", "--no-nanny", "--no-dashboard")

    def client(self, *arguments: str) -> Any:
        """Start a command `mahovik campaign`."""
        return self._process("from mahovik.__main__ import run; run()", "campaign", *arguments)

    def end(self) -> None:
        """End all."""
        for process in [*self.workers, self.scheduler]:
            kill(process)

    def _process(self, code: str, *arguments: str) -> Any:
        env = {**os.environ, "DASK_LOGGING__DISTRIBUTED": "critical"}
        return subprocess.Popen(
            [sys.executable, "-c", code, *arguments], cwd=self.folder, env=env, text=True, stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
        )  # fmt: skip


def kill(process: Any) -> None:
    """End a process by SIGKILL."""
    if process.returncode is None:
        process.send_signal(signal.SIGKILL)
        process.communicate()


def shards(folder: Path) -> int:
    """Shards in their places."""
    return len(list((folder / "out").glob("rows/*/*.parquet")))


def await_shards(folder: Path, count: int, client: Any) -> None:
    """Wait until there are more shards than before. Raises SystemExit."""
    end = time.monotonic() + PATIENCE
    while shards(folder) <= count and client.poll() is None:
        if time.monotonic() > end:
            raise SystemExit("nothing goes on")
        time.sleep(0.05)


def campaign_of_faults(folder: Path, kills: int, seed: int) -> list[tuple[Any, ...]]:
    """A row for each part: faults, shards that were whole then, drafts, what was said."""
    rng, rows = random.Random(seed), []
    (folder / "c.toml").write_text(FILE)
    cluster = Cluster(folder)
    cluster.start()
    client = cluster.client("run", "c.toml", "-o", "out", "--scheduler", cluster.address)
    done = 0
    while done < kills and client.poll() is None:
        await_shards(folder, shards(folder), client)
        time.sleep(rng.uniform(*WAIT))
        number = rng.randrange(WORKERS)
        kill(cluster.workers[number])
        cluster.workers[number] = cluster.worker()
        done += 1
    if done < kills:
        raise SystemExit(f"the campaign ended after {done} faults: {client.communicate()[0]}")
    rows.append(_row("a worker is killed at random", done, folder, "the campaign goes on"))
    kill(cluster.scheduler)
    said, _ = client.communicate(timeout=PATIENCE)
    rows.append(_row("the scheduler is killed", 1, folder, _sentence(said)))
    cluster.end()
    cluster.start()
    client = cluster.client("resume", "out", "--scheduler", cluster.address)
    await_shards(folder, shards(folder), client)
    kill(client)
    rows.append(_row("the client is killed", 1, folder, ""))
    client = cluster.client("resume", "out", "--scheduler", cluster.address)
    said, _ = client.communicate(timeout=2 * PATIENCE)
    rows.append(_row("nothing; `resume`", 0, folder, _sentence(said)))
    cluster.end()
    return rows


def _row(what: str, times: int, folder: Path, said: str) -> tuple[Any, ...]:
    found: Status = status(folder / "out")
    return what, times, len(found.records), len(found.damaged), found.drafts, said


def _sentence(said: str) -> str:
    """Words of a command for the page."""
    return said.strip().splitlines()[-1].removeprefix("error: ").partition("; `")[0]


def is_same(folder: Path) -> bool:
    """Whether all shards have the bytes that one process computes."""
    bare = Campaign(folder / "c.toml").prepare(folder / "bare")
    for number in range(bare.manifest.shards):
        bare.shard(number)
    found, known = (sorted((folder / name).glob("rows/*/0*.parquet")) for name in ("out", "bare"))  # without drafts
    pairs = zip(found, known, strict=True)
    return all(one.read_bytes() == other.read_bytes() for one, other in pairs)


TABLE = Columns(
    {
        "fault": "{}", "times": "{}", "whole shards": "{}", "damaged": "{}", "drafts left": "{}", "said": "{}",
    },
    1,
)  # fmt: skip


def page(found: Figures) -> str:
    """The table, and the end."""
    same = ""
    if "same" in found:
        what = "the bytes that" if found["same"] else "**other** bytes than those that"
        same = f"; the shards have {what} one process writes"
    return (
        f"{TABLE.text(found['rows'])}\n{found['shards']} shards of 200 samples of `sat4`, {WORKERS} workers. At the "
        f"end every sample is there once: {found['complete']}{same}."
    )


CAMPAIGN = Kept(
    "campaign-faults",
    campaign.Block("docs/results/campaign-faults.md", "faults"),
    page,
)


def main() -> None:
    """Runs it, keeps the figures, renders the page."""
    given = campaign.parser(__doc__, kills=20, seed=1).parse_args()
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        rows = campaign_of_faults(folder, given.kills, given.seed)
        found = status(folder / "out")
        figures = {
            "rows": TABLE.rows(rows), "shards": found.manifest.shards, "complete": "yes" if found.complete else "no",
            "same": is_same(folder),
        }  # fmt: skip
    CAMPAIGN.keep(figures, given.seed)


if __name__ == "__main__":
    main()
