"""Sections of the report: the numbers are those of the stand, zeros and rounding are distinguished."""

from __future__ import annotations

import math
import re
from dataclasses import replace

import numpy as np
import pytest

from mahovik.core.stand import load
from mahovik.core.stand.capacity import torque_capacity
from mahovik.core.stand.inertia import inertia_about_center
from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.core.stand.summary import summarize
from mahovik.core.stand.whole import mass_properties
from mahovik.out.report.stand import bodies, campbell, envelopes, jitter, matrices, response
from mahovik.out.report.stand.markup import figure, table
from mahovik.out.report.stand.material import WORDS, Material, choose_state, chosen_state
from mahovik.proof import reference
from mahovik.stands import names, path
from mahovik.use.study.response.periodic import periodic_response
from mahovik.use.study.response.scene import Scene
from report.stand.reports import plain, read, words
from report.stand.runs import run_through


def material(stand: Stand, state: State | None = None) -> Material:
    return Material(stand, state or chosen_state(stand), WORDS)


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0.0, "0"), (-0.0, "0"), (1.0, "1"), (-12.5, "−12.5"), (0.00012345678, "0.00012346"),
        (123456.7, "123\u202f457"), (1234.5678, "1234.6"), (9.999999, "10"), (1e7, "1·10<sup>7</sup>"),
        (-2.5e-9, "−2.5·10<sup>−9</sup>"), (math.inf, "∞"), (-math.inf, "−∞"), (math.nan, "–"),
    ],
)  # fmt: skip
def test_a_figure_is_printed_as_one_writes_it(value: float, text: str) -> None:
    assert figure(value) == text


def test_products_of_inertia_total_inertia_and_axes_are_shown() -> None:
    stand = load(path("bench8"))
    made = bodies.section(material(stand))
    assert made is not None
    assert all(f"J<sub>{ij}</sub>" in made.html for ij in ("12", "13", "23"))
    whole = mass_properties(stand)
    mass, center, tensor = whole.mass, np.array(whole.center_of_mass), np.array(whole.inertia)
    K = reference.evaluate(stand, replace(chosen_state(stand), phi=(0.0,) * len(stand.flywheels)), ["matrices"])["K"]
    shift = mass * (center @ center * np.eye(3) - np.outer(center, center))
    assert np.allclose(tensor + shift, K[3:, 3:], rtol=1e-12, atol=1e-15)
    text = plain(made.html)
    assert f"{tensor[0, 0]:.5g}" in text[text.index("Inertia of the whole") :]
    assert "Axes of the flywheels" in text


def test_cells_are_escaped() -> None:
    html = table(("a<b>", "n, kg>"), [[["<script>", "&"]]], "x<y")
    assert "<script>" not in html
    assert "a&lt;b" in html
    assert "x&lt;y" in html
    assert 'scope="col">n<br><span class="unit">kg</span>' in html
    assert read(html).wrong == []


def cells_of(text: str, name: str, count: int) -> list[float]:
    """The numbers that follow a name in a text; a dash is no number."""
    cells = text.partition(f" {name} ")[2].split()[:count]
    return [math.nan if cell == "–" else float(re.sub(r"·10(-?\d+)", r"e\1", cell)) for cell in cells]


@pytest.mark.parametrize("name", names())
def test_numbers_of_flywheels_are_those_of_their_bodies(name: str) -> None:
    stand = load(path(name))
    made = bodies.section(material(stand))
    assert made is not None
    text = plain(made.html)
    for row, body in zip(summarize(stand).unbalance, stand.flywheels, strict=True):
        numbers = cells_of(text[text.index("Transverse: the mean") :], row.name, 11)
        J, c = inertia_about_center(body), np.array(body.center_of_mass)
        J = J + body.mass * (c @ c * np.eye(3) - np.outer(c, c))
        eccentricity = math.hypot(c[1], c[2])
        assert numbers[:2] == pytest.approx([J[0, 0], (J[1, 1] + J[2, 2]) / 2], rel=1e-3)
        assert numbers[2] == pytest.approx(1e6 * body.mass * eccentricity, rel=1e-2, abs=1e-6)
        assert numbers[3] == pytest.approx(1e9 * row.dynamic, rel=1e-2, abs=1e-6)
        assert numbers[7] == pytest.approx(row.speed * 30 / math.pi, rel=1e-3)
        assert numbers[10] == pytest.approx(1e3 * eccentricity * row.speed, rel=1e-2, abs=1e-6)


def test_drives_have_their_numbers_in_the_order_of_the_head() -> None:
    stand = load(path("eye4"))
    motor = stand.flywheels[0].motor
    made = bodies.section(material(stand))
    assert made is not None and motor is not None and motor.speed is not None
    text = plain(made.html)
    text = text[text.index("Drives and encoders") :]
    assert "flywheel torqueN m no-load speedrpm constantN m/A CoulombN m viscousN m s counts per turn latencyµs" in text
    torque, speed, _, coulomb, viscous, _, latency = cells_of(text, stand.flywheels[0].name, 7)
    assert (torque, speed) == pytest.approx((motor.torque, motor.speed * 30 / math.pi), rel=1e-4)
    assert (coulomb, viscous) == pytest.approx((motor.coulomb, motor.viscous), rel=1e-4)
    encoder = stand.flywheels[0].encoder
    assert encoder is not None and latency == pytest.approx(1e6 * encoder.latency, rel=1e-4)


def numbers_of(html: str, caption: str) -> list[float]:
    """The numbers of the matrix with that caption, row by row; dots and rounding are zero."""
    start = html.index(caption)
    body = html[start : html.index("</figure>", start)]
    cells = [words(c) for c in re.findall(r'<td class="[^"]*">(.*?)</td>', body[body.index("<tbody>") :])]
    powers = [c.replace("−", "-").replace("\u202f", "") for c in cells]
    return [0.0 if c in ("·", "≈0") else float(re.sub(r"·10(-?\d+)", r"e\1", c)) for c in powers]


@pytest.mark.parametrize("name", ["bench8", "auv6", "demo3"])
def test_matrices_are_those_of_the_reference(name: str) -> None:
    stand = load(path(name))
    state = chosen_state(stand)
    made = matrices.section(material(stand, state))
    assert made is not None
    found = reference.evaluate(stand, state, ["matrices"]) | reference.evaluate(stand, state, ["generalized"])
    captions = {
        "K": "#equation-2", "K_dot": "#equation-6", "M": "#equation-9", "A": "#equation-10", "I0": "#equation-11",
    }  # fmt: skip
    for key, caption in captions.items():
        values = np.asarray(found[key]).ravel()
        shown = numbers_of(made.html[made.html.index("<h3>Carrier") :], caption)
        assert shown == pytest.approx(values.tolist(), rel=6e-4, abs=1e-9 * np.abs(values).max())


def test_the_state_of_a_run_at_rest_is_not_shown() -> None:
    """Rounding would stand there as if it were structure; a row that moves is shown as it is."""
    stand = load(path("bench8"))
    moving = replace(chosen_state(stand), angles=None, quaternion=(1.0, 0.0, 0.0, 0.0))
    rest = replace(moving, V=(1e-17,) * 6, phi_dot=(0.0,) * len(stand.flywheels))
    at_rest, said = choose_state(stand, run_through(stand, [moving, rest]))
    assert at_rest == chosen_state(stand)
    assert said == f"the last row of the run, t = 0.01 s, is at rest; shown instead: {WORDS}"
    for last in (moving, replace(moving, V=(0.0,) * 6), replace(rest, V=(1e-6, 0.0, 0.0, 0.0, 0.0, 0.0))):
        shown, said = choose_state(stand, run_through(stand, [rest, last]))
        assert (shown.V, shown.phi_dot) == (last.V, last.phi_dot)
        assert said == "the last row of the run, t = 0.01 s"


def test_vibration_of_a_satellite_is_that_of_the_periodic_state() -> None:
    stand = load(path("sat4"))
    limit = max(row.speed for row in summarize(stand).unbalance)
    ((swept,),) = response._sweeps(stand, limit, [(name, None) for name in response.measured_points(stand)])
    assert swept.point == stand.points[0].name
    size, speed = response._largest(swept)
    assert speed == pytest.approx(limit)  # nothing resonates
    found = periodic_response(Scene.of(stand), [limit] * 4, [swept.point]).points[swept.point]
    spectrum = found.harmonics("acceleration")
    assert size == pytest.approx(np.linalg.norm(spectrum[1:]) / np.sqrt(2.0), rel=1e-9)
    shown = jitter.section(material(stand))
    assert shown is not None and shown.html.count('<figure class="chart"') == 4
    assert "arcsec RMS over all phases at acc1" in shown.summary


def test_envelopes_of_a_satellite_have_all_facets() -> None:
    stand = load(path("sat4"))
    shown = envelopes.section(material(stand))
    assert shown is not None
    assert shown.html.count("<title>") == 2 * 2 * len(torque_capacity(stand).envelope.facets)
    assert "326.6 mN m in every direction" in shown.summary and "19.596" in shown.html  # N m s in every direction


def test_sections_without_anything_to_show_say_why_or_are_left_out() -> None:
    bare = replace(load(path("demo3")), flywheels=())
    assert [each.section(material(bare)) for each in (response, jitter, envelopes, campbell)] == [None] * 4
    for name, words_ in (("demo3", "Nothing shakes O1"), ("remus6", "no static equilibrium")):
        shown = response.section(material(load(path(name))))
        assert shown is not None and words_ in shown.html and "<figure" not in shown.html
        assert jitter.section(material(load(path(name)))) is None
