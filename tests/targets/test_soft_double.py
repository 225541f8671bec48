"""What docs/targets.md says of sums of doubles by software: the library of gcc for Arm rounds some the wrong way."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import pytest

from mahovik.core.toolchain import board
from targets.boards import target
from toolchain.quick import quick

A, B = float.fromhex("0x1.1528dff976422p-99"), float.fromhex("-0x1p-66")
PROGRAM = """
#include "board.h"
int main(void)
{
    volatile double a = 0x1.1528dff976422p-99, b = -0x1p-66, sum = a + b;
    board_print(sum == -0x1.fffffffeead72p-67 ? "nearest" : sum == -0x1.fffffffeead73p-67 ? "wrong way" : "other");
    return 0;
}
"""


def test_the_nearest_double_is_the_one_of_this_machine() -> None:
    """Exact arithmetic says so: its neighbour is farther away."""
    exact = Fraction(A) + Fraction(B)
    right, wrong = (Fraction(float.fromhex(f"-0x1.fffffffeead{end}p-67")) for end in ("72", "73"))
    assert right == A + B
    assert abs(right - exact) < abs(wrong - exact)


@pytest.mark.parametrize(
    ("name", "answer"),
    quick(
        2, [("m4", "wrong way"), ("m7", "nearest"), ("m3", "wrong way"), ("m33", "wrong way"), ("rv32imac", "nearest")]
    ),
)
def test_sums_by_software_on_a_cortex(name: str, answer: str, tmp_path: Path) -> None:
    """Where a newer library rounds right, this test says so: then the row of the page goes."""
    chosen = target(name)
    assert board.run(chosen, board.build(chosen, {"sum.c": PROGRAM}, tmp_path, extra=("-Wno-float-equal",))) == answer
