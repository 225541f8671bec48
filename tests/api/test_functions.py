"""The commands as functions: results with names, units and arrays, as printed; wrong inputs are refused in one line."""

from __future__ import annotations

import math
import pickle
from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
import pytest

import mahovik
from api.models import model
from mahovik import stands
from mahovik.core.stand.masses import pose

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
    swept: tuple[Any, ...] = ({"left": "0..60 rad/s"}, {"left": (0, 60.0)}, {"left": np.array([0.0, 60.0])})
    largest = [mahovik.vibration(shaker(), speed=x, at="carrier", steps=3)["largest"] for x in swept]
    assert largest[0] == largest[1] == largest[2]
    phases: tuple[Any, ...] = ("left=90 deg", {"left": "90 deg"}, [math.pi / 2, 0.0])
    peaks = [mahovik.vibration(shaker(), speed=60.0, at="carrier", phase=x)["peak"].tolist() for x in phases]
    assert peaks[0] == peaks[1] == peaks[2]
    together, apart = (mahovik.check(shaker(), phase=x)["rest"] for x in (1.0, [1.0, 1.0]))
    assert str(together) == str(apart)


def test_warnings_are_those_of_python() -> None:
    with pytest.warns(mahovik.MahovikWarning, match="a flywheel turns"):
        mahovik.simulate(shaker(), until=1e-3, regime={"default": {"speed": "9000 rpm"}}, dt=1e-3)


REFUSED: list[tuple[str, str, dict[str, Any], str]] = [
    ("vibration", "sat4", {"steps": 2.5}, "steps 2.5: expected a whole number"),
    ("vibration", "sat4", {"band": (math.nan, 10.0)}, "band nan..10 Hz: expected two frequencies"),
    ("vibration", "sat4", {"band": (10.0,)}, "band 10 Hz: expected two frequencies"),
    ("vibration", "sat4", {"speed": ["all=1", 2]}, "speed 2: expected NAME=SPEED"),
    (
        "vibration",
        "sat4",
        {"speed": 1.0, "improve": True, "momentum": (0, 0)},
        "momentum (0, 0): expected three finite numbers",
    ),
    ("verify", "demo3", {"states": 0}, "states 0: expected a whole number of at least 1"),
    ("verify", "demo3", {"real": "half"}, 'real: unknown "half", expected one of double, float'),
    ("verify", "demo3", {"targets": ""}, "targets: is empty"),
    ("modes", "demo3", {"flywheels": "fre"}, 'flywheels: unknown "fre", expected one of locked, free'),
    ("vibration", "sat4", {"speed": None}, "speed None: expected a number or a text or a mapping NAME=SPEED"),
    ("vibration", "sat4", {"speed": True}, "speed True: expected a number or a text"),
    ("vibration", "sat4", {"speed": {}}, "speed: is empty"),
    ("vibration", "sat4", {"speed": [100.0, 200.0]}, "speed: 2 speeds, but the stand has 4 flywheels"),
    ("vibration", "sat4", {"speed": {"rw1": {}}}, "speed rw1 of type dict: expected a number or a text or a list"),
    (
        "vibration",
        "sat4",
        {"speed": {"rw1": np.ones(4)}},
        "speed rw1: 4 numbers, expected one speed, or two",
    ),
    ("vibration", "sat4", {"phase": [1.0, 2.0]}, "phase: 2 phases, but the stand has 4 flywheels; expected NAME"),
    ("vibration", "sat4", {"require": 5}, "require 5: expected a text or a list"),
    ("vibration", "sat4", {"require": [5]}, "require[0] 5: expected a text"),
    ("simulate", "sat4", {"start": {"phi_dot": {"rw9": 1.0}}}, 'phi_dot: no flywheel "rw9", did you mean "rw1"?'),
    ("simulate", "sat4", {"start": {"V": "1 m/s"}}, "V: expected real numbers in SI, found texts"),
    ("simulate", "sat4", {"start": 3}, "start 3: expected a mapping or a text or a path or States"),
    ("simulate", "sat4", {"regime": {"default": {"speed": object()}}}, "default: expected what JSON can have"),
    ("identify", "sat4", {"data": [3]}, "data[0] 3: expected a text or a path or DataFrame"),
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
    "simulate": {"until": 1e-3},
    "identify": {"free": "rw1.mass"},
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


SPOILT = [
    ("phi", 0, "w1", 2e7, "phi w1 is 20000000, at most 1e+07 rad"),
    ("V", 1, "v", 1e5, "V v is 100000, at most 10000 m/s"),
    ("V", 4, "q", np.nan, "V q is nan"),
    ("attitude", 0, "w", 0.5, "attitude has length 0.5, expected 1 within 0.001"),
    ("position", 2, "z", -np.inf, "position z is -inf"),
]


@pytest.mark.parametrize(("name", "place", "label", "value", "reason"), SPOILT)
def test_the_first_refused_state_is_named(name: str, place: int, label: str, value: float, reason: str) -> None:
    m = model("bench8")
    x = m.states(6)
    x[name, label][[2, 4]] = value
    assert np.array_equal(x[name][2, place], value, equal_nan=True)
    with pytest.raises(mahovik.RefusedError) as caught:
        m.forward(x)
    error = caught.value
    status = "RANGE" if np.isfinite(value) else "NOT_FINITE"
    assert str(error) == f"forward: state 2: {status}: {reason}; 2 of 6 states refused"
    assert (error.function, error.index, error.name, error.count) == ("forward", 2, status, 2)
    assert isinstance(error, mahovik.StateError) and str(pickle.loads(pickle.dumps(error))) == str(error)


@pytest.mark.parametrize("function", ["forward", "inverse", "step"])
def test_on_request_refused_states_are_nan_and_the_others_as_ever(function: str) -> None:
    m = model("bench8")
    x = m.states(9, V=np.random.default_rng(1).normal(size=(9, 6)))
    options: dict[str, list[Any]] = {"inverse": [np.ones(6)], "step": [1e-3]}
    more = options.get(function, [])
    good = dict(getattr(m, function)(x, *more))
    x.phi[4, 0] = np.nan
    result = getattr(m, function)(x, *more, on_error="nan")
    rest = [j for j in range(9) if j != 4]
    for key, value in dict(result).items():
        assert np.array_equal(value[rest], good[key][rest]), key
        if value.dtype.kind == "f":
            assert np.isnan(value[4]).all(), key
    if not function.startswith("step"):
        assert result.status[4] == mahovik.Status.NOT_FINITE and np.all(result.status[rest] >= 0)
        assert mahovik.status_words(result.status)[4] == "NOT_FINITE" and result.messages == ["1 of 9 refused: NaN"]


NO_STAND: Any = "bench8.toml"
NO_REAL: Any = "half"
NOTHING: Any = None
NUMBER: Any = 3

CALLS: dict[str, Callable[[Any], Any]] = {
    "phi_ddot: expected shape (8,) or (n, 8) (w1, w2, w3, w4, w5, w6, w7, w8), found (7,)": lambda m: m.forward(
        m.state(), np.ones(7)
    ),
    'phi_ddot: "fast" is not a number with a unit, expected an angular acceleration (rad/s^2)': lambda m: m.forward(
        m.state(), "fast"
    ),
    "weight: expected real numbers in SI, found texts": lambda m: m.inverse(m.state(), 0.0, weight="1 kg"),
    "tau: no array of numbers: setting an array element with a sequence": lambda m: m.coupled(
        m.state(), [[1.0], [2.0, 3.0]]
    ),
    'tau: no flywheel "W1", did you mean "w1"?': lambda m: m.coupled(m.state(), {"W1": 1.0}),
    'locked: no flywheel "w9", did you mean "w1"?': lambda m: m.coupled(m.state(), locked=["w9"]),
    'wrench: no body "carier", did you mean "carrier"?': lambda m: m.forward(m.state(), wrench={"carier": [0] * 6}),
    'wrench: the C takes none on "carrier": set `wrench_input = true` in the stand file': lambda m: m.forward(
        m.state(), wrench={"carrier": [0] * 6}
    ),
    "different numbers of states: x 3, phi_ddot 4": lambda m: m.forward(m.states(3), np.zeros((4, 8))),
    "states: n is 3, but arrays of 4 states were given": lambda m: m.states(3, V=np.zeros((4, 6))),
    "states: n: expected a number of states, found -1": lambda m: m.states(-1),
    "state: 2 states given, expected one: use states": lambda m: m.state(V=np.zeros((2, 6))),
    "states: expected shape (29,) or (n, 29), found (28,)": lambda m: m.forward(np.zeros(28)),
    "attitude, angles: both given, expected one of them": lambda m: m.state(attitude=[1, 0, 0, 0], angles=[0, 0, 0]),
    "order: expected 2 or 4, found 3": lambda m: m.step(m.state(), 1e-3, order=3),
    "dt: expected one number for all states, found shape (2,)": lambda m: m.step(m.state(), [1e-3, 1e-3]),
    'dt: unit "m" does not fit, expected a time (s)': lambda m: m.step(m.state(), "1 m"),
    "step: BAD_ARGUMENT: dt is -1 s, expected above 0 and at most 10": lambda m: m.step(m.state(), -1.0),
    'on_error: expected "raise" or "nan", found \'ignore\'': lambda m: m.forward(m.state(), on_error="ignore"),
    'on_error: expected "raise" or "nan", found \'x\'': lambda m: m.simulate("1 ms", on_error="x"),
    "path None: expected a text or a path": lambda _: mahovik.load(NOTHING),
    "path of type dict: expected a text or a path": lambda m: m.stand.save({}),
    "changes 3: expected a mapping": lambda m: m.stand.replace(3),
    "document 3: expected a mapping": lambda _: mahovik.Stand.from_dict(NUMBER),
    "stand None: expected a mapping or a text or a path or Stand": lambda _: mahovik.vibration(NOTHING, speed=1.0),
    "stand 3: expected a mapping or a text or a path or Stand": lambda _: mahovik.modes(NUMBER),
    "status half: expected a whole number or a list": lambda _: mahovik.status_words(NO_REAL),
    "path 3: expected a text or a path": lambda m: m.forward(m.state()).save(3),
    "ax: expected axes of matplotlib, or a list of them, found int": lambda m: m.simulate(2e-3).plot(3),
    '"phidot": no such name, did you mean "phi_dot"?': lambda m: m.state()["phidot"],
    'phi: no "w0" on axis 0, did you mean "w1"?': lambda m: m.state()["phi", "w0"],
    'phidot: states have no such array, did you mean "phi_dot"?': lambda m: setattr(m.state(), "phidot", 1.0),
    "inverse: BAD_ARGUMENT: limit w2 is -1 rad/s2, expected above 0": lambda m: m.inverse(
        m.state(), 0.0, limit={"w2": -1.0}
    ),
    "inverse: RANGE: weight w1 is 0, expected at least 1e-06": lambda m: m.inverse(m.state(), 0.0, weight={"w1": 0}),
    "inverse: BAD_ARGUMENT: near_singular is 2, expected 0 to 1": lambda m: m.inverse(m.state(), 0.0, near_singular=2),
    "points: the stand has no instruments or points": lambda m: m.points(m.state()),
    "limit: expected shape (8,), the same for all states": lambda m: m.inverse(m.state(), 0.0, limit=np.ones((2, 8))),
    "build: expected a Stand, found str: mahovik.load(path) reads one": lambda _: mahovik.build(NO_STAND),
    'build: real: expected "double" or "float", found \'half\'': lambda m: mahovik.build(m.stand, real=NO_REAL),
    "build: threads: expected a number from 1, found 0": lambda m: mahovik.build(m.stand, threads=0),
    "compiler tcc9: no such command; leave it out or name an installed C compiler": lambda m: mahovik.build(
        m.stand, compiler="tcc9"
    ),
}


@pytest.mark.parametrize("message", CALLS)
def test_one_line_says_what_is_wrong(message: str) -> None:
    with pytest.raises(mahovik.MahovikError) as caught:
        CALLS[message](model("bench8"))
    assert str(caught.value) == message
    assert "\n" not in message


def test_an_input_error_is_a_value_error() -> None:
    with pytest.raises(ValueError, match="expected shape"):
        model("bench8").forward(np.zeros(28))


def test_states_of_another_stand_are_refused() -> None:
    with pytest.raises(mahovik.InputError, match=r"states of another stand: .*general.*, expected states of bench8"):
        model("bench8").forward(model("general").state())


def test_without_a_compiler_one_line_says_what_installs_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", "")
    monkeypatch.delenv("CC", raising=False)
    with pytest.raises(mahovik.ToolchainError, match=r"no C compiler found .* install one, on Debian with"):
        mahovik.build(mahovik.example("bench8"))
