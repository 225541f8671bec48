"""The attitude loop closed by the exact plant: slews, failed flywheels, momentum; what is refused."""

from __future__ import annotations

import ctypes as ct
import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import example as example_of
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from export import attitude_law as law
from export.attitudes import Attitude, Loop, N, Result, State, example, exported, numbers, stand, written
from mahovik.core.stand import load
from mahovik.core.stand.model import Hold, Stand
from mahovik.errors import UsageError
from mahovik.out.export.attitude import attitude_sources
from mahovik.stands import path
from mahovik.use.control.attitude import LoopOptions, design_attitude
from toolchain.quick import quick
from toolchain.tools import compile_c, compile_elsewhere, require, run, symbols_of

ARCSEC = 4.84813681109536e-06  # rad


def numbers_in(line: str) -> list[float]:
    return [float(text) for text in re.findall(r"\d+\.\d+", line)]


@pytest.mark.parametrize(("real", "failure"), quick(1, [("double", "coasts"), ("float", "held")]))
def test_a_slew_a_failed_wheel_and_the_momentum(real: str, failure: str, tmp_path: Path) -> None:
    """Within 1 arcsec after the slew and at the end; torques and speeds within the motors; 1 N m s down to 0.5 %."""
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


@pytest.fixture(scope="module")
def c(tmp_path_factory: pytest.TempPathFactory) -> Attitude:
    return Attitude(written(exported(), tmp_path_factory.mktemp("attitude")))


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
        'stand "eye4": hold: the loop demands a task, which a held carrier does not have; turn it by '
        "`inverse_fast` and `torque` of its C, as `turn.c` of docs/tutorial-held-examples.md does, or take [hold] out"
    )


@pytest.mark.parametrize(
    ("text", "options", "message"),
    [
        ("", LoopOptions(task="pointin"), r'--task pointin: stand "eye4" has no such task, did you mean "pointing"\?'),
        (
            ('rows = ["wx", "wy", "wz"]', 'rows = ["wx", "wy"]'),
            LoopOptions(),
            "its rows are wx, wy; .* expected wx, wy, wz",
        ),
        (('rows = ["wx", "wy", "wz"]', 'rows = ["vx", "vy", "vz"]'), LoopOptions(), "expected wx, wy, wz"),
        (("[task.pointing]", "[task.other]"), LoopOptions(task="pointing"), "has no such task"),
        ("", LoopOptions(rate=5.0, bandwidth=1.0), "too slow for a bandwidth of 1 Hz; expected 20.9 Hz or more"),
        ("", LoopOptions(momentum=3.0), r"above 70 % of its no-load speed; expected at most 1\.\d+ N m s"),
        ("", LoopOptions(momentum=float("nan")), "--momentum nan: expected"),
        ("", LoopOptions(bandwidth=0.0), "--bandwidth 0: expected a number above 0"),
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
    folder = written(exported("float"), tmp_path)
    source = folder / "eye4_attitude.c"
    compile_elsewhere(source)
    listed = symbols_of(source, folder)
    outside = {symbol for kind, symbol in listed if kind == "U"}
    assert outside <= {"memcpy", "memset", "eye4_torque_for_pointing", "eye4_momentum", "eye4_default_options"}
    assert {kind for kind, _ in listed} <= set("UTtRr")
    user = folder / "user.cpp"
    user.write_text('#include "eye4_attitude.h"\n' * 2)
    run(require("g++", "g++"), "-std=c++17", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-fsyntax-only", user)
    code = re.sub(r"/\*.*?\*/", "", source.read_text(), flags=re.DOTALL)
    assert "double" not in code


def test_a_header_of_another_stand_is_refused(tmp_path: Path) -> None:
    folder = written(exported(), tmp_path)
    header = folder / "eye4.h"
    header.write_text(re.sub(r"(PHYSICS +0x)[0-9a-f]{8}", r"\g<1>00000001", header.read_text()))
    with pytest.raises(AssertionError, match=r"eye4_attitude.h are of different stands"):
        compile_c(require("gcc", "gcc"), folder / "eye4_attitude.c", "-fsyntax-only")


def test_three_wheels_of_which_one_fails_are_refused() -> None:
    whole = load(path("eye4"))
    three = replace(whole, flywheels=whole.flywheels[1:])
    with pytest.raises(
        UsageError, match=r'without its first flywheel "rw2" .* expected a fourth flywheel, or --failure none'
    ):
        design_attitude(three, LoopOptions(momentum=0.1))
    assert design_attitude(three, LoopOptions(momentum=0.1, failure="none")).samples
