"""The control loop that is run on emulated boards: C text for a stand, and what the program prints, read back."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

from mahovik.core.emit.generate import generate_all
from mahovik.core.emit.literal import real_literal
from mahovik.core.emit.templates import template
from mahovik.core.stand.model import Point, Stand

IMU = Point("imu", "carrier", (0.05, 0.0, 0.02), (0.0, 0.0, 0.0))

RATE = 1000
"""Hz; of the loop that is run. What a tick costs does not depend on it."""


@dataclass(frozen=True)
class Sway:
    """A motion for a stand, and where it is about.

    places   phases of the flywheels, rad
    center   of the carrier: position, m, and angles in the stand's sequence, rad
    linear, angular   amplitudes, m and rad
    """

    places: Sequence[float]
    center: Sequence[float]
    linear: Sequence[float]
    angular: Sequence[float]


BENCH8 = Sway(
    places=(-1.96, -0.61, -1.35, 0.12, -1.2, -0.19, -0.35, 0.68),
    center=(0.0, 0.0, 0.0, 0.0, 0.006582, 0.006415),
    linear=(3e-5, 3e-5, 3e-5),
    angular=(6e-5, 6e-5, 0.0),
)
"""For bench8: `mahovik rest` with these phases gives the centre; the least singular value is 0.36 of the largest."""


@dataclass(frozen=True)
class Counts:
    """What a run printed: most instructions by stage and by kind of tick; the hash of the run; errors, SI.

    followed   largest error of the carrier's position while it follows the sway
    strayed    farthest from its rest under the sway that is too large
    observed   largest error of the observed velocity
    """

    stages: dict[str, int]
    ticks: dict[str, int]
    hash: int
    followed: float
    strayed: float
    observed: float


def control_loop(stand: Stand, sway: Sway, real: str, ticks: int) -> dict[str, str]:
    """C texts by file name for `board.build`: the stand with an IMU, and a `main` that runs the loop on it."""
    generated = generate_all(replace(stand, points=(IMU,)), real)
    precision = generated.program.precision

    def numbers(values: Sequence[float]) -> str:
        return ", ".join(real_literal(v, precision) for v in values)

    main = template("loop.c.j2").render(
        name=stand.name,
        NAME=stand.name.upper(),
        rate=RATE,
        imu=IMU.name,
        ticks=ticks,
        per_turn=4096,
        counts_per_rad=4096 / (2 * math.pi),
        places=numbers(sway.places),
        center=numbers(sway.center),
        sway_linear=numbers(sway.linear),
        sway_angular=numbers(sway.angular),
        omega=20 * math.pi,
    )
    return generated.files | {"loop.c": main}


def read_counts(printed: str) -> Counts:
    """What the program printed."""
    numbers = {name: int(value) for name, value in (line.rsplit(": ", 1) for line in printed.splitlines())}
    followed, strayed, observed = (
        numbers.pop(name) * 1e-6
        for name in (
            "off the wanted position, um",
            "off the rest under three times the sway, um",
            "observed velocity off, um/s",
        )
    )
    run = numbers.pop("hash")
    ticks = {name.removeprefix("tick: "): n for name, n in numbers.items() if name.startswith("tick: ")}
    stages = {name: n for name, n in numbers.items() if not name.startswith("tick: ")}
    return Counts(stages, ticks, run, followed, strayed, observed)
