"""verify --cost: figures that repeat, agree with one another, and hold the limits that are promised."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from typing import Any

import pytest

from cli.run import BENCH8, DEMO3, refused, run
from mahovik.core.stand import load
from mahovik.errors import UsageError
from mahovik.proof import cost as measuring
from mahovik.proof.cost import Costs, FunctionCost, TargetCost, measure, page, parse_targets
from toolchain.tools import require, target


@pytest.fixture(scope="module")
def bench8() -> dict[tuple[str, str], TargetCost]:
    """Measured once for all tests of this file."""
    pairs = [(target("m4"), "float"), (target("m7"), "double")]
    return {(t.target, t.real): t for t in measure(load(BENCH8), pairs).targets}


def cost_of(cost: TargetCost, function: str) -> FunctionCost:
    return next(f for f in cost.functions if f.function == function)


LIMITS = [
    ("m7", "double", "forward", "instructions", 9000),
    ("m7", "double", "coupled", "instructions", 14000),
    ("m7", "double", "inverse_fast", "instructions", 20000),
    ("m7", "double", "forward", "code", 7 * 1024),
    ("m7", "double", "forward", "stack", 1331),
    ("m4", "float", "forward", "instructions", 9000),
    ("m4", "float", "forward", "code", 5 * 1024),
    ("m4", "float", "forward", "stack", 800),
]


@pytest.mark.slow
def test_promised_limits(bench8: dict[tuple[str, str], TargetCost]) -> None:
    """Limits for bench8 at -O2, on which the plan of a control loop's firmware rests."""
    for name, real, function, what, limit in LIMITS:
        assert 0 < getattr(cost_of(bench8[name, real], function), what) <= limit, (name, function, what)


@pytest.mark.slow
def test_painted_stack_confirms_the_frames(bench8: dict[tuple[str, str], TargetCost]) -> None:
    """A call never uses more than the deepest chain, routines of the library aside, and mostly just that."""
    for cost in bench8.values():
        for f in cost.functions:
            assert f.routines or f.painted <= f.stack, f.function
        assert sum(f.painted >= 0.9 * f.stack - 16 for f in cost.functions) >= len(cost.functions) - 2


@pytest.mark.slow
def test_figures_and_text_repeat(tmp_path: Path) -> None:
    """Measured twice, the same page and bytes."""
    target("m7")
    arguments = ("verify", DEMO3, str(tmp_path), "--cost", "--targets", "m7", "--real", "float")
    printed = run(*arguments)
    assert printed.exit_code == 0
    first = {file.name: file.read_bytes() for file in tmp_path.iterdir()}
    assert set(first) == {"COST.md"}
    assert run(*arguments).stdout == printed.stdout
    assert {file.name: file.read_bytes() for file in tmp_path.iterdir()} == first


def test_figures_of_the_host_agree_with_one_another(monkeypatch: pytest.MonkeyPatch) -> None:
    """At one state, by callgrind: a step of order 4 has twice the rates of one of order 2, and the parts add up."""
    require("valgrind", "valgrind")
    monkeypatch.setattr(measuring, "STATES", 1)
    progress = []
    measured = measure(
        load(DEMO3), [(target("host"), "double")], lambda *done: progress.append(done), ("step", "prepare_mounts"), True
    )
    (cost,), names = (
        measured.targets,
        ["step", "step(order=2)", "prepare_mounts", "recorder_step", "recorder_step(order=2)"],
    )
    assert progress == [(1, 1)] and [f.function for f in cost.functions] == names
    step, half, mounts, recorded, _ = cost.functions
    assert 1.8 < step.instructions / half.instructions < 2.1 and step.code == half.code <= cost.text
    assert recorded.instructions > step.instructions > mounts.instructions > 0
    assert recorded.stack > step.stack > cost_of(cost, "prepare_mounts").stack > 0
    assert cost.constants["demo3_default"] > 0 and cost.unnamed > 0
    text = page(measured)
    assert f"\n| `step` | {step.instructions:,} | {step.stack:,} |  | {step.code:,} |\n" in text


def test_the_page_tells_what_was_refused_and_what_the_compiler_adds() -> None:
    one = costs().targets[0].functions[0]
    text = page(costs(functions=(replace(one, instructions=0, routines=("__divdi3",)),)))
    assert "| `forward` | refused | 500 | 490 | 3,000* |" in text and "\nRefused: these states are none for it" in text
    assert "\n\\* and `__divdi3` of the compiler's library" in text


def costs(**changes: Any) -> Costs:
    one = FunctionCost("forward", 1000, 500, 490, 3000, ())
    cost = TargetCost(
        *("m7", "Cortex-M7", "double", "0" * 64, "gcc 1.2.3", "-O2", "qemu 7.2.0"),
        *((one,), 5000, {"demo3_default": 400}, 8),
    )
    return Costs("demo3", "0", "1", (replace(cost, **changes),))


@pytest.fixture
def rises(monkeypatch: pytest.MonkeyPatch) -> Callable[..., list[str]]:
    """Lines of the net about a function whose figures, or compiler, are others than the accepted ones."""
    monkeypatch.syspath_prepend(str(Path(__file__).parents[1] / "net"))
    net = import_module("processors")

    def lines(compiler: str = "gcc 1.2.3", **changes: Any) -> list[str]:
        (before,), (now,) = (costs(compiler="gcc 1.2.3").targets, costs(compiler=compiler).targets)
        now = replace(now, functions=(replace(now.functions[0], **changes),))
        both = ({"m7 double": net.accepted_costs(target)} for target in (before, now))
        return list(net.rises("demo3", *both))

    return lines


@pytest.mark.parametrize(("what", "old"), [("instructions", 1000), ("stack", 500), ("code", 3000)])
def test_a_rise_is_more_than_two_percent(what: str, old: int, rises: Callable[..., list[str]]) -> None:
    assert rises(**{what: old + old // 50}) == []
    (line,) = rises(**{what: old + old // 50 + 1})
    assert line.startswith(f"demo3: m7, double: forward, {what}: {old} accepted, now {old + old // 50 + 1}, 2.")


def test_another_compiler_is_not_compared(rises: Callable[..., list[str]]) -> None:
    said = ["demo3: m7, double: accepted figures are of gcc 1.2.3, this is gcc 9.9.9"]
    assert rises("gcc 9.9.9", instructions=9999) == said


def test_usage() -> None:
    with pytest.raises(UsageError, match='unknown "m8"'):
        parse_targets("m8", None)
    assert [(t.name, real) for t, real in parse_targets("m3,m4", None)] == [
        ("m3", "double"),
        ("m3", "float"),
        ("m4", "float"),
    ]
    assert "frames of the stack are known of gcc only" in refused("verify", DEMO3, "--cost", "--targets", "m7-clang")


@pytest.mark.slow
def test_a_step_of_identification_fits_a_cortex_m4f() -> None:
    """Twelve unbalances, six channels of an accelerometer and a gyro: at most 20,000 instructions."""
    stand = load(BENCH8)
    stand = replace(stand, name="bench6", flywheels=stand.flywheels[:6])
    (cost,) = measure(stand, [(target("m4"), "float")], only=("identify_step",)).targets
    assert 10_000 < cost_of(cost, "identify_step").instructions <= 20_000
