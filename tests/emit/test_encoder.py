"""Phases, places and speeds of encoder counts against exact integers: mahovik_encoder.c of `--with encoder`."""

from __future__ import annotations

import ctypes as ct
import math
import tempfile
from collections.abc import Iterator
from fractions import Fraction
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from flint import arb, ctx

from mahovik.contract.status import STATUS_VALUES
from mahovik.core.emit.delivery import delivery
from mahovik.core.stand import load
from mahovik.core.toolchain.compiler import BITS, WARNINGS, run_compiler
from mahovik.stands import path
from mahovik.writing import write_all

PRECISIONS = pytest.mark.parametrize("precision_name", ["double", "float"])
ERROR = {"double": 5e-16, "float": 3e-7}
MAX_COUNTS = {"double": 1 << 30, "float": 1 << 23}
SCALAR: dict[str, Any] = {"double": np.float64, "float": np.float32}
INT_MIN, INT_MAX = -(2**31), 2**31 - 1
FILL = 5.5


@pytest.fixture(autouse=True)
def digits() -> Iterator[None]:
    """Arb with 200 bits."""
    before, ctx.prec = ctx.prec, 200
    yield
    ctx.prec = before


def text(stand: str, real: str) -> dict[str, str]:
    """Files of the encoder beside the C of a stand."""
    files = delivery(load(path(stand)), real, ("wrap",), ("encoder",))
    return {name: text for name, text in files.items() if name.startswith("mahovik_")}


@cache
def library() -> ct.CDLL:
    """Compiled with every warning an error; what is undefined is a trap."""
    with tempfile.TemporaryDirectory() as folder:
        write_all(Path(folder), text("demo3", "double"))
        made = f"{folder}/encoder.so"
        trapping = ("-fsanitize=undefined", "-fsanitize-undefined-trap-on-error")
        run_compiler([*WARNINGS, *BITS, *trapping, "-shared", "-fPIC", f"{folder}/mahovik_encoder.c", "-o", made], "it")
        return ct.CDLL(made)


class Encoder(ct.Structure):
    _fields_ = (("counter", ct.c_int), ("place", ct.c_int), ("moved", ct.c_int))


def called(precision_name: str, function: str, **inputs: Any) -> tuple[int, Any]:
    """Status and the one output."""
    if function == "accumulate":
        encoder = Encoder(**inputs["encoder"])
        values = (inputs[name] for name in ("counter", "bits", "per_turn"))
        status = int(library().mahovik_accumulate(ct.byref(encoder), *values))
        return status, {name: getattr(encoder, name) for name, _ in Encoder._fields_}
    real, end = {"double": (ct.c_double, ""), "float": (ct.c_float, "_float")}[precision_name]
    first, last = ("count", "zero") if function == "phase_of_counts" else ("moved", "dt")
    out = real(FILL)
    called = getattr(library(), f"mahovik_{function}{end}")
    return int(called(inputs[first], inputs["per_turn"], real(inputs[last]), ct.byref(out))), out.value


def good(precision_name: str, function: str, **inputs: Any) -> Any:
    """The output of a call that must be good."""
    status, value = called(precision_name, function, **inputs)
    assert status == 0, (function, inputs, status)
    return value


def refused(precision_name: str, function: str, due: str, **inputs: Any) -> None:
    status, value = called(precision_name, function, **inputs)
    assert status == STATUS_VALUES[due], (function, inputs, status)
    assert value == inputs.get("encoder", FILL)


def test_the_text_is_the_same_for_every_stand() -> None:
    assert len(text("demo3", "double")) == 2
    assert text("demo3", "double") == text("eye4", "float")


def test_null_is_refused() -> None:
    made = library()
    assert made.mahovik_accumulate(None, 1, 16, 100) == STATUS_VALUES["BAD_ARGUMENT"]
    for end, real in (("", ct.c_double), ("_float", ct.c_float)):
        for name in ("phase", "speed"):
            status = getattr(made, f"mahovik_{name}_of_counts{end}")(1, 100, real(1.0), None)
            assert status == STATUS_VALUES["BAD_ARGUMENT"]


def exact_phase(count: int, per_turn: int, zero: float) -> Fraction:
    """Turns from phi = 0, in [-1/2, 1/2]."""
    turns = (Fraction(count) - Fraction(zero)) / per_turn
    return turns - round(turns)


def check_phase(precision_name: str, count: int, per_turn: int, zero: float = 0.0) -> float:
    phi = float(good(precision_name, "phase_of_counts", count=count, per_turn=per_turn, zero=zero))
    assert abs(phi) <= SCALAR[precision_name](math.pi)
    turns = exact_phase(count, per_turn, zero)
    difference = arb(phi) / (2 * arb.pi()) - arb(turns.numerator) / turns.denominator
    if abs(turns) == Fraction(1, 2):
        difference = min(abs(difference - k) for k in (-1, 0, 1))
    unit = float(np.spacing(SCALAR[precision_name](abs(phi) or 1e-30)))
    assert abs(difference) * 2 * arb.pi() <= 2 * unit, (count, per_turn, zero, phi)
    return phi


@PRECISIONS
def test_the_phase_of_any_count_is_good_to_two_units_in_the_last_place(precision_name: str) -> None:
    most = MAX_COUNTS[precision_name]
    rng = np.random.default_rng(2)
    turns = [1, -1, 2, 3, 7, -4096, 4096, 10_000, 65536, most, -most, most - 1]
    for per_turn in (*turns, *(int(n) for n in rng.integers(1, most, 50))):
        size = abs(per_turn)
        counts = [0, 1, -1, size // 2, -(size // 2), size // 2 + 1, size, INT_MAX, INT_MIN, INT_MIN + 1]
        for count in (*counts, *(int(n) for n in rng.integers(INT_MIN, INT_MAX, 20))):
            zero = float(rng.integers(-size, size + 1))
            check_phase(precision_name, count, per_turn)
            check_phase(precision_name, count, per_turn, zero)


NOWHERE = (math.nan, math.inf, -math.inf)
AT_REST = {"counter": 5, "place": 5, "moved": 0}
REFUSED: list[tuple[str, str, str, tuple[Any, ...], dict[str, Any]]] = [
    ("phase_of_counts", "NOT_FINITE", "zero", NOWHERE, {"count": 1, "per_turn": 100}),
    ("phase_of_counts", "RANGE", "zero", (100.01, -101.0), {"count": 1, "per_turn": 100}),
    ("phase_of_counts", "BAD_ARGUMENT", "per_turn", (0, INT_MIN, INT_MAX), {"count": 3, "zero": 0.0}),
    ("speed_of_counts", "BAD_ARGUMENT", "per_turn", (0, INT_MIN, INT_MAX), {"moved": 3, "dt": 0.001}),
    ("speed_of_counts", "BAD_ARGUMENT", "dt", (0.0, -1e-3), {"moved": 5, "per_turn": 100}),
    ("speed_of_counts", "RANGE", "dt", (10.5, 1e-38), {"moved": 5, "per_turn": 100}),
    ("speed_of_counts", "NOT_FINITE", "dt", NOWHERE, {"moved": 5, "per_turn": 100}),
    ("accumulate", "BAD_ARGUMENT", "bits", (-1, 1, 33, INT_MIN), {"encoder": AT_REST, "counter": 6, "per_turn": 100}),
    ("accumulate", "BAD_ARGUMENT", "counter", (100, -1), {"encoder": AT_REST, "bits": 0, "per_turn": 100}),
    ("accumulate", "BAD_ARGUMENT", "per_turn", (0, INT_MAX), {"encoder": AT_REST, "counter": 6, "bits": 16}),
    (
        "accumulate",
        "BAD_ARGUMENT",
        "encoder",
        tuple(AT_REST | {"place": place} for place in (-1, 100, INT_MAX)),
        {"counter": 6, "bits": 16, "per_turn": 100},
    ),
]


@PRECISIONS
@pytest.mark.parametrize(("function", "due", "argument", "values", "more"), REFUSED)
def test_refusals(
    precision_name: str, function: str, due: str, argument: str, values: tuple[Any, ...], more: dict[str, Any]
) -> None:
    for value in values:
        refused(precision_name, function, due, **more, **{argument: value})


@PRECISIONS
def test_most_counts_a_turn(precision_name: str) -> None:
    most = MAX_COUNTS[precision_name]
    for per_turn in (most + 1, -most - 1):
        refused(precision_name, "phase_of_counts", "BAD_ARGUMENT", count=3, zero=0.0, per_turn=per_turn)
    check_phase(precision_name, 3, most)


@PRECISIONS
def test_speed_is_counts_over_time(precision_name: str) -> None:
    for moved, per_turn, dt in ((100, 4096, 1e-3), (-100, 4096, 1e-3), (7, -1000, 0.01), (0, 5, 1.0)):
        speed = good(precision_name, "speed_of_counts", moved=moved, per_turn=per_turn, dt=dt)
        assert speed == pytest.approx(2 * math.pi * moved / per_turn / dt, rel=4 * ERROR[precision_name], abs=0)


def reading(position: int, bits: int, per_turn: int, signed: bool) -> int:
    """Reading of a counter with this many bits; 0 bits: it counts over one turn."""
    if bits == 0:
        return position % abs(per_turn)
    value = position % (1 << bits)
    return value - (1 << bits) if signed and value >= 1 << (bits - 1) else value


@PRECISIONS
@pytest.mark.parametrize(
    ("bits", "per_turn", "signed"),
    [(16, 10_000, False), (16, -2500, True), (32, -999, True), (0, -999, False), (2, 3, False), (31, 4001, False)],
)
def test_a_counter_that_wraps_is_followed_there_and_back(
    precision_name: str, bits: int, per_turn: int, signed: bool
) -> None:
    """More than 10^9 counts with reversals; the place and phase are those of the true position, exactly."""
    rng = np.random.default_rng(bits)
    size = abs(per_turn)
    reach = (size if bits == 0 else 2**bits) // 2 - 1
    most = min(reach, 5_000_000)
    position = int(rng.integers(0, size))
    encoder = {"counter": reading(position, bits, per_turn, signed), "place": position % size, "moved": 0}
    travelled = 0
    for step in range(600):
        moved = int(rng.integers(-most, most + 1)) if step % 3 else most * (-1 if step % 200 > 150 else 1)
        position += moved
        travelled += abs(moved)
        counter = reading(position, bits, per_turn, signed)
        encoder = good(precision_name, "accumulate", encoder=encoder, counter=counter, bits=bits, per_turn=per_turn)
        assert encoder == {"counter": counter, "place": position % size, "moved": moved}
        if step % 50 == 0:
            check_phase(precision_name, encoder["place"], per_turn)
    assert travelled > (10**9 if most == 5_000_000 else 0)
