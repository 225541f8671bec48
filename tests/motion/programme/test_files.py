"""Programme files: what is written reads back to the same bits; every bad input one line."""

from __future__ import annotations

import json
import os
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from mahovik.core.motion.programme import (
    Fourier,
    Programme,
    RunUpTable,
    Samples,
    load_programme,
    programme_text,
    read_programme,
    save_programme,
)
from mahovik.errors import ProgrammeError, UsageError

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
    return Programme(
        "shaker2", "1", "2", draw(st.text()), NAMES, periodic, span, draw(numbers(6)), winding, course, runup, rundown,
        report,
    )  # fmt: skip


def bits(course: Fourier | Samples | None) -> list[bytes]:
    return [] if course is None else [np.asarray(each).tobytes() for key, each in vars(course).items() if key[0] != "_"]


@settings(max_examples=25)
@given(programmes())
def test_a_file_reads_back_to_the_same_bits(programme: Programme) -> None:
    found = read_programme(programme_text(programme))
    for key, value in vars(programme).items():
        other = getattr(found, key)
        if key == "bias":
            assert other.tobytes() == (value + 0.0).tobytes()  # -0.0 is read as 0.0
        elif key == "course":
            assert [np.frombuffer(x).tolist() for x in bits(other)] == [np.frombuffer(x).tolist() for x in bits(value)]
        elif key in ("runup", "rundown"):
            assert (other is None) == (value is None)
            if value is not None:
                assert other.duration == value.duration
                assert other.samples.phi.tolist() == value.samples.phi.tolist()
        else:
            assert other == value


@settings(max_examples=25)
@given(programmes())
def test_the_same_programme_is_the_same_text(programme: Programme) -> None:
    text = programme_text(programme)
    assert programme_text(read_programme(text)) == text
    json.loads(text, parse_constant=lambda name: pytest.fail(f"{name} is no JSON"))


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
        ({"schema": 3}, "schema: expected 1, found 3"),
        ({"winding": [1]}, "winding: expected 2 whole numbers, one per flywheel, found 1"),
        ({"windings": []}, 'unknown key "windings", did you mean "winding"?'),
        ({"duration": 1}, "expected one of period, duration, found period and duration"),
        ({"period": 0}, "period: 0 s is not above 0"),
        ({"bias": [0]}, "bias: expected 6 numbers, found 1"),
        ({"stand": {"name": "x", "structure": "1"}}, "stand, physics: required, but missing"),
        ({"flywheels": [1, 2]}, "flywheels: expected names"),
        ({"samples": TABLE}, "expected one of fourier, samples, found fourier and samples"),
        ({"fourier": {"mean": [0, 1], "cos": [[0]], "sin": []}}, "fourier, cos[0]: expected 2 numbers, found 1"),
        ({"fourier": {"mean": [0, 1], "cos": [[0, 0]], "sin": []}}, "fourier, sin: 0 harmonics, but cos has 1"),
        ({"fourier": {"mean": [0, 1], "cos": []}}, "fourier, sin: required, but missing"),
        (
            {"runup": {"duration": 1, "samples": TABLE}},
            "runup, samples, t: covers 0 to 0.02 s, expected 0 to the duration, 1 s",
        ),
        ({"runup": {"samples": TABLE}}, "runup, duration: required, but missing"),
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
        ({"phi_dot": 3}, "samples, phi_dot: expected a list, found 3"),
    ],
)
def test_one_line_for_each_bad_table(change: dict[str, Any], line: str) -> None:
    document = example(samples={**TABLE, **change})
    del document["fourier"]
    assert problems(document) == [f"p.json: {line}"]


def test_fourier_of_a_finite_programme_is_refused() -> None:
    document = example(duration=1)
    del document["period"]
    found = problems(document)
    assert "p.json: winding: not allowed with `duration`: winding is turns per period" in found
    assert "p.json: fourier: not allowed with `duration`: a finite programme has `samples`" in found


def test_files_are_written_whole_or_not_at_all(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    programme = read_programme(json.dumps(example()))
    target = tmp_path / "p.json"
    save_programme(programme, target)
    assert programme_text(load_programme(target)) == programme_text(programme)
    before = target.read_bytes()

    def fail(*_: Any) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "replace", fail)
    with pytest.raises(UsageError, match="cannot be written: No space left"):
        save_programme(replace(programme, stand="another"), target)
    assert target.read_bytes() == before
    assert list(tmp_path.iterdir()) == [target]


def test_what_is_no_file(tmp_path: Path) -> None:
    with pytest.raises(ProgrammeError, match="no such file"):
        load_programme(tmp_path / "none.json")
    (tmp_path / "p.json").write_bytes(b"\xff")
    with pytest.raises(ProgrammeError, match="not UTF-8"):
        load_programme(tmp_path / "p.json")
