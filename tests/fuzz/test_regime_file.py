"""A regime, in TOML or JSON, and its tables in CSV."""

from __future__ import annotations

import tomllib
from functools import partial
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fuzz.mangle import spoiled_bytes, spoiled_json, spoiled_toml
from fuzz.reading import READERS, fuzzed, read_or_refuse
from mahovik.core.motion.read import load, loads_regime
from mahovik.core.stand import load as load_stand
from mahovik.stands import path

pytestmark = READERS

DEMO3 = load_stand(path("demo3"))
REGIMES = [
    """schema = 1
name = "spin"
[default]
speed = "3000 rpm"
phase = "10 deg"
[flywheel.w1]
torque = "1 N m"
initial_speed = "100 rpm"
[flywheel.w2]
table = "t.csv"
[wrench]
carrier = [1, 2, 3, "4 N m", 5, 6]
""",
    """schema = 1
[flywheel]
w1 = { ramp = { from = 0, to = "6000 rpm", start = "10 ms", duration = "2 s" } }
w2 = { harmonic = { mean = 1, amplitude = "10 rpm", frequency = "2 Hz", phase = 1 }, phase = 3 }
w3 = { run_up = { torque = "5 N mm", to = "500 rpm", band = 1 } }
[wrench]
carrier = "w.csv"
""",
    """schema = 1
[default]
hold = true
[flywheel.w3]
sweep = { from = "1 Hz", to = "20 Hz", duration = 1, scale = "log" }
""",
]
TABLES = [
    b"t,phi_dot [rpm]\n0,1\n0.5,2\n1,3\n",
    b"t [ms],torque [N mm]\r\n0,1\r\n2000,5\r\n",
    b"t,X [N],M\n0,0,1\n0.1,1e3,2\n5,-1e3,3\n",
]
CELLS = (
    "nan",
    "inf",
    "-1",
    "phi_dot [",
    "phi_dot",
    "torque [Nm",
    "M [N mm]",
    "1e309",
    "1e-400",
    "",
    " ",
    "x",
    "9" * 5000,
    "1_0",
    "0x10",
    "t",
    "X",
    "X [",
    "X [N",
    "X [m**9**9]",
    '"',
)


def place(folder: Path, motion: bytes = TABLES[0], wrench: bytes = TABLES[2]) -> Path:
    """The tables that the regimes name."""
    (folder / "t.csv").write_bytes(motion)
    (folder / "w.csv").write_bytes(wrench)
    return folder


@pytest.mark.parametrize("text", REGIMES)
def test_the_examples_are_regimes(text: str, tmp_path: Path) -> None:
    assert loads_regime(text, DEMO3, 1.0, folder=place(tmp_path)).flywheels


@fuzzed(200)
@given(text=spoiled_toml(REGIMES), table=st.sampled_from(TABLES))
def test_toml(text: str, table: bytes, tmp_path_factory: pytest.TempPathFactory) -> None:
    folder = place(tmp_path_factory.getbasetemp(), table)
    read_or_refuse(lambda: loads_regime(text, DEMO3, 1.0, folder=folder))


@fuzzed(200)
@given(text=spoiled_json([tomllib.loads(text) for text in REGIMES]))
def test_json(text: str, tmp_path_factory: pytest.TempPathFactory) -> None:
    folder = place(tmp_path_factory.getbasetemp())
    file = folder / "regime.json"
    file.write_bytes(text.encode("utf-8", "surrogatepass"))
    read_or_refuse(lambda: load(file, DEMO3, 1.0))


@st.composite
def spoiled_csv(draw: st.DrawFn) -> bytes:
    """A table with some cells replaced."""
    rows = [line.split(",") for line in draw(st.sampled_from(TABLES)).decode().splitlines()]
    for _ in range(draw(st.integers(0, 2))):
        row = draw(st.sampled_from(rows))
        row[draw(st.integers(0, len(row) - 1))] = draw(st.sampled_from(CELLS))
    return "\n".join(",".join(row) for row in rows).encode()


@fuzzed(200)
@given(data=st.one_of(spoiled_csv(), spoiled_bytes(TABLES)))
def test_tables(data: bytes, tmp_path_factory: pytest.TempPathFactory) -> None:
    folder = place(tmp_path_factory.getbasetemp(), data, data)
    for text in REGIMES:
        read_or_refuse(partial(loads_regime, text, DEMO3, 1.0, folder=folder))
