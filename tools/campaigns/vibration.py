"""Vibration against judges: lines and steady responses against the generated C, linear models against CasADi."""

from __future__ import annotations

import time
from argparse import Namespace
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from campaigns import Rows, Table, at_most
from mahovik.core.motion.regime import WrenchTable, steady_regime
from mahovik.core.stand import Stand, load
from mahovik.core.stand.random import random_stand, random_state
from mahovik.core.toolchain.compiled import Block, compile_library
from mahovik.stands import path
from mahovik.use.simulate.case import Case, wrap_phases
from mahovik.use.simulate.run import simulate
from mahovik.use.study.linear import linear_model, places
from mahovik.use.study.rest import rest
from mahovik.use.vibration.chain import Makers
from mahovik.use.vibration.maker import Harmonics, Structure
from mahovik.use.vibration.speeds import read_speeds
from mahovik.use.vibration.steady import Steady, quasiperiodic, steady
from mahovik.use.vibration.study import vibration
from mahovik.use.vibration.view import FullMotion, View
from study.energy_linear import linear

Array = NDArray[np.float64]

OPTIONS = {"stands": 40, "first": 1, "speeds": 6000}
"""Random stands of each number of flywheels and their first seed; speeds of the sweep."""

RPM = np.pi / 30
SECONDS, SEEN = 1000.0, 1e-6
"""Length of the runs that jitter is compared with; part of the largest amplitude below which lines are not compared."""

EVERY = 13
"""Steps between rows: their rate is in no whole ratio to the wheels'."""

DRIFT = 5
"""Degree of the drift of a free stand: errors of the steps sum up there."""

ACCEPTED_JITTER, ACCEPTED_RESPONSE, ACCEPTED_LINEAR = 0.01, 1e-6, 1e-10
"""Parts of RMS and of each amplitude; of the amplitude; of the largest number of a row."""

SWEEP = 20.0
"""Promised seconds of the sweep."""


@dataclass(frozen=True)
class Course:
    """Speeds (rpm) on an example stand, and the seconds from rest or the step of a simulation."""

    stand: str
    rpm: tuple[float, ...]
    seconds: float | None
    point: str = ""

    @property
    def words(self) -> str:
        """The speeds."""
        return ", ".join(f"{x:.6g}" for x in self.rpm)


JITTERS = (
    Course("sat4", (3000.0, 2987.0, 2500.1, -1234.5), 1e-3, "acc1"),
    Course("bench8", (*(x / RPM for x in (60.0, -41.2, 20.1, 33.77)), 0.0, 0.0, 0.0, 0.0), 2.5e-3, "carrier"),
)
RESPONSES = (
    Course("bench8", (90.0,) + (0.0,) * 7, 40.0),
    Course("bench8", (600.0,) * 8, 40.0),
    Course("bench8", (200.0, -300.0) + (0.0,) * 5 + (100.0,), 40.0),
    Course("shaker2", (1200.0, -1200.0), 40.0),
    Course("shaker2", (120.0, 60.0), 40.0),
    Course("sat4", (6000.0, 0.0, -3000.0, 0.0), None),
    Course("sat4", (3000.0, 3010.0, 2990.0, 3020.0), None),
    Course("auv6", (600.0,) * 6, None),
)


def run_c(stand: Stand, motion: Steady, step_length: float, seconds: float) -> tuple[Array, Array]:
    """Times (n) and pose and V (n, 13) by the C, from the motion of a balance, phases set exactly at every step."""
    speeds = motion.speeds
    N, block = len(speeds), Block(stand, compile_library(stand, kind="states"), 1)
    view, start = block.x[:, 0], motion.state(np.zeros(len(motion.base)))
    view[:13] = [*start.position, *(start.quaternion or ()), *start.V]
    view[13 + N :] = speeds
    block.given["dt"][0], block.given["order"][0] = step_length, 4
    count = int(seconds / step_length)
    times, rows = [], []
    for first in range(0, count, EVERY):
        times.append(first * step_length)
        rows.append(view[:13].copy())
        for phi in wrap_phases(np.outer(np.arange(first, first + EVERY) * step_length, speeds)):
            view[13 : 13 + N] = phi
            if block.run("step_driven") < 0:
                raise RuntimeError(f"{stand.name}: the C refused a step")
    return np.array(times), np.array(rows)


def fit_lines(t: Array, values: Array, frequency: Array, seconds: float) -> tuple[NDArray[np.complex128], Array]:
    """Amplitudes (n, 3) of lines at frequencies (n, Hz) by least squares, and the values (m, 3) without their drift."""
    wave = np.exp(2j * np.pi * np.outer(t, frequency))
    drift = np.polynomial.chebyshev.chebvander(2.0 * t / seconds - 1.0, DRIFT)
    basis = np.hstack([drift, wave.real, -wave.imag])
    window = np.sin(np.pi * t / seconds)[:, None] ** 2  # what drifts otherwise does not leak into lines
    fitted = np.linalg.lstsq(window * basis, window * values, rcond=None)[0]
    first, n = DRIFT + 1, len(frequency)
    return fitted[first : first + n] + 1j * fitted[first + n :], values - drift @ fitted[:first]


def jitter_rows(course: Course) -> Iterator[tuple[Any, ...]]:
    """Largest differences of RMS (part of it), of orders of single wheels (part of each amplitude) and of combinations.

    A combination's is part of its amplitude, after SEEN of the largest amplitude.
    """
    stand = load(path(course.stand))
    solved, place = quasiperiodic(stand, [x * RPM for x in course.rpm]), places(stand, [course.point])[0]
    t, rows = run_c(stand, solved, course.seconds or 1e-3, SECONDS)
    chart = solved.scene.chart.frame
    attitude = Rotation.from_matrix(chart.C.T) * Rotation.from_quat(rows[:, 3:7], scalar_first=True)
    y = np.hstack([(rows[:, :3] - chart.O1) @ chart.C, attitude.as_rotvec(), rows[:, 7:]])
    for quantity in ("angle", "rate", "displacement"):
        view = View.of(place, quantity)
        torus = solved.torus
        lines = torus.coefficients(view.full(solved.full()))
        hertz = np.abs(solved.frequencies) / (2.0 * np.pi)
        lines = np.where(solved.frequencies[:, None] < 0.0, lines.conj(), lines)
        still = np.zeros((len(y), len(course.rpm)))
        values = view.full(FullMotion(solved.scene, still, still, y, np.zeros((len(y), 6)), np.zeros(6)))
        size = np.abs(lines).max(axis=1)
        large = (hertz > 0.0) & (size > SEEN * size[hertz > 0.0].max())
        fitted, moving = fit_lines(t, values, hertz[large], SECONDS)
        a = lines[large]
        off, sizes = np.abs(fitted - a).max(axis=1), np.abs(a).max(axis=1)
        single = (np.count_nonzero(torus.k, axis=1) == 1)[large]
        wanted = np.sqrt((np.abs(lines[hertz > 0.0]) ** 2).sum(axis=0) / 2.0)
        rms = np.sqrt((moving**2).mean(axis=0))
        beyond = np.maximum(off - SEEN * sizes.max(), 0.0)
        differences = np.abs(rms - wanted) / wanted, (off / sizes)[single], (beyond / sizes)[~single]
        worst = [float(x.max(initial=0.0)) for x in differences]
        yield course.stand, course.words, quantity, int(large.sum()), *worst, max(worst)


def sweep(options: Namespace) -> Iterator[tuple[Any, ...]]:
    """Seconds of a sweep of sat4's four wheels with tables of harmonics and structural modes."""
    stand, rng, harmonics, modes = load(path("sat4")), np.random.default_rng(1), 20, 50
    names = [s.name for s in stand.flywheels]
    tables = {
        name: Harmonics(
            np.sort(rng.uniform(0.5, 10.0, harmonics)),
            rng.uniform(0.0, 1e-7, (harmonics, 4)) * [1.0, 1.0, 1.0, 0.0],
            np.full(harmonics, 0.1),
            ("unknown",) * harmonics,
        )
        for name in names
    }
    shapes = {name: rng.normal(size=(6, modes)) for name in (*names, "acc1")}
    structure = Structure(
        Path("modes.csv"), 2 * np.pi * rng.uniform(20, 400, modes), np.full(modes, 0.005), np.full(modes, 20.0), shapes
    )
    view, makers = View.of(places(stand, ["acc1"])[0], "angle"), Makers(tables, structure=structure)
    begin = time.perf_counter()
    result = vibration(stand, read_speeds(stand, "0..6000rpm"), view, steps=options.speeds, makers=makers)
    result.sums()
    seconds = time.perf_counter() - begin
    yield len(names), options.speeds, harmonics, modes, len(result.lines.names), seconds, SWEEP


def distance_from_course(stand: Stand, course: Steady, until: float | None) -> float:
    """Distance of a run of the C from a steady response, at eight moments of its last period, part of the amplitude."""
    period, chart, y = 2.0 * np.pi / course.base[0], course.scene.chart.frame, course.full().y
    periods = 1 if until is None else int(np.ceil(until / period))
    start = rest(stand).state
    if until is None:
        C = chart.C @ Rotation.from_rotvec(y[0, 3:6]).as_matrix()
        q = tuple(Rotation.from_matrix(C).as_quat(scalar_first=True).tolist())
        position = tuple((chart.O1 + chart.C @ y[0, :3]).tolist())
        start = replace(start, position=position, angles=None, quaternion=q, V=tuple(y[0, 6:].tolist()))
    hold = WrenchTable(np.zeros(1), course.hold[None])
    regime = replace(steady_regime(stand, course.speeds.tolist()), wrenches={stand.carrier.name: hold})
    step = 0.02 / max(map(abs, course.speeds.tolist()))
    run = simulate(Case(stand, regime, start, periods * period, period / 8, step), "c")
    last = np.column_stack([run[name][-9:] for name in ("x [m]", "y [m]", "z [m]", "qx", "qy", "qz", "qw")])
    x = (last[:, :3] - chart.O1) @ chart.C
    r = Rotation.from_matrix(chart.C.T @ Rotation.from_quat(last[:, 3:]).as_matrix()).as_rotvec()
    spectrum = np.fft.rfft(y[:, :6], axis=0) / len(y)
    k = np.arange(len(spectrum))
    waves = np.exp(2j * np.pi * np.outer(np.arange(9) / 8, k))
    expected = np.real(waves @ (spectrum * np.where(k == 0, 1.0, 2.0)[:, None]))
    off, size = np.abs(np.hstack([x, r]) - expected), np.ptp(y[:, :6], axis=0)
    return float(max(off[:, a].max() / size[a].max() for a in (slice(0, 3), slice(3, 6))))


def response_row(course: Course) -> tuple[Any, ...]:
    """A steady response against the generated C, from rest for long, or begun on the course for a period."""
    stand = load(path(course.stand))
    motion = steady(stand, [x * RPM for x in course.rpm])
    how = "one period from the course" if course.seconds is None else f"{course.seconds:g} s from rest"
    off = distance_from_course(stand, motion, course.seconds)
    return course.stand, course.words, motion.torus.M, how, off, ACCEPTED_RESPONSE


def linear_models(options: Namespace) -> Iterator[tuple[Any, ...]]:
    """Random stands, each at a random state: the largest difference of each matrix, part of the largest of its row."""
    for N in (0, 1, 2, 4, 8):
        worst = dict.fromkeys("ABCD", 0.0)
        for seed in range(options.first, options.first + options.stands):
            rng = np.random.default_rng([seed, N])
            stand = random_stand(rng, N)
            state = random_state(stand, rng)
            models = linear_model(stand, state), linear(stand, state)
            for name in worst:
                a, b = (np.asarray(getattr(model, name)) for model in models)
                size = np.abs(b).max(axis=1, keepdims=True, initial=0.0) if b.size else np.ones((1, 1))
                off = float((np.abs(a - b) / np.where(size > 0.0, size, 1.0)).max(initial=0.0))
                worst[name] = max(worst[name], off)
        yield N, options.stands, *worst.values(), max(worst.values())


def largest(rows: Rows, column: str) -> float:
    """The largest figure of a column."""
    return float(max(row[column] for row in rows))


DIFFERENCES = {"RMS": "{:.0e}", "orders": "{:.0e}", "combinations": "{:.0e}", "worst": "{:.0e}"}

TABLES = {
    "jitter": Table(
        lambda options: (row for course in JITTERS for row in jitter_rows(course)),
        {"stand": "`{}`", "speeds, rpm": "{}", "quantity": "{}", "lines": "{}", **DIFFERENCES},
        lambda rows: f"Vibration at incommensurable speeds is that of {SECONDS:g} s of the generated C: largest "
        f"difference {largest(rows, 'worst'):.0e} of RMS and amplitudes",
        lambda row: row["worst"] <= ACCEPTED_JITTER,
        f"Harmonic balance against simulation, lines fitted by least squares: largest relative differences of the RMS, "
        f"of the amplitudes of every order, and of combinations after {SEEN:g} of the largest amplitude.",
        hidden=("worst",),
    ),
    "sweep": Table(
        sweep,
        {
            "wheels": "{}", "speeds": "{}", "harmonics": "{}", "modes": "{}", "lines": "{}", "seconds": "{:.1f}",
            "promised": "{:g}",
        },
        lambda rows: f"A sweep of {rows[0]['wheels']} wheels over {rows[0]['speeds']:,} speeds with "
        f"{rows[0]['harmonics']} harmonics and {rows[0]['modes']} modes takes {rows[0]['seconds']:.1f} s on two cores",
        at_most("seconds", "promised"),
        "Tables of harmonics (radial force, axial force, radial moment) and structural modes, all sums.",
    ),
    "response": Table(
        lambda options: map(response_row, RESPONSES),
        {
            "stand": "`{}`", "speeds, rpm": "{}", "nodes": "{}", "simulated": "{}", "apart": "{:.0e}",
            "accepted": "{:.0e}",
        },
        lambda rows: f"Steady responses are those of the generated C: largest distance {largest(rows, 'apart'):.0e} of "
        "the amplitude",
        at_most("apart", "accepted"),
        "Largest distance in place and attitude over the last period, part of the amplitude.",
    ),
    "linear": Table(
        linear_models,
        {"flywheels": "{}", "stands": "{}", **dict.fromkeys("ABCD", "{:.0e}"), "worst": "{:.0e}"},
        lambda rows: f"Linear models of {sum(row['stands'] for row in rows)} random stands are the second derivation's "
        f"by automatic differentiation: largest difference {largest(rows, 'worst'):.0e}",
        lambda row: row["worst"] <= ACCEPTED_LINEAR,
        "Random stands, each at a random state: differences as parts of the largest number of a row.",
        hidden=("worst",),
    ),
}  # fmt: skip
