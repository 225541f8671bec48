"""Figures of the report's tables, of a stand whose numbers are set one by one.

At `W` rad/s a static unbalance `U` makes a force `U W^2`, a dynamic one `D` a moment `D W^2`.
"""

from __future__ import annotations

import re
from html import unescape
from math import cos, pi, radians, sin

import pytest

from by_hand.stands import SPIN, stand, wheel
from mahovik.core.stand.masses import placement
from mahovik.out.commands.check import check
from mahovik.out.commands.report import bodies_part, limits_part
from mahovik.out.report.page import Part

W = 2 * pi * 50.0  # 3000 rpm


def rows_of(html: str) -> list[list[float | str]]:
    """Rows of all bodies of tables: figures as numbers, other cells as their words."""
    rows = re.findall(r"<tr>(.*?)</tr>", "".join(re.findall(r"<tbody>(.*?)</tbody>", html, re.DOTALL)), re.DOTALL)
    return [[number(cell) for cell in re.findall(r"<td[^>]*>(.*?)</td>", row, re.DOTALL)] for row in rows]


def number(html: str) -> float | str:
    """A figure as a number, other cells as their words."""
    text = unescape(re.sub("<[^>]*>", "", html))
    try:
        return float(text)
    except ValueError:
        return text


def row_of(part: Part | None, first: str) -> list[float]:
    """The numbers of the last row with this first cell in a part of the page."""
    assert part is not None
    row = [row for row in rows_of(str(part.markup)) if row[0] == first][-1]
    return [cell for cell in row if isinstance(cell, float)]


def test_unbalance_of_a_flywheel() -> None:
    static, dynamic = 3e-3, 4e-6  # kg m, kg m2
    motor = {"torque": 0.2, "speed": "3000 rpm"}
    made = stand(wheel("w", transverse_inertia=0.011, unbalance={"static": static, "dynamic": dynamic}, motor=motor))
    part = bodies_part(made, check(made))
    expected = [200.0, 1e6 * static, 1e7 * dynamic, 0.0, 3000.0, static * W**2, dynamic * W**2]
    assert row_of(part, "w") == pytest.approx(expected, rel=1e-3)


def test_limits_of_a_motor() -> None:
    """Momentum and torque of one wheel lie along its axis alone."""
    part = limits_part(check(stand(wheel("w", motor={"torque": 0.2, "speed": "3000 rpm"}))))
    assert row_of(part, "momentum") == pytest.approx([0.0, 0.0, SPIN * W, 0.0], rel=1e-4)
    assert row_of(part, "torque") == pytest.approx([0.0, 0.0, 0.2, 0.0], rel=1e-4)


def test_the_second_axis_is_turned_by_the_third_angle_of_the_mounting() -> None:
    """A wheel with the angles (0, 0, a) has its first axis along x, its second turned from y to z by a."""
    a = radians(50.0)
    turned = {key: value for key, value in wheel("w", angles=[0.0, 0.0, a]).items() if key not in ("axis", "zero")}
    (body,) = stand(turned).flywheels
    assert placement(body)[1][:, :2].T.ravel().tolist() == pytest.approx([1.0, 0.0, 0.0, 0.0, cos(a), sin(a)])
