"""The C of an attitude loop beside its law in NumPy, and closed by the exact plant; what is refused."""

from __future__ import annotations

import ctypes as ct
import math
import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import example as example_of
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

import mahovik
from export import attitude_law as law
from export.attitudes import (
    DEFAULT,
    Attitude,
    Config,
    Loop,
    N,
    Reference,
    Result,
    State,
    example,
    exported,
    numbers,
    stand,
    written,
)
from export.programmes import check_delivered
from mahovik.core.stand import load
from mahovik.core.stand.model import Hold, Stand, rest_state
from mahovik.errors import UsageError
from mahovik.out.export.project import attitude_sources
from mahovik.proof.reference import pieces
from mahovik.proof.reference.pieces import momentum
from mahovik.stands import path
from mahovik.use.control.attitude import LoopOptions, design_attitude
from toolchain.quick import quick
from toolchain.tools import require, run

OK, LIMITED, UNREACHABLE, NOT_FINITE, RANGE, BAD_ARGUMENT = 0, 4, 8, -1, -2, -5
SPEED = 200 * math.pi  # rad/s; no-load speed of the motors
drawn_states = settings(max_examples=30, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])


@pytest.fixture(scope="module")
def c(tmp_path_factory: pytest.TempPathFactory) -> Attitude:
    return Attitude(written(exported(), tmp_path_factory.mktemp("attitude")))


seeds = st.integers(0, 2**32 - 1).map(np.random.default_rng)


def unit(rng: Any) -> list[float]:
    q = rng.normal(size=4)
    return [float(v) for v in q / np.linalg.norm(q)]


def state(rng: Any, attitude: Any, rate: Any = (0.0, 0.0, 0.0), most: float = 0.6) -> Any:
    x = State()
    x.attitude[:] = attitude
    x.V[:] = [0.0, 0.0, 0.0, *rate]
    x.phi[:] = rng.uniform(-3, 3, N)
    x.phi_dot[:] = rng.uniform(-most, most, N) * SPEED
    return x


def begun(c: Attitude, config: Any, attitude: Any, goal: Any = None) -> Any:
    loop = Loop()
    assert c.call("reset", ct.byref(config), numbers(*attitude), ct.byref(loop)) == OK
    if goal is not None:
        assert c.call("slew", ct.byref(config), numbers(*goal), ct.byref(loop)) == OK
    return loop


def reference_at(c: Attitude, course: Any, t: float) -> Any:
    out = Reference()
    assert c.call("reference_at", ct.byref(course), ct.c_double(t), ct.byref(out)) == OK
    return out


@drawn_states
@given(seeds, st.floats(-0.2, 1.2))
def test_a_slew_is_the_turn_of_scipy(c: Attitude, rng: Any, share: float) -> None:
    config, begin, goal = c.config(), unit(rng), unit(rng)
    course = begun(c, config, begin, goal).course
    _, duration = law.slew(begin, goal, config, 0.0)
    assert course.duration == pytest.approx(duration, rel=1e-6)  # the largest slope is found on a grid
    assert 0 <= course.angle <= math.pi
    reference = reference_at(c, course, share * course.duration)
    wanted, _ = law.slew(begin, goal, config, share * duration)
    turned = law.rotation(reference.attitude)
    assert (turned.inv() * wanted.turned).magnitude() < 1e-6 * max(1.0, abs(share))
    exact, _ = law.slew(begin, goal, _same_time(config, course), share * course.duration)
    assert (turned.inv() * exact.turned).magnitude() < 1e-12
    np.testing.assert_allclose(reference.rate[:], exact.rate, atol=1e-12)
    np.testing.assert_allclose(reference.acceleration[:], exact.acceleration, atol=1e-12)
    assert np.linalg.norm(reference.rate[:]) <= config.slew_rate * (1 + 1e-12)
    assert np.linalg.norm(reference.acceleration[:]) <= config.slew_acceleration * (1 + 1e-12)


def _same_time(config: Any, course: Any) -> Any:
    """Settings whose turn lasts as long as that of the C."""
    made = Config.from_buffer_copy(config)
    made.slew_rate = 1e9
    made.slew_acceleration = 10 / math.sqrt(3) * course.angle / course.duration**2
    return made


@pytest.fixture(scope="module")
def model(tmp_path_factory: pytest.TempPathFactory) -> mahovik.Model:
    """The stand without unbalance and asymmetry: the mean over the phases of its flywheels."""
    text = path("eye4").read_text()
    lines = [line for line in text.splitlines() if not line.startswith("unbalance")]
    mean = (0.00087533 + 0.00088408) / 2
    text = "\n".join(lines).replace("[0.00087533, 0.00088408]", f"[{mean!r}, {mean!r}]")
    file = tmp_path_factory.mktemp("balanced") / "eye4.toml"
    file.write_text(text, encoding="utf-8")
    return mahovik.build(mahovik.load(file))


@drawn_states
@given(seeds, st.lists(st.sampled_from([0, 0, 0, 1, 2]), min_size=N, max_size=N))
def test_a_sample_is_the_law_with_the_torques_of_a_balanced_stand(
    c: Attitude, model: mahovik.Model, rng: Any, failed: list[int]
) -> None:
    config = c.config(closing_rate=0.05, wanted_momentum=rng.normal(size=3) * 0.1)
    begin = unit(rng)
    loop = begun(c, config, begin, unit(rng))
    loop.tick = int(rng.integers(0, 5000))
    loop.integral[:] = integral = rng.normal(size=3) * 0.01
    t = min(loop.tick * config.period, loop.course.duration)
    seen = reference_at(c, loop.course, t)
    wanted = law.Wanted(law.rotation(seen.attitude), np.array(seen.rate), np.array(seen.acceleration))
    near = (wanted.turned * Rotation.from_rotvec(rng.normal(size=3) * 10.0 ** rng.uniform(-6, -1))).as_quat()
    rate = rng.normal(size=3) * 10.0 ** rng.uniform(-4, -1)
    x, out = state(rng, near[[3, 0, 1, 2]], rate), Result()
    status = c.step(config, loop, x, tuple(failed), out)
    error, acceleration, limited = law.demand(config, wanted, x.attitude[:], rate, integral)

    y = model.states()
    y["attitude"], y["V"], y["phi_dot"] = x.attitude[:], x.V[:], x.phi_dot[:]
    momentum = model.momentum(y)
    left = momentum.Z[3:] - np.cross(momentum.center_of_mass, momentum.Z[:3])
    left = left - law.rotation(x.attitude).inv().apply(np.array(config.wanted_momentum))
    np.testing.assert_allclose(out.momentum[:], left, atol=1e-12)
    moment, _ = law.moment(config, left, False)
    np.testing.assert_allclose(out.moment[:], moment, atol=1e-12)
    speed, flags = np.array(x.phi_dot), np.array(failed)
    bounds = law.bounds(config, np.full(N, 0.1), np.full(N, SPEED), speed, flags == 0)
    tau = model.torque_for(
        y,
        "pointing",
        acceleration,
        locked=[f"rw{s + 1}" for s in range(N) if flags[s] == 2],
        motor_torque=bounds,
        target_speed=np.array(config.preferred),
        target_rate=config.preferred_rate,
        avoid_speed=config.avoid,
        keep_direction=True,
        wrench={"carrier": [0, 0, 0, *moment]},
    )
    motors = np.where(flags == 0, tau.tau + law.friction(config, speed), 0.0)
    np.testing.assert_allclose(out.tau[:], motors, atol=1e-12, rtol=1e-9)
    assert out.share == pytest.approx(float(tau.share), abs=1e-9)
    most = np.where(np.array(out.tau) * speed > 0, 0.1 * (1 - np.abs(speed) / SPEED), 0.1)
    assert np.all(np.abs(out.tau[:]) <= most * (1 + 1e-14))
    assert (status & UNREACHABLE != 0) == (out.share < 1)
    held = (status & UNREACHABLE != 0) or limited
    np.testing.assert_allclose(
        loop.integral[:], integral if held else np.clip(integral + config.period * error, -0.1, 0.1), atol=1e-13
    )


@settings(drawn_states, max_examples=3)
@given(seeds)
def test_the_mean_table_is_the_mean_over_phases(c: Attitude, rng: Any) -> None:
    """It is the mean of the literal reference over eight phases, which is exact for harmonics up to the second."""
    x = state(rng, unit(rng), rng.normal(size=3) * 0.1)
    total = np.zeros(6)
    for k in range(8):
        phi = tuple(v + k * math.pi / 4 for v in x.phi)
        seen = replace(
            rest_state(stand()), quaternion=tuple(x.attitude), V=tuple(x.V), phi=phi, phi_dot=tuple(x.phi_dot)
        )
        total += momentum(pieces(stand(), seen)) / 8
    np.testing.assert_allclose(c.momentum(x), total, atol=1e-12)


# -- what is no input --------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "changed",
    [
        {"period": 0.0},
        {"bandwidth": math.nan},
        {"damping": -1.0},
        {"integral": 10.0},
        {"closing_rate": 0.0},
        {"slew_rate": math.inf},
        {"dump_end": 1.0},
        {"wanted_momentum": (0.0, math.nan, 0.0)},
        {"coulomb_speed": (1.0, 0.0, 1.0, 1.0)},
        {"avoid": -1.0},
    ],
)
def test_settings_out_of_their_ranges_are_refused(c: Attitude, changed: Any) -> None:
    loop = begun(c, c.config(), (1, 0, 0, 0))
    _refused(c, c.config(**changed), loop, state(np.random.default_rng(1), (1, 0, 0, 0)), (0,) * N, BAD_ARGUMENT)


def _refused(c: Attitude, config: Any, loop: Any, x: Any, failed: Any, status: int) -> None:
    """Nothing is written."""
    out = Result()
    ct.memset(ct.byref(out), 0x55, ct.sizeof(out))
    before = bytes(out), bytes(loop)
    assert c.step(config, loop, x, failed, out) == status
    assert (bytes(out), bytes(loop)) == before


@pytest.mark.parametrize("member", ["attitude", "V", "phi", "phi_dot"])
def test_an_estimate_that_is_no_number_is_refused(c: Attitude, member: str) -> None:
    x = state(np.random.default_rng(2), (1, 0, 0, 0))
    getattr(x, member)[1] = math.nan
    _refused(c, c.config(), begun(c, c.config(), (1, 0, 0, 0)), x, None, NOT_FINITE)


def test_a_slew_waits_for_the_end_of_the_one_before(c: Attitude) -> None:
    config = c.config()
    loop = begun(c, config, (1, 0, 0, 0), (0, 1, 0, 0))
    goal = numbers(0, 0, 1, 0)
    assert c.call("slew", ct.byref(config), goal, ct.byref(loop)) == BAD_ARGUMENT
    loop.tick = math.ceil(loop.course.duration / config.period)
    assert c.call("slew", ct.byref(config), goal, ct.byref(loop)) == OK
    np.testing.assert_allclose(loop.course.start[:], (0, 1, 0, 0), atol=1e-15)
    assert c.call("slew", ct.byref(config), numbers(1, 0, 0, 0.1), ct.byref(loop)) == BAD_ARGUMENT
    loop.tick = 10**6
    assert c.call("slew", ct.byref(config), numbers(1, 0, 0, 0.1), ct.byref(loop)) == RANGE
    assert c.call("slew", ct.byref(config), numbers(math.nan, 0, 0, 1), ct.byref(loop)) == NOT_FINITE


def test_with_no_wheel_left_the_torques_are_zero_and_it_says_so(c: Attitude) -> None:
    config = c.config()
    for way in (1, 2):
        loop, out = begun(c, config, (1, 0, 0, 0)), Result()
        x = state(np.random.default_rng(4), (0.999, math.sqrt(1 - 0.999**2), 0, 0))
        assert c.step(config, loop, x, (way,) * N, out) == UNREACHABLE
        assert out.tau[:] == [0.0] * N
        assert out.share == 0.0
        assert list(loop.integral) == [0.0] * 3  # it waits


ARCSEC = 4.84813681109536e-06  # rad


def numbers_in(line: str) -> list[float]:
    return [float(text) for text in re.findall(r"\d+\.\d+", line)]


@pytest.mark.parametrize(("real", "failure"), quick(1, [("double", "coasts"), ("float", "held")]))
def test_a_slew_a_failed_wheel_and_the_momentum(real: str, failure: str, tmp_path: Path) -> None:
    """The error is within 1 arcsec after the slew, torques and speeds within the motors, 1 N m s falls to 0.5 %."""
    printed = example(written(exported(real, LoopOptions(failure=failure)), tmp_path))  # type: ignore[arg-type]
    assert printed["failures"] == "failures 0"
    assert numbers_in(printed["slew"])[0] == 30.0
    largest, after, last = numbers_in(printed["pointing"])
    assert max(after, last) < 1.0
    assert largest < 150.0
    for wheel in stand().flywheels:
        torque, share, speed = numbers_in(printed[f"flywheel {wheel.name}"])
        assert torque < 0.1 and share < 60.0 and 10.0 < speed < 628.0
    begin, left, seconds = numbers_in(printed["momentum"])
    assert begin == pytest.approx(1.0, abs=1e-3)
    assert left < 5e-3
    assert seconds == pytest.approx(1 / 0.05 + 30, rel=0.5)
    assert printed["samples with a demand out of reach"].endswith(" 0")


def test_motors_with_a_curve_stay_within_it(tmp_path: Path) -> None:
    """The curve has a tenth of the torque of the file, and half of that at half the speed."""
    curve = {"torque_speed": [[0, 0.01], ["3000 rpm", 0.005], ["6000 rpm", 0]], "viscous": 2e-6, "coulomb": 5e-4}
    curved = mahovik.example("eye4").replace({"rw*.motor": curve})
    printed = example(written(attitude_sources(curved, DEFAULT, "double"), tmp_path))
    assert printed["failures"] == "failures 0"
    for wheel in stand().flywheels:
        torque, share, _ = numbers_in(printed[f"flywheel {wheel.name}"])
        assert 0.001 < torque < 0.01 and 20.0 < share <= 100.0


def seconds_of_coasting(config: Any, speed: float) -> float:
    """How long a flywheel without drive turns on: J w' = -(viscous w + coulomb), from `speed` in rad/s to rest."""
    inertia = stand().flywheels[1].inertia[0][0]
    viscous, coulomb = config.viscous[1], config.coulomb[1]
    return float(inertia / viscous * np.log1p(viscous * speed / coulomb))


@settings(max_examples=3, deadline=None)
@example_of(85)  # the slew ends while the failed flywheel still coasts
@given(st.integers(0, 2**32 - 1))
def test_it_turns_from_any_attitude_to_any_other(c: Attitude, seed: int) -> None:
    """With an error of some degrees at first, and perhaps a failed flywheel: the plant is the balanced stand.

    The error is read 90 s after the slew is over and a coasting flywheel is at rest. As that comes to rest, the others
    pass through zero speed, where their friction turns round and costs tens of arcsec for a quarter of a minute.
    """
    rng = np.random.default_rng(seed)
    config = c.config(period=0.1, slew_rate=0.02, slew_acceleration=1e-3)
    begin, goal = (v / np.linalg.norm(v) for v in rng.normal(size=(2, 4)))
    near = (law.rotation(begin) * Rotation.from_rotvec(rng.normal(size=3) * 0.02)).as_quat()
    failed = tuple(int(s == 1) * int(rng.integers(3)) for s in range(N))
    x, loop, out = State(), Loop(), Result()
    x.attitude[:] = near[[3, 0, 1, 2]]
    x.phi_dot[:] = (60.0, -60.0, 60.0, -60.0)
    assert c.call("reset", ct.byref(config), numbers(*begin), ct.byref(loop)) == 0
    assert c.call("slew", ct.byref(config), numbers(*goal), ct.byref(loop)) == 0
    moves = max(loop.course.duration, seconds_of_coasting(config, 60.0) if failed[1] == 1 else 0.0)
    errors = []
    for _ in range(int((moves + 90.0) / config.period)):
        assert c.step(config, loop, x, failed, out) >= 0
        speed, tau = np.array(x.phi_dot), np.array(out.tau)
        most = np.where(tau * speed > 0, 0.1 * (1 - np.abs(speed) / 628.3185307), 0.1)
        assert np.all(np.abs(tau) <= most * (1 + 1e-9))
        assert c.play(x, tau - law.friction(config, speed), failed, np.array(out.moment), config.period) >= 0
        errors.append(np.linalg.norm(out.demand.error[:]))
    assert max(errors[-300:]) < ARCSEC
    assert (law.rotation(goal).inv() * law.rotation(x.attitude)).magnitude() < ARCSEC
    assert np.linalg.norm(out.momentum[:]) < 5e-3


def test_a_held_carrier_is_refused_with_what_to_use_instead() -> None:
    stand = replace(load(path("eye4")), hold=Hold((), (0, 0, 0), (0, 0, 0), (0, 0, 0)))
    with pytest.raises(UsageError) as told:
        design_attitude(stand, LoopOptions())
    assert str(told.value) == (
        'attitude: "eye4": hold: the loop demands a task, which a held carrier does not have; turn it by '
        "`inverse_fast` and `torque` of its C, as docs/held/turn.c does, or take [hold] out"
    )


@pytest.mark.parametrize(
    ("text", "options", "message"),
    [
        (
            "",
            LoopOptions(task="pointin"),
            r'attitude task pointin: stand "eye4" has no such task, did you mean "pointing"\?',
        ),
        (
            ('rows = ["wx", "wy", "wz"]', 'rows = ["wx", "wy"]'),
            LoopOptions(),
            "its rows are wx, wy; .* expected wx, wy, wz",
        ),
        (('rows = ["wx", "wy", "wz"]', 'rows = ["vx", "vy", "vz"]'), LoopOptions(), "expected wx, wy, wz"),
        (("[task.pointing]", "[task.other]"), LoopOptions(task="pointing"), "has no such task"),
        ("", LoopOptions(rate=5.0, bandwidth=1.0), "too slow for a bandwidth of 1 Hz; expected 20.9 Hz or more"),
        ("", LoopOptions(momentum=3.0), r"above 70 % of its no-load speed; expected at most 1\.\d+ N m s"),
        ("", LoopOptions(momentum=float("nan")), "attitude momentum nan: expected"),
        ("", LoopOptions(bandwidth=0.0), "attitude bandwidth 0: expected a number above 0"),
    ],
)
def test_wishes_that_cannot_be_met_are_refused(
    text: tuple[str, str] | str, options: LoopOptions, message: str, tmp_path: Path
) -> None:
    with pytest.raises(UsageError, match=message):
        attitude_sources(_changed(text, tmp_path), options, "double")


def _changed(text: tuple[str, str] | str, folder: Path) -> Stand:
    source = path("eye4").read_text(encoding="utf-8")
    file = folder / "eye4.toml"
    file.write_text(source.replace(*text) if text else source, encoding="utf-8")
    return load(file)


def test_stands_without_a_task_or_enough_axes_are_refused() -> None:
    with pytest.raises(UsageError, match="no task: add"):
        attitude_sources(load(path("bench8")), LoopOptions(), "double")
    whole = load(path("eye4"))
    with pytest.raises(UsageError, match="the spin axes of its flywheels do not span space"):
        attitude_sources(replace(whole, flywheels=whole.flywheels[:2]), LoopOptions(), "double")


def test_clang_32_bits_cpp_and_bare_objects(tmp_path: Path) -> None:
    source = written(exported("float"), tmp_path) / "eye4_attitude.c"
    check_delivered(source, tmp_path, {"eye4_torque_for_pointing", "eye4_momentum", "eye4_default_options"}, "TR")
    user = tmp_path / "user.cpp"
    user.write_text('#include "eye4_attitude.h"\n' * 2)
    run(require("g++", "g++"), "-std=c++17", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-fsyntax-only", user)


def test_three_wheels_of_which_one_fails_are_refused() -> None:
    whole = load(path("eye4"))
    three = replace(whole, flywheels=whole.flywheels[1:])
    with pytest.raises(
        UsageError, match=r'without its first flywheel "rw2" .* expected a fourth flywheel, or failure=none'
    ):
        design_attitude(three, LoopOptions(momentum=0.1))
    assert design_attitude(three, LoopOptions(momentum=0.1, failure="none")).samples


def test_motors_without_limits_are_told() -> None:
    whole = load(path("eye4"))
    free = replace(whole, flywheels=tuple(replace(wheel, motor=None) for wheel in whole.flywheels))
    assert any(
        "no torque of rw1, rw2, rw3, rw4 is bounded" in line for line in design_attitude(free, LoopOptions()).lines
    )
