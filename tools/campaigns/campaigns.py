"""Campaigns of sat4 measured: workers side by side, memory of one, load of a scheduler, a million samples."""

from __future__ import annotations

import json
import os
import socket
import subprocess
import sys
import tempfile
import time
from argparse import Namespace
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from campaigns import Rows, Table, cores
from mahovik.out.campaign.campaign import Campaign
from mahovik.out.campaign.cluster import connect
from mahovik.out.campaign.engine import run_shards
from mahovik.out.campaign.folder import begin
from mahovik.out.campaign.rows import Rows as Samples

OPTIONS = {"samples": 10**6}

SAT4 = """
schema = 1
name = "sat4-tolerances"
stand = "sat4"
samples = {samples}
[vary]
"rw*.unbalance.static" = {{ normal = ["1 g mm", "0.3 g mm"] }}
"rw*.unbalance.static_at" = {{ uniform = ["0 deg", "360 deg"] }}
"carrier.mass" = {{ tolerance = "0.5 kg" }}
[over]
regime = {{ default = {{ speed = "2000 rpm" }} }}
until = "0.1 s"
dt = "0.5 ms"
[[quantity]]
name = "shake"
what = "rms acceleration"
at = "acc1"

[[quantity]]
name = "peak_rotation"
what = "peak rotation"
at = "acc1"
"""

EMPTY = 600
"""Shards without work, of which the load of a scheduler is measured."""

MEMORY = """
import resource, sys
from pathlib import Path
from mahovik.out.campaign.folder import make_shard
for number in range(16):
    make_shard(Path(sys.argv[1]), number)
print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)
"""


class Empty:
    """A campaign whose rows cost nothing."""

    def __init__(self, path: Path, shard_size: int | None, computing: bool) -> None:
        made = Campaign.load(path, shard=1, computing=computing)
        self.name, self.identity, self.samples, self.shard_size = "empty", made.identity, EMPTY, 1
        self.parameters, self.quantities = made.parameters, made.quantities
        self.stand, self.goal, self.stand_of, self.sensitivity = made.stand, None, made.stand_of, made.sensitivity
        self.has_quantiles = made.has_quantiles

    def rows(self, first: int, count: int) -> Samples:
        """Zeros."""
        zero = np.zeros(count)
        drawn, computed = dict.fromkeys(self.parameters, zero), dict.fromkeys(self.quantities, zero)
        return Samples(np.arange(first, first + count), drawn, computed, [""] * count)


def rate(folder: Path, file: Path, workers: int) -> float:
    """Samples a second of some workers, without their start."""
    out = folder / f"workers-{workers}"
    begin(out, file, Campaign.load(file, shard=1000))
    marks: list[tuple[float, float]] = []

    def note(now: Any) -> None:
        if now.done and (not marks or now.done > marks[-1][1]):
            marks.append((time.monotonic(), now.done))

    run_shards(out, workers=workers, progress=note)
    steady = [mark for mark in marks if mark[1] >= 2000 * workers]
    return (steady[-1][1] - steady[0][1]) / (steady[-1][0] - steady[0][0])


def memory(folder: Path, file: Path) -> float:
    """Largest memory of a process after sixteen shards, MB."""
    out = folder / "memory"
    begin(out, file, Campaign.load(file, shard=1000))
    command = [sys.executable, "-c", MEMORY, str(out)]
    return int(subprocess.run(command, check=True, capture_output=True, text=True).stdout) / 1024.0


def scheduler_load(folder: Path, file: Path) -> tuple[float, float]:
    """Processor time of a scheduler and of its client for a shard that costs nothing, ms."""
    out = folder / "empty"
    begin(out, file, Empty(file, None, True))
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = str(free.getsockname()[1])
    code = "import sys; from distributed.cli.dask_{} import main; main(sys.argv[1:])"
    tools = str(Path(__file__).parents[1])  # workers load Empty from here
    env = {**os.environ, "DASK_LOGGING__DISTRIBUTED": "critical", "PYTHONPATH": tools}
    address = f"tcp://127.0.0.1:{port}"
    commands = [("scheduler", ["--host", "127.0.0.1", "--port", port, "--no-dashboard"])]
    commands += [("worker", [address, "--nthreads", "1", "--no-nanny", "--no-dashboard"])] * 2
    started = []
    try:
        for name, arguments in commands:
            started.append(subprocess.Popen([sys.executable, "-c", code.format(name), *arguments], env=env))
            time.sleep(3.0)
        with connect(None, address) as client:
            client.wait_for_workers(2, timeout=60)
        before, begun = processor_seconds(started[0].pid), time.process_time()
        result = run_shards(out, scheduler=address, load=Empty)
        assert result.status.complete, result.given_up
        scheduler, client_seconds = processor_seconds(started[0].pid) - before, time.process_time() - begun
        return 1e3 * scheduler / EMPTY, 1e3 * client_seconds / EMPTY
    finally:
        for process in started:
            process.kill()
            process.wait()


def processor_seconds(pid: int) -> float:
    """Processor time that a process has taken, s."""
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def measure(options: Namespace) -> Iterator[tuple[str, float, float | None, float | None]]:
    """A row for each figure with the least and the most that is promised."""
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        file, many = folder / "sat4.toml", folder / "many.toml"
        file.write_text(SAT4.format(samples=32_000))
        one, two = rate(folder, file, 1), rate(folder, file, 2)
        yield "samples a second, one worker", one, None, None
        yield "samples a second, two workers", two, None, None
        yield "two workers, % of twice one", 100.0 * two / (2.0 * one), 85.0, None
        yield "memory of a process after sixteen shards, MB", memory(folder, file), None, 400.0
        scheduler, client = scheduler_load(folder, file)
        yield "scheduler, ms of its processor for a shard", scheduler, None, None
        yield "client, ms of its processor for a shard", client, None, None
        many.write_text(SAT4.format(samples=options.samples))
        mahovik, out = [sys.executable, "-m", "mahovik", "campaign"], folder / "many"
        begun = time.monotonic()
        done = subprocess.run(
            [*mahovik, "run", str(many), "-o", str(out), "--json"], check=True, capture_output=True, text=True
        )
        seconds, begun = time.monotonic() - begun, time.monotonic()
        status = json.loads(done.stdout)
        subprocess.run([*mahovik, "report", str(out), "-o", str(folder / "many.html")], check=True, capture_output=True)
        yield f"samples of `campaign run` on {cores()} cores", status["rows"], options.samples, options.samples
        yield "seconds of the run", seconds, None, None
        yield "samples without quantities", status["failed"], None, 0
        yield "rows, MB", sum(path.stat().st_size for path in out.glob("rows/*/*")) / 1e6, None, None
        yield "seconds of the report", time.monotonic() - begun, None, None


def is_promised(row: Any) -> bool:
    """Whether a figure is between its limits."""
    least, most = row["at least"], row["at most"]
    return (least is None or row["figure"] >= least) and (most is None or row["figure"] <= most)


def claim(rows: Rows) -> str:
    """The large run."""
    figures = {row["what"]: row["figure"] for row in rows}
    (samples,) = (figures[what] for what in figures if what.startswith("samples of"))
    return (
        f"{samples:,} samples of `sat4`, 0.1 s in 200 steps of order 4, take {figures['seconds of the run']:.0f} s on "
        f"two cores; two workers have {figures['two workers, % of twice one']:.0f} % of twice the speed of one, and a "
        f"process takes {figures['memory of a process after sixteen shards, MB']:.0f} MB"
    )


TABLES = {
    "scale": Table(
        measure,
        {"what": "{}", "figure": "{:,.5g}", "at least": "{:,.5g}", "at most": "{:,.5g}"},
        claim,
        is_promised,
        "A campaign over tolerances of `sat4`; the load of a scheduler by shards without work. The scheduler and the "
        "client are the limit of a large cluster: where they are busy for more than half of a core, take longer shards "
        "(`shard` in the [campaign file](campaign-file.md)), or arrays without an engine, which have no scheduler.",
    )
}
