"""Times of reading measured data and of balancing by them: docs/results/balancing.md.

python tools/measured_speed.py

Ten seconds at 1 kHz of bench8: a six-axis IMU and the counters of all flywheels, which wrap at 16 bit.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory

import campaign
import numpy as np
from kept import Campaign, Columns, Figures

from mahovik.core.stand import load
from mahovik.core.stand.model import Stand
from mahovik.stands import path
from mahovik.use.balance.by_model import balance_wheels
from mahovik.use.measured import read_recordings
from mahovik.use.measured.orders import order_map

ROUNDS = 5
SECONDS, STEP = 10.0, 1e-3
COUNTS = 4096
POINT = '\n[[point]]\nname = "imu"\nposition = [0.1, 0.05, 0.02]\n'


def columns(stand: Stand) -> dict[str, np.ndarray]:
    """The table of a log: a vibration at the order of each flywheel, with noise."""
    rng = np.random.default_rng(1)
    t = STEP * np.arange(round(SECONDS / STEP))
    names = [each.name for each in stand.flywheels]
    phases = [(100.0 + 17.0 * s) * t for s in range(len(names))]
    found = {"time [s]": t}
    for quantity, unit in (("acceleration", "m/s2"), ("rate", "rad/s")):
        for axis in "xyz":
            x = np.sum([rng.normal() * np.cos(phase + 6.0 * rng.random()) for phase in phases], axis=0)
            found[f"imu.{quantity}.{axis} [{unit}]"] = x + 0.1 * rng.normal(size=len(t))
    turns = (np.floor(phase * COUNTS / (2.0 * np.pi)) % 65536 for phase in phases)
    return found | {f"{name}.count [1/{COUNTS} turn]": x for name, x in zip(names, turns, strict=True)}


def least(call: Callable[[], object]) -> float:
    """Seconds, least of some calls."""
    found = []
    for _ in range(ROUNDS):
        begin = time.perf_counter()
        call()
        found.append(time.perf_counter() - begin)
    return min(found)


def measure(folder: Path) -> list[tuple[str, float]]:
    """Rows of the table."""
    import pyarrow
    import pyarrow.parquet

    (folder / "bench8.toml").write_text(path("bench8").read_text(encoding="utf-8") + POINT, encoding="utf-8")
    stand = load(folder / "bench8.toml")
    table = columns(stand)
    header = ",".join(table)
    np.savetxt(folder / "log.csv", np.column_stack(list(table.values())), delimiter=",", header=header, comments="")
    pyarrow.parquet.write_table(pyarrow.table(table), folder / "log.parquet")
    (recording,) = read_recordings([folder / "log.csv"], stand)
    channel = recording.channels[0]
    return [
        ("read CSV", least(lambda: read_recordings([folder / "log.csv"], stand))),
        ("read Parquet", least(lambda: read_recordings([folder / "log.parquet"], stand))),
        ("map of orders of one flywheel, one channel", least(lambda: order_map(recording, "w1", channel))),
        ("corrections of 8 flywheels, one plane each", least(lambda: balance_wheels(stand, [recording], {}))),
    ]


TABLE = Columns({"what": "{}", "seconds, least of 5": "{:.3f}"})


def page(figures: Figures) -> str:
    """The table."""
    words = "Ten seconds at 1 kHz: six channels of an IMU and eight counters that wrap at 16 bit, 150,000 numbers."
    return f"{words}\n\n{TABLE.text(figures['rows'])}"


CAMPAIGN = Campaign(
    "measured-speed",
    campaign.Block("docs/results/balancing.md", "speed: tools/measured_speed.py"),
    page,
)


def main() -> None:
    """Measures all and writes the page."""
    campaign.parser(__doc__).parse_args()
    with TemporaryDirectory() as folder:
        rows = TABLE.rows(measure(Path(folder)))
    CAMPAIGN.keep({"rows": rows})
    print(TABLE.text(rows))


if __name__ == "__main__":
    main()
