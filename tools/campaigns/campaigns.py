"""Campaigns of sat4 measured: workers side by side, memory of one, a million samples."""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
import time
from argparse import Namespace
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from campaigns import Rows, Table, cores
from mahovik.out.campaign.file import load_campaign
from mahovik.out.campaign.workers import compute

OPTIONS = {"samples": 10**6}

SAT4 = """
schema = 1
name = "sat4-tolerances"
stand = "sat4"
samples = {samples}
chunk = 2000
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

MEMORY = """
import resource, sys
from pathlib import Path
from mahovik.out.campaign.chunks import write_chunk
from mahovik.out.campaign.file import load_campaign
campaign = load_campaign(sys.argv[1])
for number in range(16):
    write_chunk(campaign, Path(sys.argv[2]), number)
print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)
"""


def rate(folder: Path, file: Path, workers: int) -> float:
    """Samples a second of some workers, without their start."""
    campaign = load_campaign(file)
    campaign.rows(0, 0)
    marks = [time.monotonic() for _ in compute(campaign, folder / f"{workers}", range(campaign.chunks), workers, None)]
    steady = marks[2 * workers :]
    return campaign.chunk * (len(steady) - 1) / (steady[-1] - steady[0])


def memory(folder: Path, file: Path) -> float:
    """Largest memory of a process after sixteen chunks, MB."""
    command = [sys.executable, "-c", MEMORY, str(file), str(folder / "memory")]
    return int(subprocess.run(command, check=True, capture_output=True, text=True).stdout) / 1024.0


def measure(options: Namespace) -> Iterator[tuple[str, float, float | None, float | None]]:
    """A row for each figure with the least and the most that is promised."""
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        file, many = folder / "sat4.toml", folder / "many.toml"
        file.write_text(SAT4.format(samples=64_000))
        one, two = rate(folder, file, 1), rate(folder, file, 2)
        yield "samples a second, one worker", one, None, None
        yield "samples a second, two workers", two, None, None
        yield "two workers, % of twice one", 100.0 * two / (2.0 * one), 85.0, None
        yield "memory of a process after sixteen chunks, MB", memory(folder, file), None, 400.0
        many.write_text(SAT4.format(samples=options.samples).replace("chunk = 2000\n", ""))
        out, begun = folder / "many", time.monotonic()
        command = [sys.executable, "-m", "mahovik", "campaign", str(many), "-o", str(out), "--json"]
        found = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
        yield f"samples of `campaign` on {cores()} cores", found["samples"], options.samples, options.samples
        yield "seconds of the run", time.monotonic() - begun, None, None
        yield "samples without quantities", found["without_quantities"], None, 0
        yield "rows, MB", sum(path.stat().st_size for path in out.glob("rows/*")) / 1e6, None, None
        begun = time.monotonic()
        subprocess.run([*command, "--report", str(folder / "many.html")], check=True, capture_output=True)
        yield "seconds of the report", time.monotonic() - begun, None, None


def is_promised(row: Any) -> bool:
    """Whether a figure is between its limits."""
    least, most = row["at least"], row["at most"]
    return (least is None or row["figure"] >= least) and (most is None or row["figure"] <= most)


WORDS = ("samples", "memory")
"""How the names of figures begin that say of what they are."""


def claim(rows: Rows) -> str:
    """The large run."""
    figures = {row["what"]: row["figure"] for row in rows}
    samples, megabytes = (next(figures[what] for what in figures if what.startswith(f"{word} of")) for word in WORDS)
    return (
        f"{samples:,} samples of `sat4`, 0.1 s in 200 steps of order 4, take {figures['seconds of the run']:.0f} s on "
        f"two cores; two workers have {figures['two workers, % of twice one']:.0f} % of twice the speed of one, and a "
        f"process takes {megabytes:.0f} MB"
    )


TABLES = {
    "scale": Table(
        measure,
        {"what": "{}", "figure": "{:,.5g}", "at least": "{:,.5g}", "at most": "{:,.5g}"},
        claim,
        is_promised,
        "A [campaign](campaigns.md) over tolerances of `sat4`.",
    )
}
