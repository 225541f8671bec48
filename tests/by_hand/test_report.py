"""Figures of the report's tables of bodies, of a stand whose numbers are set one by one.

A wheel of mass `m` with the static unbalance `U` has its centre of mass `e = U / m` from the axis; at `W` rad/s its
force is `U W^2`, its moment `D W^2` by the dynamic unbalance `D`, and `e W` is what grades of balance bound.

A carrier with the moments 1, 2, 3 whose principal axes are turned by 30 degrees about z has `R diag(1, 2, 3) R^T`.
A wheel mounted by the angles (0, 0, a) has its first axis along x, and its second turned from y to z by a.
"""

from __future__ import annotations

import re
from html import unescape
from math import cos, pi, radians, sin

import pytest

import mahovik
from by_hand.stands import stand, wheel
from mahovik.out.report.stand import bodies
from mahovik.out.report.stand.material import WORDS, Material, chosen_state

Row = list[float | str]
W = 2 * pi * 50.0  # 3000 rpm


def rows_of(html: str) -> list[Row]:
    """Rows of all bodies of tables."""
    bodies_of = "".join(re.findall(r"<tbody>(.*?)</tbody>", html, re.DOTALL))
    rows = re.findall(r"<tr.*?</tr>", bodies_of, re.DOTALL)
    return [[number(cell) for cell in re.findall(r"<t[dh][^>]*>(.*?)</t[dh]>", row, re.DOTALL)] for row in rows]


def tables(of: mahovik.Stand) -> dict[str, list[Row]]:
    """Rows of the tables of bodies by the heading before them."""
    made = bodies.section(Material(of, chosen_state(of), WORDS))
    assert made is not None
    parts = [part.split("</h3>") for part in made.html.split("<h3>")[1:]]
    return {title: rows_of(html) for title, html in parts}


def number(html: str) -> float | str:
    """A figure as a number, other cells as their words."""
    text = re.sub(r"·10<sup>(.*?)</sup>", r"e\1", html)
    text = re.sub("[\u202f\u2007\u2008]", "", unescape(re.sub("<[^>]*>", "", text))).replace("−", "-")
    try:
        return float(text)
    except ValueError:
        return text


def test_flywheels_and_drives() -> None:
    static, dynamic, at = 3e-3, 4e-6, radians(40.0)  # kg m, kg m2, rad
    unbalance = {"static": static, "static_at": at, "dynamic": dynamic, "dynamic_at": at}
    motor = {"torque": 0.2, "speed": "3000 rpm", "constant": 0.05, "coulomb": 0.003, "viscous": 2e-5}
    encoder = {"counts": 4096, "latency": "250 us"}
    across = [0.013, 0.011]
    made = tables(stand(wheel("w", transverse_inertia=across, unbalance=unbalance, motor=motor, encoder=encoder)))
    row = made["Flywheels"][0]
    assert row[:4] == ["w", 0.02, pytest.approx(0.012), pytest.approx(3000.0)]  # g mm of the static unbalance
    assert row[4] == pytest.approx(1e9 * dynamic, rel=1e-3)
    assert row[5] == pytest.approx(1e9 * dynamic, rel=1e-3)  # the centre of mass is in the plane of the origin
    assert row[6] == pytest.approx(1e9 * 0.002, rel=1e-3)
    expected = [3000.0, static * W**2, dynamic * W**2, 1e3 * static / 2.0 * W]
    assert row[8:] == pytest.approx(expected, rel=1e-3)
    assert made["Drives and encoders"] == [["w", 0.2, 3000.0, 0.05, 0.003, 2e-5, 4096.0, 250.0]]


def test_the_second_axis_is_turned_by_the_third_angle_of_the_mounting() -> None:
    a = radians(50.0)
    turned = wheel("w", angles=[0.0, 0.0, a])
    row = tables(stand({key: value for key, value in turned.items() if key not in ("axis", "zero")}))
    assert row["Axes of the flywheels"][0][4:] == pytest.approx([1.0, 0.0, 0.0, 0.0, cos(a), sin(a)], abs=1e-4)


def test_principal_axes_of_the_whole() -> None:
    c, s = cos(radians(30.0)), sin(radians(30.0))
    tensor = [[c * c + 2 * s * s, -c * s, 0.0], [-c * s, s * s + 2 * c * c, 0.0], [0.0, 0.0, 3.0]]
    rows = tables(stand(carrier={"inertia": tensor}))["Inertia of the whole"]
    assert [row[1:4] for row in rows] == [pytest.approx(line, abs=1e-4) for line in tensor]
    assert [row[4] for row in rows] == [1.0, 2.0, 3.0]
    for line, axis in zip((row[5:] for row in rows), ([c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]), strict=True):
        sign = 1.0 if sum(float(a) * b for a, b in zip(line, axis, strict=True)) > 0 else -1.0
        assert [sign * float(x) for x in line] == pytest.approx(axis, abs=1e-4)
