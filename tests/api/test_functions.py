"""The commands as functions: results with names, units and arrays; equal to what the commands print."""

from __future__ import annotations

import math
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import mahovik
from mahovik import stands
from mahovik.core.stand.random import BARE, random_stand
from mahovik.out.commands.simulate import share_of

SHAKER2 = str(stands.path("shaker2"))
SPIN = str(Path(SHAKER2).parent / "shaker2_spin.motion.json")


@cache
def shaker() -> Any:
    return mahovik.example("shaker2")


@pytest.mark.slow
def test_a_result_is_drawn_on_new_axes_or_given_ones() -> None:
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    from matplotlib import pyplot

    run = mahovik.simulate(shaker(), until=0.01, regime={"default": {"speed": "100 rpm"}}, backend="scipy")
    axes = run.plot()
    assert axes and all(ax.get_title("left") or ax.lines or ax.collections for ax in axes)
    _, my_axes = pyplot.subplots()
    assert run.plot(my_axes) is my_axes and (my_axes.lines or my_axes.collections)
    _, many = pyplot.subplots(len(axes) + 1)
    with pytest.raises(mahovik.UsageError, match="panels to draw"):
        run.plot(many)
    pyplot.close("all")


@pytest.mark.slow
def test_c_is_judged_and_a_page_made(tmp_path: Path) -> None:
    report = mahovik.verify(shaker(), states=5)
    assert report.ok and "forward" in report["rows"]["judged"] and report["passed"] is True
    assert mahovik.report(shaker(), output=tmp_path / "report.html").ok and (tmp_path / "report.html").is_file()


def test_speeds_are_a_mapping_texts_or_one_for_all() -> None:
    speeds: tuple[Any, ...] = (
        {"left": "600 rpm", "right": "-1*left"},
        ["left=600rpm", "right=-1*left"],
        ["600 rpm", -20.0 * math.pi],
    )
    amplitudes = [mahovik.vibration(shaker(), speed=speed, at="carrier")["rms"].tolist() for speed in speeds]
    assert amplitudes[0] == amplitudes[1] == pytest.approx(amplitudes[2])
    one, many = (mahovik.vibration(shaker(), speed=x, at="carrier")["worst"].tolist() for x in (60.0, {"all": 60.0}))
    assert one == many


def test_warnings_are_those_of_python() -> None:
    with pytest.warns(mahovik.MahovikWarning, match="a flywheel turns"):
        mahovik.simulate(shaker(), until=1e-3, regime={"default": {"speed": "9000 rpm"}}, dt=1e-3, backend="scipy")


def test_a_plan_without_a_programme_says_why() -> None:
    rigid = random_stand(np.random.default_rng(1), 3, BARE, "rigid")
    motion = {"name": "up", "type": "periodic", "period": 0.1,
              "harmonics": [{"k": 1, "cos": [1, 0, 0, 0, 0, 0], "sin": [0] * 6}]}  # fmt: skip
    plan = mahovik.plan(rigid, motion=motion)
    assert plan["status"] == "NO_PROGRAM" and plan.messages and plan.count == 0 and not plan.ok
    with pytest.raises(mahovik.UsageError, match="NO_PROGRAM"):
        mahovik.verify(rigid, programme=plan, motion=motion)


@pytest.mark.parametrize(
    ("mismatch", "words"),
    [
        ("1 kg", "1 kg: expected 0 or more"),
        ("-1%", "-1%: expected 0 or"),
        (-0.1, "-0.1: expected 0 or"),
        (None, "None: exp"),
    ],
)
def test_a_mismatch_that_is_no_share_is_refused(mismatch: Any, words: str) -> None:
    with pytest.raises(mahovik.UsageError, match=f"^mismatch {words}"):
        share_of(mismatch)


REFUSED: list[tuple[str, str, dict[str, Any], str]] = [
    ("vibration", "sat4", {"steps": 2.5}, "steps 2.5: expected a whole number"),
    ("vibration", "sat4", {"band": (math.nan, 10.0)}, "band nan..10 Hz: expected two frequencies"),
    ("vibration", "sat4", {"band": (10.0,)}, "band 10 Hz: expected two frequencies"),
    ("vibration", "sat4", {"speed": [1, 2]}, "speed 1: expected NAME=SPEED"),
    (
        "vibration",
        "sat4",
        {"speed": 1.0, "improve": True, "momentum": (0, 0)},
        "momentum (0, 0): expected three finite numbers",
    ),
    ("verify", "demo3", {"states": 0}, "states 0: expected a whole number of at least 1"),
    ("verify", "demo3", {"real": "half"}, "'half'"),
    ("verify", "demo3", {"seed": -1}, "seed -1: expected a whole number of at least 0"),
    ("verify", "demo3", {"judges": True, "states": 0}, "states 0: expected a whole number of at least 1"),
    ("plan", "demo3", {"method": "x"}, 'method: unknown "x", expected one of fourier, ocp'),
    ("plan", "demo3", {"free": "w9.mass"}, 'w9.mass: demo3 has no "w9"'),
    ("plan", "demo3", {"free": "w2.center_of_mass[0]"}, "expected its bounds, [low, high], in the motion file"),
    ("judge", "demo3", {"states": 0}, "states 0: expected a whole number of at least 1"),
    ("judge", "demo3", {"tolerance": math.nan}, "tolerance nan: expected a number above 0"),
    ("judge", "demo3", {"timeout": 0}, "timeout 0: expected a number above 0"),
    ("judge", "demo3", {"want": ["forwards"]}, 'want: unknown "forwards", did you mean "forward"?'),
    ("judge", "demo3", {"timeout": "1 kg"}, 'timeout: unit "kg" does not fit'),
]
USUAL: dict[str, dict[str, Any]] = {
    "vibration": {"speed": {"all": "100..3000rpm"}, "at": "acc1"},
    "plan": {"motion": stands.path("demo3").with_suffix(".motion.json")},
    "judge": {"with_": "false"},
}


@pytest.mark.parametrize(("function", "stand", "arguments", "words"), REFUSED)
def test_values_without_meaning_are_refused_by_the_name_of_the_argument(
    function: str, stand: str, arguments: dict[str, Any], words: str
) -> None:
    with pytest.raises(mahovik.MahovikError) as caught:
        getattr(mahovik, function)(stands.path(stand), **USUAL.get(function, {}) | arguments)
    assert words in str(caught.value)


DEMO3 = str(stands.path("demo3"))


TILT = str(stands.path("shaker2").with_name("shaker2.motion.json"))


def test_a_run_of_texts_is_that_of_the_numbers() -> None:
    texts = mahovik.simulate(DEMO3, until="20 ms", dt="0.5 ms", every="2000 us")
    numbers = mahovik.simulate(DEMO3, until=0.02, dt=0.0005, every=0.002)
    assert texts.count == 11
    assert texts["t"][-1] == 0.02
    for name in ("z", "phi w1", "v_dot_x"):
        np.testing.assert_array_equal(texts[name], numbers[name])


@pytest.mark.parametrize("name", ["until", "every"])
@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("1 m", 'unit "m" does not fit, expected a time (s)'),
        ("soon", '"soon" is not a number with a unit'),
        ("0 s", "0: expected a time above 0, in s"),
    ],
)
def test_other_texts_are_refused_by_name(name: str, text: str, words: str) -> None:
    arguments = {"until": 1.0, name: text}
    with pytest.raises(mahovik.UsageError) as refused:
        mahovik.simulate(DEMO3, **arguments)  # type: ignore[arg-type]
    assert str(refused.value).startswith(name)
    assert words in str(refused.value)


@pytest.mark.parametrize(("text", "words"), [("1 kg", 'time: unit "kg" does not fit'), ("0 s", "time 0: expected")])
def test_a_search_reads_its_limit_before_it_begins(text: str, words: str) -> None:
    with pytest.raises(mahovik.UsageError, match=words):
        mahovik.plan(SHAKER2, motion=TILT, time=text)
