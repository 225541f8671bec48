"""Campaigns measured: workers side by side, memory of one, load of a scheduler, a million samples, a billion on paper.

python tools/campaign_scale.py [--million] [--print]

Writes docs/results/campaigns.md; some minutes. `--million` also computes a million samples and their report, and keeps
the other figures.
"""

from __future__ import annotations

import json
import os
import socket
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

import campaign
import numpy as np
from kept import Campaign as Kept
from kept import Columns, Figures

from mahovik.core.toolchain.board import version
from mahovik.core.toolchain.compiler import find_compiler
from mahovik.out.campaign.campaign import Campaign
from mahovik.out.campaign.cluster import connect
from mahovik.out.campaign.dataset import status
from mahovik.out.campaign.engine import run_shards
from mahovik.out.campaign.folder import begin
from mahovik.out.campaign.manifest import read_manifest
from mahovik.out.campaign.rows import Rows
from mahovik.out.campaign.shards import shard_path, write_shard

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
for number in range(int(sys.argv[2])):
    make_shard(Path(sys.argv[1]), number)
print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)
"""

PLAN_SAMPLES, PLAN_SAMPLE, PLAN_CORES, PLAN_SHARDS = 10**9, 1e-3, 1000, (10.0, 30.0)
"""Samples, s of a sample, cores, and lengths of shards, s, of the plan."""


class Empty:
    """A campaign whose rows cost nothing."""

    def __init__(self, path: Path, shard_size: int | None, computing: bool) -> None:
        made = Campaign.load(path, shard=1, computing=computing)
        self.name, self.identity, self.samples, self.shard_size = "empty", made.identity, EMPTY, 1
        self.parameters, self.quantities = made.parameters, made.quantities
        self.stand, self.goal, self.stand_of, self.sensitivity = made.stand, None, made.stand_of, made.sensitivity

    def rows(self, first: int, count: int) -> Rows:
        """Zeros."""
        zero = np.zeros(count)
        drawn, found = dict.fromkeys(self.parameters, zero), dict.fromkeys(self.quantities, zero)
        return Rows(np.arange(first, first + count), drawn, found, [""] * count)


def side_by_side(folder: Path) -> list[tuple[Any, ...]]:
    """Rate of one worker and of two, without their start."""
    file = folder / "sat4.toml"
    file.write_text(SAT4.format(samples=32_000))
    rows: list[tuple[int, float]] = []
    for workers in (1, 2):
        out = folder / f"workers-{workers}"
        begin(out, file, Campaign.load(file, shard=1000))
        marks: list[tuple[float, float]] = []

        def note(now: Any, marks: list[tuple[float, float]] = marks) -> None:
            if now.done and (not marks or now.done > marks[-1][1]):
                marks.append((time.monotonic(), now.done))

        run_shards(out, workers=workers, progress=note)
        shown = [mark for mark in marks if mark[1] >= 2000 * workers]
        rows.append((workers, (shown[-1][1] - shown[0][1]) / (shown[-1][0] - shown[0][0])))
    return [(workers, rate, rate / (workers * rows[0][1])) for workers, rate in rows]


def memory(folder: Path) -> list[tuple[Any, ...]]:
    """Largest memory of a process after some shards, MB."""
    file = folder / "sat4.toml"
    rows = []
    for count in (1, 4, 16):
        out = folder / f"memory-{count}"
        begin(out, file, Campaign.load(file, shard=1000))
        done = subprocess.run(
            [sys.executable, "-c", MEMORY, str(out), str(count)], check=True, capture_output=True, text=True
        )
        rows.append((count, count * 1000, int(done.stdout) / 1024.0))
    return rows


def scheduler(folder: Path) -> dict[str, float]:
    """Load of a scheduler and of the client by shards that cost nothing: processor time for each shard, ms."""
    file = folder / "sat4.toml"
    out = folder / "empty"
    begin(out, file, Empty(file, None, True))
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = str(free.getsockname()[1])
    code = "import sys; from distributed.cli.dask_{} import main; main(sys.argv[1:])"
    env = {**os.environ, "DASK_LOGGING__DISTRIBUTED": "critical", "PYTHONPATH": str(Path(__file__).parent)}
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
        before, own, begun = _seconds(started[0].pid), time.process_time(), time.monotonic()
        found = run_shards(out, scheduler=address, load=Empty)
        assert found.status.complete, found.given_up
        return {
            "shards": EMPTY,
            "scheduler_ms": 1e3 * (_seconds(started[0].pid) - before) / EMPTY,
            "client_ms": 1e3 * (time.process_time() - own) / EMPTY,
            "wall_ms": 1e3 * (time.monotonic() - begun) / EMPTY,
        }
    finally:
        for process in started:
            process.kill()
            process.wait()


def _seconds(pid: int) -> float:
    """Processor time that a process has taken, s."""
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def size(folder: Path) -> dict[str, float]:
    """Measure a campaign on sat4: its columns, the bytes of a row, and what a row costs.

    The time to check a row is in µs, the time to compute one in ms; both are times of one processor.
    """
    out = folder / "workers-1"
    manifest = read_manifest(out)
    begun = time.thread_time()
    found = status(out)
    taken = time.thread_time() - begun
    nbytes = sum(shard_path(out, number).stat().st_size for number in range(manifest.shards))
    columns = len(manifest.parameters) + len(manifest.quantities) + 1
    work = Campaign.load(folder / "sat4.toml", shard=manifest.shard_size)
    write_shard(out, manifest, 0, work.rows(*manifest.range(0)))
    before = time.thread_time()
    for number in range(4):
        write_shard(out, manifest, number, work.rows(*manifest.range(number)))
    made = (time.thread_time() - before) / (4 * manifest.shard_size)
    return {"columns": columns, "bytes": nbytes / found.rows, "check_us": 1e6 * taken / found.rows,
            "sample_ms": 1e3 * made}  # fmt: skip


def million(folder: Path) -> dict[str, Any]:
    """A million samples by the command, and their report."""
    file = folder / "million.toml"
    file.write_text(SAT4.format(samples=10**6))
    mahovik = [sys.executable, "-m", "mahovik", "campaign"]
    begun = time.monotonic()
    said = subprocess.run(
        [*mahovik, "run", str(file), "-o", str(folder / "million"), "--json"],
        check=True,
        capture_output=True,
        text=True,
    )
    ran, begun = time.monotonic() - begun, time.monotonic()
    page = folder / "million.html"
    subprocess.run([*mahovik, "report", str(folder / "million"), "-o", str(page)], check=True, capture_output=True)
    reported = time.monotonic() - begun
    found = json.loads(said.stdout)
    assert found["complete"] and found["rows"] == 10**6
    nbytes = sum(path.stat().st_size for path in (folder / "million").glob("rows/*/*"))
    return {
        "workers": campaign.cores(), "seconds": ran, "failed": found["failed"], "shards": found["shards"],
        "megabytes": nbytes / 1e6, "report_seconds": reported, "page_kilobytes": page.stat().st_size / 1e3,
    }  # fmt: skip


WORKERS_TABLE = Columns({"workers": "{}", "samples/s": "{:,.0f}", "of ideal": "{:.0%}"}, 0)
MEMORY_TABLE = Columns({"shards": "{}", "samples": "{:,}", "largest memory, MB": "{:.0f}"}, 0)


def page(found: Figures) -> str:
    """Tables, the million, the plan."""
    load, row = found["scheduler"], found["row"]
    loads = [
        ["scheduler, ms of its processor for each shard", f"{load['scheduler_ms']:.2f}"],
        ["client, ms of its processor for each shard", f"{load['client_ms']:.2f}"],
        [f"a row of {row['columns']} numbers, bytes", f"{row['bytes']:.0f}"],
        ["check of a row, µs", f"{row['check_us']:.2f}"],
        ["a sample of `sat4`, written, ms of a processor", f"{row['sample_ms']:.3f}"],
    ]
    parts = [
        f"{found['compiler']}, {found['processor']}, {found['cores']} cores; average load of the machine before: "
        f"{found['load']:.1f}.",
        "Workers side by side, `sat4`, 0.1 s in 200 steps of order 4. Wanted with 2: at least 85 %.",
        WORKERS_TABLE.text(found["workers"]),
        "Process that computes one shard after the other. Wanted: at most 400.",
        MEMORY_TABLE.text(found["memory"]),
        f"{load['shards']} shards without work, two workers, processes of one machine.",
        campaign.table(["load", "measured"], loads),
    ]
    if found.get("million"):
        parts += [
            "A million samples of `sat4` by `mahovik campaign run`, and their report.",
            _million(found["million"]),
        ]
    return "\n\n".join([*parts, f"Plan for {PLAN_SAMPLES:.0e} samples, on paper.", plan(found), ADVICE])


def _million(big: Figures) -> str:
    rows = [
        ["workers", f"{big['workers']}"],
        ["run, s", f"{big['seconds']:,.0f}"],
        ["shards", f"{big['shards']}"],
        ["samples without quantities", f"{big['failed']}"],
        ["rows, MB", f"{big['megabytes']:.0f}"],
        ["report, s", f"{big['report_seconds']:.0f}"],
        ["its page, KB", f"{big['page_kilobytes']:.0f}"],
    ]
    return campaign.table(["million samples", "measured"], rows)


ADVICE = (
    "The scheduler and the client are the limit: where they are busy for more than half of a core, take longer shards "
    "(`shard` in the campaign file), or arrays without an engine, which have no scheduler at all. A report holds one "
    "column at a time in memory."
)


def plan(found: Figures) -> str:
    """Hours, files and loads of very many samples, by the length of a shard."""
    load, row = found["scheduler"], found["row"]
    seconds = PLAN_SAMPLE
    head = ["cores", "sample, ms", "shard, s", "samples in a shard", "hours of one core", "minutes of all", "files",
            "MB in a file", "GB", "shards that end in a second", "scheduler", "client", "MB/s written",
            "hours to check"]  # fmt: skip
    rows = []
    for length in PLAN_SHARDS:
        size, rate = length / seconds, PLAN_CORES / length
        rows.append([
            f"{PLAN_CORES:,}", f"{1e3 * seconds:g}", f"{length:g}", f"{size:,.0f}",
            f"{PLAN_SAMPLES * seconds / 3600:,.0f}", f"{PLAN_SAMPLES * seconds / PLAN_CORES / 60:,.0f}",
            f"{PLAN_SAMPLES / size:,.0f}",
            f"{size * row['bytes'] / 1e6:.1f}", f"{PLAN_SAMPLES * row['bytes'] / 1e9:,.0f}", f"{rate:.0f}",
            f"{rate * load['scheduler_ms'] / 1e3:.0%}", f"{rate * load['client_ms'] / 1e3:.0%}",
            f"{rate * size * row['bytes'] / 1e6:.1f}", f"{PLAN_SAMPLES * row['check_us'] / 1e6 / 3600:.1f}",
        ])  # fmt: skip
    return campaign.table(head, rows, 0)


CAMPAIGN = Kept(
    "campaigns",
    campaign.Block("docs/results/campaigns.md", "scale"),
    page,
)


def main() -> None:
    """Measures, keeps, renders the page."""
    given = campaign.parser(__doc__, million=False, print=False).parse_args()
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        if given.million:
            found = CAMPAIGN.figures() | {"million": million(folder)}
        else:
            known = CAMPAIGN.figures().get("million") if CAMPAIGN.path.is_file() else None
            found = {
                "compiler": version(find_compiler()[0]), "processor": campaign.processor(), "cores": campaign.cores(),
                "load": os.getloadavg()[0],
                "workers": WORKERS_TABLE.rows(side_by_side(folder)), "memory": MEMORY_TABLE.rows(memory(folder)),
                "scheduler": scheduler(folder), "row": size(folder), "million": known,
            }  # fmt: skip
    if given.print:
        print(page(found))
    else:
        CAMPAIGN.keep(found)


if __name__ == "__main__":
    main()
