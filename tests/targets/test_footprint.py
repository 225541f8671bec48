"""Code, constants and stack of an object, against C whose figures can be counted by hand."""

from __future__ import annotations

from pathlib import Path

import pytest

from mahovik.core.toolchain.cost import STACK_FLAGS, Footprint, footprint
from mahovik.core.toolchain.targets import compile_one
from toolchain.tools import target

CHAIN = """
extern const int table[25];
const int table[25] = { 1 };
int leaf(int n);
int middle(int n);
int top(int n);
__attribute__((noinline)) int leaf(int n)
{
    volatile char block[400];
    block[n] = 1;
    return block[n];
}
__attribute__((noinline)) int middle(int n) { return leaf(n) + 1; }
__attribute__((noinline)) int top(int n)
{
    volatile char block[100];
    block[n] = 1;
    return middle(n) + leaf(n) + block[n];
}
"""


def measured_footprint(text: str, folder: Path, name: str = "m7") -> Footprint:
    machine = target(name)
    (folder / "it.c").write_text(text)
    return footprint(machine.compiler[0], compile_one(machine, "it.c", folder, "-O2", STACK_FLAGS))


@pytest.mark.parametrize("name", ["m7", "rv32gc", "host"])
def test_chains_tables_and_symbols(name: str, tmp_path: Path) -> None:
    footprint = measured_footprint(CHAIN, tmp_path, name)
    assert footprint.constants["table"] == 100
    assert footprint.with_calls("middle") == {"leaf", "middle"}
    red_zone = 128 if name == "host" else 0  # of x86-64: below the stack pointer, in no frame
    assert 400 - red_zone <= footprint.stack_of("leaf") < 450
    assert footprint.stack_of("top") == footprint.frames["top"] + footprint.frames["middle"] + footprint.frames["leaf"]
    assert footprint.code_of("top") == sum(footprint.code[name] for name in ("top", "middle", "leaf"))
    assert 0 <= footprint.text - sum(footprint.code.values()) < 64


def test_routines_of_the_library_are_named(tmp_path: Path) -> None:
    footprint = measured_footprint(
        "double half(double x);\ndouble half(double x) { return x * 0.3; }\n", tmp_path, "m3"
    )
    assert footprint.routines("half") == ["__aeabi_dmul"]
