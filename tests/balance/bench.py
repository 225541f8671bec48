"""A stand of two flywheels with an IMU, and its data by the full equations, read by the literal reference."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from identify.data import SPEEDS, Array, recorded, stand_text, write_csv
from mahovik.out.api.stands import Stand


def write_bench(folder: Path, speeds: tuple[float, float] = SPEEDS) -> None:
    """The first two flywheels of bench8 with an IMU, two.toml, and run.csv: one second at constant speeds."""
    (folder / "two.toml").write_text(stand_text(), encoding="utf-8")
    write_csv(folder / "run.csv", recorded(Stand.of(folder / "two.toml"), speeds), "phase [rad]")


def write(file: Path, names: list[str], values: Array) -> None:
    lines = [",".join(names), *(",".join(repr(x) for x in row) for row in values.tolist())]
    file.write_text("\n".join(lines) + "\n", encoding="utf-8")


def read(file: Path) -> tuple[list[str], Array]:
    head, *lines = file.read_text(encoding="utf-8").splitlines()
    return head.split(","), np.array([[float(x) for x in line.split(",")] for line in lines])
