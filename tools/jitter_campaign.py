"""Compare jitter of incommensurable wheels with simulations by the generated C, and time a large sweep.

Writes docs/results/jitter.md and docs/results/jitter-sweep.md.

python tools/jitter_campaign.py [--speeds 6000] [--write]

Exit status 1 where a figure is not what the pages promise.
"""

from __future__ import annotations

import sys
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import campaign
import numpy as np
from kept import Campaign, Columns, Figures
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from mahovik.core.stand import Stand, load
from mahovik.stands import path
from mahovik.use.simulate.by_c import compiled_backend
from mahovik.use.simulate.case import wrap_phases
from mahovik.use.study.jitter import Balance, Makers, View, balance, jitter
from mahovik.use.study.jitter.exact import exact_lines
from mahovik.use.study.jitter.lines import UNBALANCE
from mahovik.use.study.jitter.maker import Harmonics
from mahovik.use.study.jitter.structure import Structure
from mahovik.use.study.linear.model import places
from mahovik.use.study.response.speeds import read_speeds

Array = NDArray[np.float64]

RPM = np.pi / 30
SECONDS = 1000.0
ACCEPTED = 0.01
QUANTITIES = ("angle", "rate", "displacement")

EVERY = 13
"""Steps between rows: their rate is in no whole ratio to the wheels'."""

DRIFT = 5
"""Degree of the drift of a free stand: errors of the steps sum up there."""

SEEN = 1e-6
"""Part of the largest amplitude below which a line is not compared."""

AGREEMENT = Columns(
    {"stand": "{}", "speeds, rad/s": "{}", "quantity": "{}", "lines": "{}", "RMS": "{:.0e}", "orders": "{:.0e}",
     "combinations": "{:.0e}"}, 3,
)  # fmt: skip
SWEEP = Columns({"wheels": "{}", "speeds": "{}", "harmonics": "{}", "modes": "{}", "lines": "{}", "s": "{:.1f}"}, 0)


@dataclass(frozen=True)
class Course:
    """Wheels at speeds (rad/s) on an example stand, a point, and the step of the simulation, s."""

    stand: str
    point: str
    speeds: tuple[float, ...]
    step: float


COURSES = (
    Course("sat4", "acc1", (3000 * RPM, 2987 * RPM, 2500.1 * RPM, -1234.5 * RPM), 1e-3),
    Course("bench8", "carrier", (60.0, -41.2, 20.1, 33.77, 0.0, 0.0, 0.0, 0.0), 2.5e-3),
)


def simulate(stand: Stand, found: Balance, step_length: float) -> tuple[Array, Array]:
    """Times (n) and pose and V (n, 13) of 1,000 s by the C, from the motion found, phases set exactly at every step."""
    backend, speeds = compiled_backend(stand), found.speeds
    ffi, N = backend.library.ffi, len(speeds)
    x = ffi.new(f"{stand.name}_state *")
    view = np.frombuffer(ffi.buffer(x), dtype=np.float64)
    start = found.state(np.zeros(len(found.turning)))
    view[:13] = [*start.position, *(start.quaternion or ()), *start.V]
    view[13 + N : 13 + 2 * N] = speeds
    phi_ddot = np.zeros(N)
    known = {
        "table": backend.library.default("default"), "x": x, "next": x, "dt": step_length, "order": 4,
        "phi_ddot": ffi.cast(f"{stand.name}_real *", phi_ddot.ctypes.data),
    }  # fmt: skip
    arguments = [known[a.name] for a in backend.program.function("step_driven").arguments]
    step, count = backend.library.function("step_driven"), int(SECONDS / step_length)
    times, rows = [], []
    for first in range(0, count, EVERY):
        times.append(first * step_length)
        rows.append(view[:13].copy())
        for phi in wrap_phases(np.outer(np.arange(first, first + EVERY) * step_length, speeds)):
            view[13 : 13 + N] = phi
            if step(*arguments) < 0:
                raise RuntimeError(f"{stand.name}: the C refused a step")
    return np.array(times), np.array(rows)


def agreement_rows(course: Course) -> list[tuple[Any, ...]]:
    """Largest differences of RMS (part of it), of orders of single wheels (part of each amplitude) and of combinations.

    A combination's is part of its amplitude, after 1e-6 of the largest amplitude.
    """
    stand = load(path(course.stand))
    found, place = balance(stand, course.speeds), places(stand, [course.point])[0]
    t, rows = simulate(stand, found, course.step)
    chart = found.scene.chart
    turned = Rotation.from_matrix(chart.C.T) * Rotation.from_quat(rows[:, 3:7], scalar_first=True)
    y = np.hstack([(rows[:, :3] - chart.O1) @ chart.C, turned.as_rotvec(), rows[:, 7:]])
    words = ", ".join(f"{x:.6g}" for x in course.speeds)
    result = []
    for quantity in QUANTITIES:
        seen = View.of(place, quantity)
        lines = exact_lines(found, seen, np.zeros(len(course.speeds)))
        values = seen.values(y, np.zeros((len(y), 6)))
        size = np.abs(lines.amplitude[0]).max(axis=1)
        there = (lines.frequency[0] > 0.0) & (size > SEEN * size[lines.frequency[0] > 0.0].max())
        fitted, moving = fit(t, values, lines.frequency[0, there])
        a = lines.amplitude[0, there]
        off, sizes = np.abs(fitted - a).max(axis=1), np.abs(a).max(axis=1)
        single = np.array([name.source == UNBALANCE for name in lines.names])[there]
        rms, wanted = np.sqrt((moving**2).mean(axis=0)), lines.rms()[0]
        beyond = np.maximum(off - SEEN * sizes.max(), 0.0)
        result.append(
            (course.stand, words, quantity, int(there.sum()), float((np.abs(rms - wanted) / wanted).max()),
             float((off / sizes)[single].max()), float((beyond / sizes)[~single].max()))
        )  # fmt: skip
    return result


def fit(t: Array, values: Array, frequency: Array) -> tuple[NDArray[np.complex128], Array]:
    """Amplitudes (n, 3) of lines at frequencies (n, Hz) by least squares, and the values (m, 3) without their drift."""
    wave = np.exp(2j * np.pi * np.outer(t, frequency))
    drift = np.polynomial.chebyshev.chebvander(2.0 * t / SECONDS - 1.0, DRIFT)
    basis = np.hstack([drift, wave.real, -wave.imag])
    window = np.sin(np.pi * t / SECONDS)[:, None] ** 2  # what drifts otherwise does not leak into lines
    found = np.linalg.lstsq(window * basis, window * values, rcond=None)[0]
    first, n = DRIFT + 1, len(frequency)
    return found[first : first + n] + 1j * found[first + n :], values - drift @ found[:first]


def agreement_figures() -> Figures:
    """All courses."""
    rows = [row for course in COURSES for row in agreement_rows(course)]
    return {"accepted": ACCEPTED, "seconds": SECONDS, "rows": AGREEMENT.rows(rows)}


def agreement_page(found: Figures) -> str:
    """A sentence and the table."""
    return (
        f"Harmonic balance against {found['seconds']:g} s of the generated C, lines fitted by least squares; largest "
        "relative differences of the RMS, of the amplitudes of every order, and of combinations after 1e-6 of the "
        f"largest amplitude; accepted is {found['accepted']:g}.\n\n{AGREEMENT.text(found['rows'])}"
    )


def sweep_row(speeds: int, harmonics: int = 20, modes: int = 50) -> tuple[Any, ...]:
    """A sweep of sat4's four wheels with tables of harmonics and structural modes: wall-clock time."""
    stand, rng = load(path("sat4")), np.random.default_rng(1)
    names = [s.name for s in stand.flywheels]
    tables = {
        name: Harmonics(
            np.sort(rng.uniform(0.5, 10.0, harmonics)),
            rng.uniform(0.0, 1e-7, (harmonics, 4)) * [1.0, 1.0, 1.0, 0.0],
            np.full(harmonics, 0.1),
        )
        for name in names
    }
    shapes = {name: rng.normal(size=(6, modes)) for name in (*names, "acc1")}
    structure = Structure(
        Path("modes.csv"), 2 * np.pi * rng.uniform(20, 400, modes), np.full(modes, 0.005), np.full(modes, 20.0), shapes
    )
    seen = View.of(places(stand, ["acc1"])[0], "angle")
    begin = time.perf_counter()
    found = jitter(
        stand, read_speeds(stand, ["all=0..6000rpm"]), speeds, seen, makers=Makers(tables, structure=structure)
    )
    found.sums()
    seconds = time.perf_counter() - begin
    return len(names), speeds, harmonics, modes, len(found.lines.names), seconds


def sweep_page(found: Figures) -> str:
    """A sentence and the table."""
    return (
        f"Tables of harmonics (radial force, axial force, radial moment) and structural modes, all sums; promised are "
        f"{found['promised']:g} s on two cores.\n\n{SWEEP.text(found['rows'])}"
    )


HEAD = "campaign: tools/jitter_campaign.py --write"
AGREEMENT_CAMPAIGN = Campaign("jitter", campaign.Block("docs/results/jitter.md", HEAD), agreement_page)
SWEEP_CAMPAIGN = Campaign("jitter-sweep", campaign.Block("docs/results/jitter-sweep.md", HEAD), sweep_page)


def main() -> int:
    """Prints the tables, keeps them where asked to."""
    given = campaign.parser(__doc__, speeds=6000, write=False).parse_args()
    agreement = agreement_figures()
    timed: Figures = {"promised": 20.0, "rows": SWEEP.rows([sweep_row(given.speeds)])}
    for each, found in ((AGREEMENT_CAMPAIGN, agreement), (SWEEP_CAMPAIGN, timed)):
        print(each.page(found), flush=True)
        if given.write:
            each.keep(found, None)
    worst = max(row[key] for row in agreement["rows"] for key in ("RMS", "orders", "combinations"))
    return 0 if worst <= ACCEPTED and timed["rows"][0]["s"] <= timed["promised"] else 1


if __name__ == "__main__":
    sys.exit(main())
