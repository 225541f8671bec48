"""Boards: every target starts, computes, counts, prints and ends; every way of not ending well is one line."""

from __future__ import annotations

from pathlib import Path

import pytest

from mahovik.core.toolchain import targets as targets_module
from mahovik.core.toolchain.targets import TARGETS, build, run
from mahovik.errors import ToolchainError
from toolchain.tools import EMBEDDED, QUICK, target

HELLO = """
#include "board.h"
static volatile double tenth = 0.1;
static volatile float third = 1.0f / 3.0f;
static int table[3] = { 1, 2, 3 };
static int zeroed[3];
int main(void)
{
    const double square = tenth * tenth;
    const float ninth = third * third;
    table[0] = table[1] + zeroed[2];
    board_print(square >= 0x1.47ae147ae147cp-7 && square <= 0x1.47ae147ae147cp-7 ? "double\\n" : "?\\n");
    board_print(ninth >= 0x1.c71c740000000p-4f && ninth <= 0x1.c71c740000000p-4f ? "float\\n" : "?\\n");
    board_print(table[0] == 2 && table[2] == 3 ? "data\\n" : "?\\n");
    return 0;
}
"""

COUNT = """
#include "board.h"
static void twice(unsigned long turns)
{
    unsigned long i;
    for (i = 0; i < turns; ++i) {
        __asm__ volatile("" : : : "memory");
    }
}
int main(void)
{
    unsigned long first, one, two;
    board_ticks();
    first = board_ticks();
    twice(100000);
    one = board_ticks() - first;
    first = board_ticks();
    twice(200000);
    two = board_ticks() - first;
    board_print(one >= 100000 && one < 500000 ? "plausible\\n" : "?\\n");
    board_print(two > 2 * one - 200 && two < 2 * one + 200 ? "linear\\n" : "?\\n");
    return 0;
}
"""

STACK = """
#include "board.h"
static int deep(int n)
{
    volatile unsigned char block[1000];
    block[0] = (unsigned char)n;
    block[999] = 1;
    return block[0] + block[999];
}
int main(void)
{
    unsigned long used;
    board_paint_stack();
    used = board_stack_used();
    board_print(used < 100 ? "nothing\\n" : "?\\n");
    board_paint_stack();
    (void)deep(1);
    used = board_stack_used();
    board_print(used >= 1000 && used < 1100 ? "a thousand\\n" : "?\\n");
    return 0;
}
"""


@pytest.mark.parametrize("name", [*EMBEDDED, "host", "aarch64", "m7-clang", "rv64gc-clang"])
def test_every_target_computes_and_prints(name: str, tmp_path: Path) -> None:
    """Startup has set up FPU, constants, variables; products are rounded as NumPy rounds them; text arrives."""
    machine = target(name)
    assert run(machine, build(machine, {"hello.c": HELLO}, tmp_path)).split() == ["double", "float", "data"]


@pytest.mark.parametrize("name", EMBEDDED)
def test_instructions_are_counted(name: str, tmp_path: Path) -> None:
    """One (M55) to five instructions a turn of an empty loop; twice the turns, twice the instructions."""
    machine = target(name)
    assert run(machine, build(machine, {"count.c": COUNT}, tmp_path)).split() == ["plausible", "linear"]


@pytest.mark.parametrize("name", ["m3", "m7", "rv32gc", "rv64gc"])
def test_painted_stack(name: str, tmp_path: Path) -> None:
    """An empty program uses no stack; a block of 1000 bytes is measured."""
    machine = target(name)
    assert run(machine, build(machine, {"stack.c": STACK}, tmp_path)).splitlines() == ["nothing", "a thousand"]


CRASH = "int main(void) { return *(volatile int *)0xF0000000u + *(volatile int *)0x60000001u; }\n"


@pytest.mark.parametrize("name", ["m4", "rv32gc"])
def test_a_crash_ends_in_the_fault_handler(name: str, tmp_path: Path) -> None:
    machine = target(name)
    with pytest.raises(ToolchainError, match=rf"^{name}: the program crashed \(fault handler\)$"):
        run(machine, build(machine, {"crash.c": CRASH}, tmp_path))


@pytest.mark.parametrize("name", QUICK)
def test_a_status_and_an_endless_loop_are_errors(name: str, tmp_path: Path) -> None:
    machine = target(name)
    with pytest.raises(ToolchainError, match=f"^{name}: the program ended with status 3$"):
        run(machine, build(machine, {"three.c": "int main(void) { return 3; }\n"}, tmp_path))
    endless = "static volatile int stop;\nint main(void) { while (stop == 0) { } return 0; }\n"
    with pytest.raises(ToolchainError, match=f"^{name}: no end within 1 s$"):
        run(machine, build(machine, {"three.c": endless}, tmp_path), timeout=1)


@pytest.mark.parametrize("name", TARGETS)
def test_a_missing_tool_says_what_installs_it(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The machine has no compiler."""
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(ToolchainError, match=r"make targets.*apt-get install") as caught:
        build(TARGETS[name], {"a.c": "int main(void) { return 0; }\n"}, tmp_path)
    assert all(package in str(caught.value) for package in TARGETS[name].packages)


def test_a_processor_without_the_instructions_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(targets_module, "_processor_flags", lambda: frozenset({"avx2", "fma"}))
    assert "avx512f" in TARGETS["host-gcc-v4"].obstacle()
    assert TARGETS["host"].obstacle() == ""


SUM = """
#include "board.h"
int main(void)
{
    volatile double a = 0x1.1528dff976422p-99, b = -0x1p-66, sum = a + b;
    board_print(sum == -0x1.fffffffeead72p-67 ? "nearest" : sum == -0x1.fffffffeead73p-67 ? "wrong way" : "other");
    return 0;
}
"""


@pytest.mark.parametrize(("name", "answer"), [("m4", "wrong way"), ("m7", "nearest"), ("rv32imac", "nearest")])
def test_sums_of_doubles_by_software(name: str, answer: str, tmp_path: Path) -> None:
    """The library of gcc for Arm rounds some the wrong way, as docs/c-interface.md says."""
    machine = target(name)
    assert run(machine, build(machine, {"sum.c": SUM}, tmp_path, extra=("-Wno-float-equal",))) == answer


def test_what_does_not_compile_is_one_line(tmp_path: Path) -> None:
    machine = target("m7")
    with pytest.raises(ToolchainError, match=r"^arm-none-eabi-gcc refused bad\.c: bad\.c:1:") as caught:
        build(machine, {"bad.c": "int main(void) { return missing; }\n"}, tmp_path)
    assert "\n" not in str(caught.value)
