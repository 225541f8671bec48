"""Motion and programme files: read or refused; what is read can be evaluated, and a programme written again."""

from __future__ import annotations

import json

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fuzz.mangle import spoiled_bytes, spoiled_json
from fuzz.reading import READERS, fuzzed, read_or_refuse
from mahovik import stands
from mahovik.core.motion.programme import load_programme, programme_text, read_programme
from mahovik.core.motion.required import load_motion, read_motion
from mahovik.core.stand import load
from mahovik.errors import MotionError

pytestmark = READERS

DEMO3 = load(stands.path("demo3"))
T = np.arange(12) / 12
FINITE = np.linspace(0.0, 1.0, 12)
MOTIONS = [
    *(json.loads(path.read_text(encoding="utf-8")) for path in stands.motions("demo3")),
    {
        "schema": 1,
        "type": "periodic",
        "period": "1 s",
        "samples": {"t": T.tolist(), "q": np.outer(np.cos(2 * np.pi * T), np.full(6, 1e-3)).tolist()},
        "bounds": {"speed": "100 rpm", "speed_min": [0, 1, 2], "bias": [1, 1, 1, 1, 1, 1], "angle": "10 deg"},
        "objective": {"acceleration": 1, "torque": [1, 2, 3]},
        "free_mean": [True, True, False, True, True, True],
        "runup": 2,
    },
    {
        "schema": 1,
        "type": "finite",
        "duration": 1.0,
        "samples": {
            "t": FINITE.tolist(),
            "q": np.outer(FINITE**3 * (10 - 15 * FINITE + 6 * FINITE**2), T[:6]).tolist(),
        },
        "bounds": {"start": {"phi": [0, 1, 2], "phi_dot": "10 rpm"}},
    },
]
ROWS = {"phi": [[0, 0, 0]] * 3, "phi_dot": [[1, 2, 3]] * 3, "phi_ddot": [[0, 0, 0]] * 3}
HEAD = {
    "schema": 1,
    "stand": {"name": "demo3", "structure": "0", "physics": "1"},
    "motion": "m",
    "flywheels": ["w1", "w2", "w3"],
    "bias": [0, 0, 0, 0, 0, 0.1],
}
PROGRAMMES = [
    {
        **HEAD,
        "period": 1.0,
        "winding": [1, 0, -2],
        "fourier": {"mean": [0, 1, 2], "cos": [[1, 2, 3]], "sin": [[0, 0, 1e-9]]},
        "runup": {"duration": 2.0, "samples": {"t": [0, 1, 2], **ROWS}},
        "report": {"residual": 1e-9, "peaks": [1, 2.5, None, "x", True]},
    },
    {**HEAD, "period": 1.0, "winding": [1, 0, -2], "samples": {"t": [0, 0.1, 0.7], **ROWS}},
    {**HEAD, "duration": 1.0, "samples": {"t": [0, 0.1, 1.0], **ROWS}},
]


@pytest.mark.parametrize("motion", MOTIONS)
def test_the_examples_are_motions(motion: dict[str, object]) -> None:
    assert read_motion(json.dumps(motion), DEMO3).span == 1.0


def test_half_of_a_pair_is_no_character() -> None:
    """JSON can write it, `"\\ud800"`; UTF-8 cannot."""
    text = json.dumps(MOTIONS[0] | {"type": "\ud800"})
    with pytest.raises(MotionError, match="not JSON: "):
        read_motion(text, DEMO3)


@fuzzed(300)
@given(text=spoiled_json(MOTIONS))
def test_motions(text: str) -> None:
    motion = read_or_refuse(lambda: read_motion(text, DEMO3))
    if motion is not None:
        assert np.all(np.isfinite(motion.at(np.array([0.0, 0.3, 1e3])).q_ddot))


@fuzzed(300)
@given(text=spoiled_json(PROGRAMMES))
def test_programmes(text: str) -> None:
    programme = read_or_refuse(lambda: read_programme(text))
    if programme is not None:
        assert programme_text(read_programme(programme_text(programme))) == programme_text(programme)


@fuzzed(100)
@given(data=spoiled_bytes([json.dumps(each).encode() for each in (*MOTIONS, *PROGRAMMES)]), kind=st.booleans())
def test_bytes(data: bytes, kind: bool, tmp_path_factory: pytest.TempPathFactory) -> None:
    file = tmp_path_factory.getbasetemp() / "file.json"
    file.write_bytes(data)
    read_or_refuse(lambda: load_motion(file, DEMO3) if kind else load_programme(file))
