"""The commands as functions: results with names, units and arrays; equal to what the commands print."""

from __future__ import annotations

import math
from functools import cache
from typing import Any

import numpy as np
import pytest

import mahovik
from mahovik import stands
from mahovik.core.stand.masses import pose
from mahovik.out.commands.simulate import share_of

SHAKER2 = str(stands.path("shaker2"))


@cache
def shaker() -> Any:
    return mahovik.example("shaker2")


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


def test_wheels_alone_act_on_the_body_of_a_simulator() -> None:
    """A body without flywheels, on which the negative mount wrenches act, moves as the whole stand does."""
    stand = mahovik.example("sat4").replace({"carrier.wrench_input": True})
    keys = {key: value for key, value in stand.to_dict().items() if key not in ("flywheel", "task")}
    model, body = mahovik.build(stand), mahovik.build(mahovik.Stand.from_dict(keys, "body"))
    V, phi_ddot = [0.1, -0.2, 0.3, 0.4, -0.5, 0.6], [30.0, -20.0, 10.0, 40.0]
    x = model.state(V=V, phi=[0.1, 2.0, 4.0, 6.0], phi_dot=[500.0, -300.0, 200.0, 100.0])
    whole = model.forward(x, phi_ddot)["V_dot"]
    wrench = np.zeros(6)
    for wheel, on in zip(stand.flywheels, model.mounts(x, whole, phi_ddot)["mount_wrench"], strict=True):
        origin, axes = pose(stand, wheel)
        force, moment = axes @ on[:3], axes @ on[3:]
        wrench -= [*force, *(moment + np.cross(origin, force))]
    alone = body.forward(body.state(V=V), wrench={"carrier": wrench})["V_dot"]
    np.testing.assert_allclose(alone, whole, rtol=1e-12, atol=1e-12 * np.abs(whole).max())
