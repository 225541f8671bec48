"""Files of every kind, spoiled: each is taken or refused in words, and what is taken can be used."""

from __future__ import annotations

import json
import math
import tomllib
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from cli.run import run
from fuzz.mangle import CELLS, spoiled_bytes, spoiled_csv, spoiled_json, spoiled_toml, spoiled_xml
from fuzz.reading import READERS, check_message, fuzzed, read_or_refuse, soon
from mahovik import stands
from mahovik.core.motion.programme import load_programme, programme_text, read_programme
from mahovik.core.motion.read import load as load_regime
from mahovik.core.motion.required import load_motion, read_motion
from mahovik.core.motion.servo import load_servo
from mahovik.core.stand import load
from mahovik.errors import MotionError
from mahovik.out.campaign.file import load_campaign
from mahovik.out.foreign.merge import make_stand
from mahovik.out.foreign.mjcf import read_mjcf
from mahovik.out.foreign.urdf import read_urdf
from mahovik.out.foreign.write import stand_file
from mahovik.use.control.servo import check_margins, gains

pytestmark = READERS

DEMO3, SAT4 = load(stands.path("demo3")), load(stands.path("sat4"))
STANDS = [stands.path(name).read_text(encoding="utf-8") for name in stands.names()]

CAMPAIGNS = [
    """schema = 1
name = "tolerances"
stand = "demo3"
samples = 100
seed = 3
design = "latin"
shard = 10
until = "2 %"
[quantile]
of = "shake"
at = "95 %"
[vary]
"w*.unbalance.static" = { normal = ["1 g mm", "0.3 g mm"], most = "2 g mm" }
"w1.mass" = { table = "w.csv" }
"carrier.inertia.J12" = { triangular = [-1e-4, 0, 1e-4] }
"w2.position" = { tolerance = ["-1 mm", "2 mm"], group = "jig" }
[[correlation]]
of = ["w*.unbalance.static"]
coefficient = 0.3
[over]
regime = { default = { speed = "1000 rpm" } }
until = "5 ms"
[[quantity]]
name = "shake"
what = "rms velocity"
at = "carrier"
band = ["1 Hz", "20 Hz"]
""",
    """schema = 1
stand = "demo3"
samples = 100
design = "saltelli"
[vary]
"w*.unbalance" = { grade = "G 2.5", speed = "3000 rpm", share = { uniform = [0, 1] } }
"carrier.mass" = { lognormal = ["10 kg", 0.1] }
"w3.mass" = { discrete = ["1 kg", "2 kg"], weights = [1, 3] }
"carrier.inertia.J11" = { relative = "2 %" }
[over]
speeds = { w1 = "100 rpm" }
[[quantity]]
name = "peak"
what = "peak acceleration"
at = "carrier"
""",
]
MEASURED = [b"mass [kg],serial\n1.0,a1\n1.1,a2\n"]

SERVOS = [
    """schema = 1
sample_period = "1 ms"
bandwidth = "40 Hz"
""",
    """schema = 1
name = "all"
sample_period = 0.002
latency = "3 ms"
bandwidth = "60 rpm"
damping_ratio = 1.5
integral = "0.1 Hz"
speed_filter = { value = 200, unit = "Hz" }
feedforward = false
friction = false
torque_limit = [1, "2 N mm", 3, 1e8]
torque_rate = "1 N m/ms"
encoder = "stand"
[trim]
harmonics = 4
gain = 1
coordinates = ["phi", "x"]
settling = 0
averaging = 100
limit = "90 deg"
""",
]

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
COURSES = [
    b"t,phi_dot [rpm]\n0,1\n0.5,2\n1,3\n",
    b"t [ms],torque [N mm]\r\n0,1\r\n2000,5\r\n",
    b"t,X [N],M\n0,0,1\n0.1,1e3,2\n5,-1e3,3\n",
]

T, FINITE = np.arange(12) / 12, np.linspace(0.0, 1.0, 12)
MOTIONS: list[dict[str, Any]] = [
    *(json.loads(path.read_text(encoding="utf-8")) for path in stands.motions("demo3")),
    {
        "schema": 1, "type": "periodic", "period": "1 s",
        "samples": {"t": T.tolist(), "q": np.outer(np.cos(2 * np.pi * T), np.full(6, 1e-3)).tolist()},
        "bounds": {"speed": "100 rpm", "speed_min": [0, 1, 2], "bias": [1, 1, 1, 1, 1, 1], "angle": "10 deg"},
        "objective": {"acceleration": 1, "torque": [1, 2, 3]},
        "free_mean": [True, True, False, True, True, True],
        "runup": 2,
    },
    {
        "schema": 1, "type": "finite", "duration": 1.0,
        "samples": {
            "t": FINITE.tolist(), "q": np.outer(FINITE**3 * (10 - 15 * FINITE + 6 * FINITE**2), T[:6]).tolist()
        },
        "bounds": {"start": {"phi": [0, 1, 2], "phi_dot": "10 rpm"}},
    },
]  # fmt: skip
ROWS = {"phi": [[0, 0, 0]] * 3, "phi_dot": [[1, 2, 3]] * 3, "phi_ddot": [[0, 0, 0]] * 3}
HEAD = {
    "schema": 1, "stand": {"name": "demo3", "structure": "0", "physics": "1"}, "motion": "m",
    "flywheels": ["w1", "w2", "w3"], "bias": [0, 0, 0, 0, 0, 0.1],
}  # fmt: skip
PROGRAMMES = [
    HEAD
    | {
        "period": 1.0, "winding": [1, 0, -2],
        "fourier": {"mean": [0, 1, 2], "cos": [[1, 2, 3]], "sin": [[0, 0, 1e-9]]},
        "runup": {"duration": 2.0, "samples": {"t": [0, 1, 2], **ROWS}},
        "report": {"residual": 1e-9, "peaks": [1, 2.5, None, "x", True]},
    },
    HEAD | {"period": 1.0, "winding": [1, 0, -2], "samples": {"t": [0, 0.1, 0.7], **ROWS}},
    HEAD | {"duration": 1.0, "samples": {"t": [0, 0.1, 1.0], **ROWS}},
]  # fmt: skip

MODELS = Path(__file__).parents[1] / "foreign" / "models"
URDF, MJCF = ((MODELS / f"sat.{kind}").read_text(encoding="utf-8") for kind in ("urdf", "xml"))


def read_servo_file(file: Path) -> None:
    """The servo, its gains and its margins."""
    servo = load_servo(file, SAT4)
    for values in gains(SAT4, servo, 0.1).values():
        assert all(map(math.isfinite, values if isinstance(values, list) else [values]))
    check_margins(SAT4, servo, file.name)


def read_motion_file(file: Path) -> None:
    """The motion, at some times."""
    motion = load_motion(file, DEMO3)
    assert np.all(np.isfinite(motion.at(np.array([0.0, 0.3, 1e3])).q_ddot))


def read_programme_file(file: Path) -> None:
    """The programme, which can be written again."""
    text = programme_text(load_programme(file))
    assert programme_text(read_programme(text)) == text


def read_model(file: Path) -> None:
    """The stand of a model, as a stand file."""
    found = make_stand(read_urdf(file) if file.suffix == ".urdf" else read_mjcf(file), "x", file.name)
    stand_file(found, file.name, "x")
    assert all("\n" not in note for note in found.notes)


def read_with(text: str, name: str, read: Callable[[Path], Any], file: Path) -> None:
    """A file that reads the tables beside it."""
    (file.parent / name).write_text(text, encoding="utf-8")
    read(file.parent / name)


def read_course(file: Path) -> None:
    """A table as a motion and as a wrench."""
    (file.parent / "t.csv").write_bytes(file.read_bytes())
    (file.parent / "w.csv").write_bytes(file.read_bytes())
    for text in REGIMES:
        read_with(text, "regime.toml", lambda path: load_regime(path, DEMO3, 1.0), file)


@dataclass(frozen=True)
class Reader:
    """A reader of files: what it reads, the name of the file, examples that it takes, and how they are spoiled."""

    read: Callable[[Path], Any]
    name: str
    examples: Sequence[bytes]
    spoiled: st.SearchStrategy[str] | st.SearchStrategy[bytes]


def encoded(texts: Sequence[str]) -> list[bytes]:
    """Texts as UTF-8."""
    return [text.encode() for text in texts]


def as_json(documents: Sequence[Any]) -> list[bytes]:
    """Documents as JSON."""
    return encoded([json.dumps(each) for each in documents])


regime = partial(load_regime, stand=DEMO3, until=1.0)
regime_documents = [tomllib.loads(text) for text in REGIMES]
FILES = {
    "stand": Reader(load, "stand.toml", encoded(STANDS), spoiled_toml(STANDS)),
    "servo": Reader(read_servo_file, "S.toml", encoded(SERVOS), spoiled_toml(SERVOS)),
    "campaign": Reader(load_campaign, "C.toml", encoded(CAMPAIGNS), spoiled_toml(CAMPAIGNS)),
    "measured parts": Reader(
        partial(read_with, CAMPAIGNS[0], "C.toml", load_campaign), "w.csv", MEASURED, spoiled_csv(MEASURED, CELLS)
    ),
    "regime": Reader(regime, "regime.toml", encoded(REGIMES), spoiled_toml(REGIMES)),
    "regime in JSON": Reader(regime, "regime.json", as_json(regime_documents), spoiled_json(regime_documents)),
    "table of a regime": Reader(read_course, "any.csv", COURSES, spoiled_csv(COURSES, CELLS)),
    "motion": Reader(read_motion_file, "motion.json", as_json(MOTIONS), spoiled_json(MOTIONS)),
    "programme": Reader(read_programme_file, "programme.json", as_json(PROGRAMMES), spoiled_json(PROGRAMMES)),
    "URDF": Reader(read_model, "m.urdf", [URDF.encode()], spoiled_xml(URDF)),
    "MJCF": Reader(read_model, "m.xml", [MJCF.encode()], spoiled_xml(MJCF)),
}


def place(folder: Path) -> None:
    """The tables that the examples name."""
    for name, table in (("t.csv", COURSES[0]), ("w.csv", COURSES[2])):
        (folder / name).write_bytes(table)


@pytest.mark.parametrize("kind", [kind for kind in FILES if kind != "table of a regime"])
def test_the_examples_are_taken(kind: str, tmp_path: Path) -> None:
    reader = FILES[kind]
    place(tmp_path)
    if kind == "campaign":
        (tmp_path / "w.csv").write_bytes(MEASURED[0])
    for example in reader.examples:
        (tmp_path / reader.name).write_bytes(example)
        reader.read(tmp_path / reader.name)


@pytest.mark.parametrize("kind", FILES)
@fuzzed(200)
@given(data=st.data())
def test_values_that_nobody_would_write(
    kind: str, data: st.DataObject, tmp_path_factory: pytest.TempPathFactory
) -> None:
    read_spoiled(FILES[kind], data.draw(FILES[kind].spoiled), tmp_path_factory.getbasetemp())


@pytest.mark.parametrize("kind", FILES)
@fuzzed(60)
@given(data=st.data())
def test_bytes(kind: str, data: st.DataObject, tmp_path_factory: pytest.TempPathFactory) -> None:
    spoiled = data.draw(spoiled_bytes(FILES[kind].examples))
    read_spoiled(FILES[kind], spoiled, tmp_path_factory.getbasetemp())


def read_spoiled(reader: Reader, content: str | bytes, folder: Path) -> None:
    """Write a file beside its tables and read it."""
    place(folder)
    raw = content if isinstance(content, bytes) else content.encode("utf-8", "surrogatepass")
    (folder / reader.name).write_bytes(raw)
    read_or_refuse(lambda: reader.read(folder / reader.name))


def test_half_of_a_pair_is_no_character() -> None:
    """JSON can write it, `"\\ud800"`; UTF-8 cannot."""
    with pytest.raises(MotionError, match="not JSON: "):
        read_motion(json.dumps(MOTIONS[0] | {"type": "\ud800"}), DEMO3)


@fuzzed(15)
@given(text=spoiled_toml(STANDS), command=st.sampled_from(("check", "derive", "rest")))
def test_the_commands_end_with_a_status(text: str, command: str, tmp_path_factory: pytest.TempPathFactory) -> None:
    folder = tmp_path_factory.getbasetemp()
    file = folder / "stand.toml"
    file.write_text(text, encoding="utf-8", errors="surrogatepass")
    more = ["-o", str(folder / "page.html")] if command == "derive" else []
    with soon(120):
        result = run(command, str(file), *more)
    assert result.exit_code in (0, 1, 2)
    if result.exit_code:
        assert result.stderr.startswith("error: ")
        check_message(result.stderr)
