"""A stand of two flywheels with an IMU, and its data by the full equations, read by the literal reference."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from mahovik.core.stand import load
from mahovik.proof.reference import pieces
from mahovik.proof.reference.points import points
from mahovik.stands import path
from mahovik.use.study.jitter.balance import balance as steady

SPEEDS = (150.0, -171.0)
POINT = '\n[[point]]\nname = "imu"\nposition = [0.1, 0.05, 0.02]\nangles = [0.3, 0.2, 0.1]\n'
AXES = "xyz"
PLANES = {"all": ["-10 mm", "10 mm"]}


def write_stand(file: Path) -> Path:
    """The first two flywheels of bench8 with an IMU."""
    text = "[[flywheel]]".join(path("bench8").read_text(encoding="utf-8").split("[[flywheel]]")[:3])
    file.write_text(text + POINT, encoding="utf-8")
    return file


def write_data(file: Path, stand_file: Path, speeds: tuple[float, float] = SPEEDS) -> Path:
    """Data of one second at constant speeds."""
    stand = load(stand_file)
    motion = steady(stand, speeds)
    t = np.arange(0.0, 1.0, 2e-3)
    theta = np.array([0.3, 1.0]) + np.array(speeds) * t[:, None]
    _, rates = motion.states(theta)
    rows = []
    for i in range(len(t)):
        seen = points(pieces(stand, motion.state(theta[i])), stand, rates[i, 6:])["imu"]
        rows.append([t[i], *seen["specific_force"], *seen["twist"][3:], *theta[i]])
    names = ["time [s]", *(f"imu.acceleration.{x} [m/s2]" for x in AXES), *(f"imu.rate.{x} [rad/s]" for x in AXES)]
    write(file, [*names, "w1.phase [rad]", "w2.phase [rad]"], np.array(rows))
    return file


def write(file: Path, names: list[str], values: np.ndarray) -> None:
    lines = [",".join(names), *(",".join(repr(x) for x in row) for row in values.tolist())]
    file.write_text("\n".join(lines) + "\n", encoding="utf-8")


def read(file: Path) -> tuple[list[str], np.ndarray]:
    head, *lines = file.read_text(encoding="utf-8").splitlines()
    return head.split(","), np.array([[float(x) for x in line.split(",")] for line in lines])
