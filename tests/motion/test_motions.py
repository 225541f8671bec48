"""Required motions and slews: what a file says in which units, every bad input one line, courses."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from mahovik import stands
from mahovik.core.motion.functions import Harmonics, PlannedCourse, Samples
from mahovik.core.motion.motion_file import load_motion, read_motion, read_motion_or_slew
from mahovik.core.motion.programme import Programme, programme_text, read_programme
from mahovik.core.motion.required import Deviation, Slew
from mahovik.core.stand import Stand
from mahovik.core.stand import load as load_stand
from mahovik.errors import MotionError, ProgrammeError

SHAKER = load_stand(stands.path("shaker2"))
SIX = [0.0] * 6
PLAIN = {"schema": 1, "type": "periodic", "period": 0.05, "harmonics": [{"k": 1, "cos": [0, 0, 1e-4, 0, 0, 0]}]}
FINITE = {"schema": 1, "type": "finite", "duration": 2.0}


def rest_to_rest(x: np.ndarray) -> np.ndarray:
    """Zero to one with q' = q'' = 0 at both ends."""
    return np.asarray(x**3 * (10 - 15 * x + 6 * x**2))


def rows(z: np.ndarray) -> list[list[float]]:
    """Samples of which only z moves."""
    return [[0.0, 0.0, value, 0.0, 0.0, 0.0] for value in z.tolist()]


def finite(M: int = 21, **more: Any) -> dict[str, Any]:
    t = np.linspace(0.0, 2.0, M)
    return {**FINITE, "samples": {"t": t.tolist(), "q": rows(1e-3 * rest_to_rest(t / 2.0))}, **more}


def sampled(z: np.ndarray, **more: Any) -> dict[str, Any]:
    """Evenly over the period of PLAIN."""
    t = 0.05 * np.arange(len(z)) / len(z)
    return {"schema": 1, "type": "periodic", "period": 0.05, "samples": {"t": t.tolist(), "q": rows(z)}, **more}


def problems(document: Any) -> list[str]:
    text = document if isinstance(document, str) else json.dumps(document)
    with pytest.raises(MotionError) as caught:
        read_motion(text, SHAKER, "m.json")
    assert all(line.startswith("") and "\n" not in line for line in caught.value.problems)
    assert caught.value.exit_status == 2
    return [line.removeprefix("m.json: ") for line in caught.value.problems]


def test_every_example_is_read() -> None:
    motions = {m.name: load_motion(m, load_stand(stands.path(n))) for n in stands.names() for m in stands.motions(n)}
    assert sorted(motions) == [f"{n}.motion.json" for n in ("auv6", "bench8", "demo3", "shaker2", "shaker2_spin")]
    assert motions["demo3.motion.json"].winding == (12, -15, 10)
    assert motions["demo3.motion.json"].harmonics == (1, 2)
    bench8 = motions["bench8.motion.json"]
    assert bench8.bounds.speed == (50 * math.pi,) * 8
    assert isinstance(bench8.course, Harmonics)
    assert bench8.course.cos[0].tolist() == [2e-4, 1e-4, -5e-5, 3e-4, 2e-4, 0.0]  # mm, mrad: rounded once
    assert bench8.objective.acceleration == (1.0,) * 8
    assert not any(bench8.objective.torque)


def test_units_bounds_and_weights() -> None:
    bounds = {"speed": ["3000 rpm", 400], "speed_min": 10, "torque": "20 mN m", "bias": ["1 mm", *SIX[1:]]}
    more = {"winding": [1, -1], "runup": "500 ms", "bounds": bounds, "objective": {"torque": [1, 2]}}
    pose = {"mean": [1, 0, 0, 0, 0, 180], "free_mean": [True, False, True, True, True, True]}
    units = {"period": "50 ms", "units": {"linear": "cm", "angular": "deg"}}
    motion = read_motion(json.dumps(PLAIN | units | pose | more), SHAKER)
    assert motion.span == 0.05
    assert motion.mean.tolist() == [0.01, 0.0, 0.0, 0.0, 0.0, math.pi]
    assert isinstance(motion.course, Harmonics)
    assert motion.course.cos[0, 2] == 1e-6
    assert motion.free_mean == (True, False, True, True, True, True)
    assert (motion.winding, motion.runup) == ((1, -1), 0.5)
    assert motion.bounds.speed == (100 * math.pi, 400.0)
    assert (motion.bounds.torque, motion.bounds.angle) == ((0.02, 0.02), None)
    assert motion.bounds.bias == (1e-3, 0.0, 0.0, 0.0, 0.0, 0.0)
    assert motion.objective.torque == (1.0, 2.0)
    assert motion.objective.acceleration == (0.0, 0.0)


@pytest.mark.parametrize(
    ("change", "line"),
    [
        ({"schema": 2}, "schema: expected 1, found 2"),
        ({"perod": 1}, 'unknown key "perod", did you mean "period"?'),
        (
            {"amplitude": 0.1},
            'unknown key "amplitude": a motion has `harmonics`: rows `cos` and `sin` at the order `k`',
        ),
        ({"frequency": 10}, 'unknown key "frequency": a motion has `period` = 1 / frequency, in seconds'),
        ({"type": "cyclic"}, 'type: expected "periodic", "finite" or "slew", found "cyclic"'),
        ({"period": "-5 ms"}, "period: -5 ms (-0.005 s) is not above 0"),
        ({"period": "10 Hz"}, 'period: unit "Hz" does not fit, expected a time (s)'),
        ({"duration": 1}, 'duration: not allowed with type "periodic", which has `period`'),
        ({"mean": [0] * 5}, "mean: expected 6 numbers, found 5"),
        ({"harmonics": [{"k": 0}]}, "harmonics[0], k: expected 1 to 1000, found 0; a constant is `mean`"),
        ({"harmonics": [{"k": 1}, {"k": 1}]}, "harmonics[1], k: 1 appears twice"),
        ({"samples": {}}, "expected one of harmonics, samples, found harmonics and samples"),
        ({"winding": "spinn"}, 'winding: unknown "spinn", did you mean "spin"?'),
        (
            {"winding": [1]},
            'winding: expected 2 whole numbers (one per flywheel), "any", "spin" or "rock", found 1 numbers',
        ),
        (
            {"bounds": {"deviation": {"linear": "1 mm"}}},
            "bounds, deviation: needs `runup`: it bounds the carrier on the way there and back",
        ),
        ({"runup": 1, "bounds": {"deviation": {}}}, "bounds, deviation: expected linear, angular, or both"),
        ({"bounds": {"speed": -1}}, "bounds, speed: -1 is not above 0: a bound is a magnitude"),
        ({"bounds": {"bias": 1}}, "bounds, bias: expected 6 numbers (m, rad), found 1"),
        ({"bounds": {"start": {}}}, 'bounds, start: not allowed with type "periodic", which begins where it ends'),
        (
            {"objective": {"power": 1}},
            'objective, power: flywheels "left", "right" have no motor with `constant` and `resistance`: '
            "give them in the stand file, or weight 0",
        ),
        ({"bounds": {"speed": 100, "speed_min": 200}}, "bounds, speed_min[0]: 200 rad/s is above speed, 100 rad/s"),
        (
            {"bounds": {"speed": 100}, "winding": [1, 0]},
            "bounds, speed[0]: 100 rad/s is below the mean speed of winding 1, 125.664 rad/s",
        ),
        (
            {"bounds": {"speed_min": 1}, "winding": "rock"},
            "bounds, speed_min[0]: 1 rad/s, but with winding 0 a flywheel turns back",
        ),
        (
            {"bounds": {"speed_min": 200}, "winding": [2, 1]},
            "bounds, speed_min[1]: 200 rad/s is above the mean speed of winding 1, 125.664 rad/s",
        ),
    ],
)
def test_one_line_for_each_bad_input(change: dict[str, Any], line: str) -> None:
    assert line in problems({**PLAIN, **change})


def test_all_problems_are_told_together() -> None:
    lines = problems({**PLAIN, "period": 0, "perod": 1, "bounds": {"sped": 1}, "winding": 3, "mean": [1]})
    assert len(lines) == 5


def test_a_singular_attitude_is_refused() -> None:
    (line,) = problems({**PLAIN, "mean": [0, 0, 0, 0, math.pi / 2, 0]})
    assert line.startswith("singular attitude of the ship sequence at t = ")
    (line,) = problems({**PLAIN, "harmonics": [{"k": 1, "sin": [0, 0, 0, 0, 2.0, 0]}]})
    assert "theta reaches 0" in line


def test_a_step_in_the_samples_is_refused() -> None:
    z = 1e-4 * np.where(np.arange(32) < 16, 1.0, -1.0)
    (line,) = problems(sampled(z))
    assert line.startswith("samples, q[") and "a jump" in line
    (line,) = problems(sampled(1e-4 * np.arange(33) / 33))  # a sawtooth
    assert "a jump" in line


STEPS = [0.004 * i for i in range(11)]


@pytest.mark.parametrize(
    ("t", "line"),
    [
        ([0.0, 0.01], ": 2 samples, expected at least 12"),
        (
            [0.05 * i / 12 for i in range(13)],
            "[12]: 0.05 s is a period of 0.05 s after the first or more; t = T is left out",
        ),
        ([*STEPS, 0.04], "[11]: 0.04 s is not after 0.04 s, but q differs: the motion must be continuous"),
        ([*STEPS, 0.03], "[11]: 0.03 s is not after 0.04 s"),
    ],
)
def test_times_of_samples(t: list[float], line: str) -> None:
    q = rows(1e-4 * np.cos(2 * np.pi * np.arange(len(t)) / len(t)))
    assert problems({**sampled(np.zeros(12)), "samples": {"t": t, "q": q}}) == [f"samples, t{line}"]


def test_finite_motions_go_from_rest_to_rest() -> None:
    motion = read_motion(json.dumps(finite()), SHAKER)
    assert (motion.periodic, motion.span, motion.harmonics) == (False, 2.0, ())
    q, q_dot, q_ddot = motion.at(np.array([-1.0, 0.0, 1.0, 2.0, 3.0]))
    assert q[:, 2] == pytest.approx([0.0, 0.0, 5e-4, 1e-3, 1e-3], abs=1e-12)
    assert q_dot[[0, 1, 3, 4]] == pytest.approx(np.zeros((4, 6)), abs=1e-12)
    assert q_ddot[[0, 1, 3, 4]] == pytest.approx(np.zeros((4, 6)), abs=1e-12)


@pytest.mark.parametrize(
    ("shape", "words"),
    [(lambda x: x, "speed"), (lambda x: x**3, "speed"), (lambda x: 1 - np.cos(np.pi * x), "acceleration")],
)
def test_finite_motions_that_do_not_are_refused(shape: Any, words: str) -> None:
    document = finite()
    document["samples"]["q"] = rows(1e-3 * shape(np.linspace(0.0, 1.0, 21)))
    (line,) = problems(document)
    assert words in line and "starts and ends at rest" in line


def test_deviation_on_the_way() -> None:
    """It has units; a component that is left out has no bound."""
    motion = read_motion(json.dumps({**PLAIN, "runup": 1, "bounds": {"deviation": {"linear": "2 mm"}}}), SHAKER)
    assert motion.bounds.deviation == Deviation(2e-3)
    (line,) = problems({**PLAIN, "runup": 1, "bounds": {"deviation": {"linear": "0.09 mm", "angular": 1}}})
    assert line == "bounds, deviation: linear: 9e-05 m is below the deviation of the motion itself, 0.0001 m"


def test_start_of_a_finite_motion() -> None:
    start = {"phi": ["90 deg", -1], "phi_dot": -50}
    bounds = read_motion(json.dumps(finite(bounds={"start": start, "speed": 100})), SHAKER).bounds
    assert (bounds.start.phi, bounds.start.phi_dot) == ((math.pi / 2, -1.0), (-50.0, -50.0))
    (first, _) = problems(finite(bounds={"start": start, "speed": 10}))
    assert first == "bounds, start: phi_dot[0]: -50 rad/s is outside speed_min, speed: 0 to 10"


AMPLITUDES = arrays(np.float64, (3, 6), elements=st.floats(-1.0, 1.0))


def harmonics(cos: np.ndarray, sin: np.ndarray) -> Harmonics:
    return Harmonics(0.1, (1, 2, 5), cos, sin)


@given(AMPLITUDES, AMPLITUDES)
def test_derivatives_are_those_of_the_course(cos: np.ndarray, sin: np.ndarray) -> None:
    course = harmonics(cos, sin)
    t, h = np.linspace(-0.1, 0.3, 41), 1e-6
    before, at, after = course.at(t - h), course.at(t), course.at(t + h)
    omega = 2 * np.pi * 5 / 0.1
    # differences: h^2 omega^3 / 6 of truncation, eps / h of rounding
    assert (after.q - before.q) / (2 * h) == pytest.approx(at.q_dot, abs=1e-4 * omega)
    assert (after.q_dot - before.q_dot) / (2 * h) == pytest.approx(at.q_ddot, abs=1e-4 * omega**2)


BENCH8 = load_stand(stands.path("bench8"))
BENCH8_MOTION = load_motion(stands.motions("bench8")[0], BENCH8)


def sampled_bench8(folder: Path, count: int, share: float = 1.0) -> Path:
    """bench8's motion by samples, over a share of its period."""
    document: dict[str, Any] = json.loads(stands.motions("bench8")[0].read_text(encoding="utf-8"))
    del document["harmonics"]
    t = share * BENCH8_MOTION.span * np.arange(count) / count
    document |= {"units": {}, "samples": {"t": t.tolist(), "q": (BENCH8_MOTION.at(t).q - BENCH8_MOTION.mean).tolist()}}
    path = folder / "m.json"
    path.write_text(json.dumps(document), encoding="utf-8")
    return path


@pytest.mark.parametrize("count", [16, 24, 31, 32, 64])
def test_the_images_of_a_spline_are_no_harmonics(count: int, tmp_path: Path) -> None:
    assert load_motion(sampled_bench8(tmp_path, count), BENCH8).harmonics == BENCH8_MOTION.harmonics == (1,)


def test_samples_of_a_part_of_the_period_are_refused(tmp_path: Path) -> None:
    with pytest.raises(MotionError, match="is it the period of these samples"):
        load_motion(sampled_bench8(tmp_path, 32, 0.5), BENCH8)


ATTITUDE = ["wx", "wy", "wz"]


def sat4() -> Stand:
    return load_stand(stands.path("sat4"))


def read(**keys: Any) -> Slew:
    slew = read_motion_or_slew(json.dumps({"schema": 1, "type": "slew"} | keys), sat4(), "m.json")
    assert isinstance(slew, Slew)
    return slew


def test_the_shortest_turn_from_start_to_end() -> None:
    slew = read(task="pointing", start={"angles": ["10 deg", 0, 0]}, end={"angles": ["50 deg", 0, 0]})
    assert slew.kind == "attitude" and slew.goal == "fastest" and slew.duration is None
    assert slew.angle == pytest.approx(np.radians(40)) and slew.axis == pytest.approx([0, 0, 1], abs=1e-12)
    back = read(task="pointing", end={"quaternion": [np.cos(2.8), 0, np.sin(2.8), 0]}, duration="5 s")
    assert back.angle == pytest.approx(2 * np.pi - 5.6) and back.axis == pytest.approx([0, -1, 0], abs=1e-12)
    assert back.goal == "quietest" and back.duration == 5.0


def test_a_line_of_sight_is_the_axis_that_no_row_names() -> None:
    slew = read(rows=[{"point": "acc1", "rows": ["wx", "wz"]}], end={"direction": [1, 1, 0]})
    sight = np.array([-0.5, np.sqrt(0.75), 0.0])  # second axis of acc1, turned by 30 degrees about z
    assert slew.kind == "sight" and slew.axis == pytest.approx(sight)
    assert np.cos(slew.angle) == pytest.approx(float(sight @ [1, 1, 0]) / np.sqrt(2))
    assert slew.path(np.array([slew.angle]))[0] @ sight == pytest.approx(np.array([1, 1, 0]) / np.sqrt(2))


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
def test_one_line_for_each_bad_slew(keys: dict[str, Any], words: str) -> None:
    with pytest.raises(MotionError) as error:
        read(**keys)
    assert any(line.startswith("m.json: ") and words in line for line in error.value.problems), error.value.problems


def test_a_slew_has_a_course_only_with_its_programme() -> None:
    text = json.dumps(
        {"schema": 1, "type": "slew", "name": "s", "rows": ATTITUDE, "end": {"angles": [0.5, 0, 0]}, "duration": 2}
    )
    with pytest.raises(MotionError, match="give its programme as well"):
        read_motion(text, sat4(), "m.json")
    t = np.array([0.0, 0.7, 2.0])
    rng = np.random.default_rng(0)
    table_rows = [rng.normal(size=(3, 4)) for _ in range(3)]
    carrier = PlannedCourse(t, *(0.1 * rng.normal(size=(3, 6)) for _ in range(3)))
    made = Programme.of(load_stand(stands.path("sat4")), "s", 2.0, np.zeros(6), None, Samples(t, *table_rows))
    programme = replace(made, carrier=carrier)
    again = read_programme(programme_text(programme))
    assert again.carrier is not None and programme_text(again) == programme_text(programme)
    motion = read_motion(text, sat4(), "m.json", again)
    assert motion.span == 2.0 and motion.slew is not None and motion.bounds.start.phi_dot == (0.0,) * 4
    for course, planned in zip(motion.at(t), (carrier.q, carrier.q_dot, carrier.q_ddot), strict=True):
        assert course == pytest.approx(planned, abs=1e-12)
    broken = json.loads(programme_text(programme))
    broken["carrier"]["q"] = broken["carrier"]["q"][:2]
    with pytest.raises(ProgrammeError, match="carrier, q: 2 rows, but t has 3 numbers"):
        read_programme(json.dumps(broken))
