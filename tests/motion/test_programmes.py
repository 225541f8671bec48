"""Programmes: files that read back to the same bits, bad inputs, derivatives, tables against what they sample."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.interpolate import BPoly

from mahovik.core.motion.functions import Fourier, Samples
from mahovik.core.motion.programme import (
    Programme,
    ProgrammedStand,
    RunUpTable,
    load_programme,
    programme_text,
    read_programme,
)
from mahovik.errors import ProgrammeError

NAMES = ("left", "right")
FINITE = st.floats(allow_nan=False, allow_infinity=False)


def numbers(*shape: int) -> st.SearchStrategy[np.ndarray]:
    return arrays(np.float64, shape, elements=FINITE)


@st.composite
def tables(draw: st.DrawFn, span: float, periodic: bool) -> Samples:
    M = draw(st.integers(2, 4))
    t = span * np.arange(M) / (M if periodic else M - 1)
    return Samples(t, *(draw(numbers(M, 2)) for _ in range(3)))


@st.composite
def programmes(draw: st.DrawFn) -> Programme:
    periodic = draw(st.booleans())
    span = draw(st.floats(1e-3, 1e3))
    H = draw(st.integers(0, 3))
    course = (
        Fourier(draw(numbers(2)), draw(numbers(H, 2)), draw(numbers(H, 2)))
        if periodic and draw(st.booleans())
        else draw(tables(span, periodic))
    )
    winding = (draw(st.integers(-9, 9)), draw(st.integers(-9, 9))) if periodic else (0, 0)
    runup, rundown = (RunUpTable(0.5, draw(tables(0.5, False))) if draw(st.booleans()) else None for _ in range(2))
    report = draw(st.dictionaries(st.text(max_size=3), FINITE | st.integers() | st.none() | st.lists(st.booleans())))
    made = Programme(
        ProgrammedStand("shaker2", "1", "2"), draw(st.text()), NAMES, span if periodic else None,
        None if periodic else span, draw(numbers(6)), (), winding, runup=runup, rundown=rundown, report=report,
    )  # fmt: skip
    return made.with_course(course)


def bits(course: Fourier | Samples | None) -> list[bytes]:
    return (
        [] if course is None else [np.asarray(value).tobytes() for key, value in vars(course).items() if key[0] != "_"]
    )


@settings(max_examples=25)
@given(programmes())
def test_a_file_reads_back_to_the_same_bits(programme: Programme) -> None:
    again = read_programme(programme_text(programme))
    for key, value in vars(programme).items():
        other = getattr(again, key)
        if key == "bias":
            assert other.tobytes() == (value + 0.0).tobytes()  # -0.0 is read as 0.0
        elif key in ("fourier", "samples"):
            assert [np.frombuffer(x).tolist() for x in bits(other)] == [np.frombuffer(x).tolist() for x in bits(value)]
        elif key in ("runup", "rundown"):
            assert (other is None) == (value is None)
            if value is not None:
                assert other.duration == value.duration
                assert other.samples.phi.tolist() == value.samples.phi.tolist()
        else:
            assert other == value


def example(**more: Any) -> dict[str, Any]:
    return {
        "schema": 1,
        "stand": {"name": "shaker2", "structure": "1", "physics": "2"},
        "motion": "m",
        "flywheels": list(NAMES),
        "period": 0.05,
        "bias": [0] * 6,
        "winding": [1, -1],
        "fourier": {"mean": [0, 1], "cos": [[0.5, 0]], "sin": [[0, 0.25]]},
        **more,
    }


def problems(document: Any) -> list[str]:
    with pytest.raises(ProgrammeError) as caught:
        read_programme(json.dumps(document), "p.json")
    assert all(line.startswith("p.json: ") and "\n" not in line for line in caught.value.problems)
    return list(caught.value.problems)


TABLE = {"t": [0, 0.02], "phi": [[0, 0], [1, 1]], "phi_dot": [[0, 0]] * 2, "phi_ddot": [[0, 0]] * 2}


@pytest.mark.parametrize(
    ("change", "line"),
    [
        ({"winding": [1]}, "winding: expected 2 whole numbers, one per flywheel, found 1"),
        ({"windings": []}, 'unknown key "windings", did you mean "winding"?'),
        ({"duration": 1}, "expected one of period, duration, found period and duration"),
        ({"period": 0}, "period: 0 s is not above 0"),
        ({"stand": {"name": "x", "structure": "1"}}, "stand, physics: required, but missing"),
        ({"samples": TABLE}, "expected one of fourier, samples, found fourier and samples"),
        ({"fourier": {"mean": [0, 1], "cos": [[0]], "sin": []}}, "fourier, cos[0]: expected 2 numbers, found 1"),
        ({"fourier": {"mean": [0, 1], "cos": [[0, 0]], "sin": []}}, "fourier, sin: 0 harmonics, but cos has 1"),
        (
            {"runup": {"duration": 1, "samples": TABLE}},
            "runup, samples, t: covers 0 to 0.02 s, expected 0 to the duration, 1 s",
        ),
    ],
)
def test_one_line_for_each_bad_input(change: dict[str, Any], line: str) -> None:
    assert problems({**example(), **change}) == [f"p.json: {line}"]


@pytest.mark.parametrize(
    ("change", "line"),
    [
        (
            {"t": [0, 0.05]},
            "samples, t: covers 0 to 0.05 s, expected 0 to less than a period, 0.05 s: t = T is left out",
        ),
        ({"t": [0, 0]}, "samples, t[1]: 0 s is not after 0 s"),
        ({"t": [0, 0.01, 0.02]}, "samples, phi: 2 rows, but t has 3 numbers"),
    ],
)
def test_one_line_for_each_bad_table(change: dict[str, Any], line: str) -> None:
    document = example(samples={**TABLE, **change})
    del document["fourier"]
    assert problems(document) == [f"p.json: {line}"]


def test_what_is_no_file(tmp_path: Path) -> None:
    with pytest.raises(ProgrammeError, match="no such file"):
        load_programme(tmp_path / "none.json")
    (tmp_path / "p.json").write_bytes(b"\xff")
    with pytest.raises(ProgrammeError, match="not UTF-8"):
        load_programme(tmp_path / "p.json")


COEFFICIENTS = arrays(np.float64, (3, 2), elements=st.floats(-1.0, 1.0))
T = 0.1


def course_programme(course: Fourier | Samples, winding: tuple[int, ...] = (2, -1)) -> Programme:
    made = Programme(ProgrammedStand("s", "1", "2"), "m", ("a", "b"), T, None, np.zeros(6), (), winding)
    return made.with_course(course)


def table(series: Programme, M: int) -> Programme:
    t = T * (np.arange(M) + 0.25) / M
    return series.with_course(Samples(t, *series.at(t)))


@given(COEFFICIENTS, COEFFICIENTS)
def test_derivatives_are_those_of_phi(cos: np.ndarray, sin: np.ndarray) -> None:
    made = course_programme(Fourier(np.array([0.3, -2.0]), cos, sin))
    t, h = np.linspace(-0.15, 0.3, 50), 1e-6
    before, at, after = made.at(t - h), made.at(t), made.at(t + h)
    omega = 2 * np.pi * 3 / T
    assert (after.phi - before.phi) / (2 * h) == pytest.approx(at.phi_dot, abs=1e-4 * omega)
    assert (after.phi_dot - before.phi_dot) / (2 * h) == pytest.approx(at.phi_ddot, abs=1e-4 * omega**2)


@settings(deadline=None, max_examples=50)  # the first table imports SciPy's interpolation
@given(COEFFICIENTS, st.integers(-50, 50), st.booleans())
def test_a_period_later_only_the_winding_is_added(cos: np.ndarray, periods: int, tabled: bool) -> None:
    series = course_programme(Fourier(np.zeros(2), cos, cos[::-1]))
    course = table(series, 16) if tabled else series
    t = np.array([0.001, 0.03, 0.09])
    now, later = course.at(t), course.at(t + periods * T)
    assert later.phi == pytest.approx(now.phi + 2 * np.pi * periods * np.array([2, -1]), abs=1e-9)
    assert later.phi_dot == pytest.approx(now.phi_dot, abs=1e-6)
    assert later.phi_ddot == pytest.approx(now.phi_ddot, abs=1e-3)


def test_it_is_the_quintic_hermite_polynomial_of_scipy() -> None:
    rng = np.random.default_rng(3)
    t, rows = np.sort(rng.random(8)), rng.standard_normal((8, 3, 2), dtype=np.float64)
    other = BPoly.from_derivatives(t, rows)
    x = np.concatenate([t, np.linspace(t[0], t[-1], 300)])
    values = Samples(t, rows[:, 0], rows[:, 1], rows[:, 2]).at(x)
    for k, value in enumerate(values):
        expected = other.derivative(k)(x)
        assert value == pytest.approx(expected, abs=1e-12 * np.abs(expected).max())
