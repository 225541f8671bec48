"""Slew files: what they say, what is refused, and the course that a programme keeps for them."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import pytest

from mahovik import stands
from mahovik.core.motion.course import PlannedCourse
from mahovik.core.motion.programme import Programme, Samples, programme_text, read_programme
from mahovik.core.motion.required import Slew, read_motion, read_motion_or_slew
from mahovik.core.stand import Stand, load
from mahovik.errors import MotionError, ProgrammeError

ATTITUDE = ["wx", "wy", "wz"]


def stand() -> Stand:
    return load(stands.path("sat4"))


def read(**keys: Any) -> Slew:
    found = read_motion_or_slew(json.dumps({"schema": 1, "type": "slew"} | keys), stand(), "m.json")
    assert isinstance(found, Slew)
    return found


def test_the_shortest_turn_from_start_to_end() -> None:
    found = read(task="pointing", start={"angles": ["10 deg", 0, 0]}, end={"angles": ["50 deg", 0, 0]})
    assert found.kind == "attitude" and found.goal == "fastest" and found.duration is None
    assert found.angle == pytest.approx(np.radians(40)) and found.axis == pytest.approx([0, 0, 1], abs=1e-12)
    back = read(task="pointing", end={"quaternion": [np.cos(2.8), 0, np.sin(2.8), 0]}, duration="5 s")
    assert back.angle == pytest.approx(2 * np.pi - 5.6) and back.axis == pytest.approx([0, -1, 0], abs=1e-12)
    assert back.goal == "quietest" and back.duration == 5.0


def test_a_line_of_sight_is_the_axis_that_no_row_names() -> None:
    found = read(rows=[{"point": "acc1", "rows": ["wx", "wz"]}], end={"direction": [1, 1, 0]})
    own = np.array([-0.5, np.sqrt(0.75), 0.0])  # second axis of acc1, turned by 30 degrees about z
    assert found.kind == "sight" and found.axis == pytest.approx(own)
    assert np.cos(found.angle) == pytest.approx(float(own @ [1, 1, 0]) / np.sqrt(2))
    assert found.path(np.array([found.angle]))[0] @ own == pytest.approx(np.array([1, 1, 0]) / np.sqrt(2))


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ({}, "expected one of task, rows, found none"),
        ({"task": "pointing", "end": {"direction": [1, 0, 0]}}, "end: expected angles or quaternion, found direction"),
        ({"task": "pointing", "end": {"angles": [0, 0, 0]}}, "end: is the attitude of the start"),
        ({"rows": ["wx"]}, "rows: one angular row alone has no end"),
        ({"rows": ["wx", {"point": "acc1", "rows": ["wy"]}]}, "rows: two angular rows of different frames"),
        ({"rows": ["wy", "wz"], "end": {"direction": [-1, 0, 0]}}, "end: direction: is opposite"),
        ({"rows": ["wy", "wz"], "end": {"direction": [2, 0, 0]}}, "end: direction: is that of the start"),
        ({"rows": ["vx"]}, "duration: required: no row turns"),
        (
            {"rows": ["vx"], "duration": 1, "end": {"angles": [1, 0, 0]}},
            "end: angles: not allowed without angular rows",
        ),
        ({"task": "pointing", "end": {"angles": [1, 0, 0]}, "goal": "quietest"}, "duration: required with the goal"),
        ({"task": "pointing", "goal": "fastest", "duration": 3}, "duration: not allowed with the goal fastest"),
        ({"task": "pointing", "end": {"quaternion": [1, 1, 0, 0]}}, "end, quaternion: length 1.41421"),
    ],
)
def test_one_line_for_each_bad_input(keys: dict[str, Any], words: str) -> None:
    with pytest.raises(MotionError) as error:
        read(**keys)
    assert any(line.startswith("m.json: ") and words in line for line in error.value.problems), error.value.problems


def test_a_slew_has_a_course_only_with_its_programme() -> None:
    text = json.dumps(
        {"schema": 1, "type": "slew", "name": "s", "rows": ATTITUDE, "end": {"angles": [0.5, 0, 0]}, "duration": 2}
    )
    with pytest.raises(MotionError, match="give its programme as well"):
        read_motion(text, stand(), "m.json")
    t = np.array([0.0, 0.7, 2.0])
    rng = np.random.default_rng(0)
    rows = [rng.normal(size=(3, 4)) for _ in range(3)]
    carrier = PlannedCourse(t, *(0.1 * rng.normal(size=(3, 6)) for _ in range(3)))
    names = tuple(s.name for s in load(stands.path("sat4")).flywheels)
    programme = Programme(
        "sat4", "a", "b", "s", names, False, 2.0, np.zeros(6), (0,) * 4, Samples(t, *rows), carrier=carrier
    )
    again = read_programme(programme_text(programme))
    assert again.carrier is not None and programme_text(again) == programme_text(programme)
    motion = read_motion(text, stand(), "m.json", again)
    assert motion.span == 2.0 and motion.slew is not None and motion.bounds.start_phi_dot == (0.0,) * 4
    for found, given in zip(motion.at(t), (carrier.q, carrier.q_dot, carrier.q_ddot), strict=True):
        assert found == pytest.approx(given, abs=1e-12)
    broken = json.loads(programme_text(programme))
    broken["carrier"]["q"] = broken["carrier"]["q"][:2]
    with pytest.raises(ProgrammeError, match="carrier, q: 2 rows, but t has 3 numbers"):
        read_programme(json.dumps(broken))
