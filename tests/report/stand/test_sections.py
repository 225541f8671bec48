"""Sections of the report: the numbers are those of the stand, zeros and rounding are distinguished."""

from __future__ import annotations

import math
import re
from dataclasses import replace

import numpy as np
import pytest

from mahovik.core.stand import load
from mahovik.core.stand.capacity import torque_capacity
from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.core.stand.summary import summarize
from mahovik.core.stand.whole import mass_properties
from mahovik.out.report.stand import bodies, campbell, envelopes, jitter, matrices, response
from mahovik.out.report.stand.markup import figure, table
from mahovik.out.report.stand.material import WORDS, Material, choose_state, chosen_state
from mahovik.out.report.stand.matrices import SHADES, Side, matrix
from mahovik.proof import reference
from mahovik.stands import names, path
from mahovik.use.study.response.periodic import periodic_response
from mahovik.use.study.response.scene import Scene
from report.stand.reports import read, words
from report.stand.runs import run_through


def material(stand: Stand, state: State | None = None) -> Material:
    return Material(stand, state or chosen_state(stand), WORDS)


def plain(html: str) -> str:
    """Text with ordinary minus signs, without thin spaces and those that align numbers."""
    return words(re.sub("[\u202f\u2007\u2008]", "", html)).replace("−", "-")


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


def test_zero_rounding_and_numbers_are_told_apart() -> None:
    values, scale = np.array([[0.0, 1e-16], [2.0, -1.0]]), np.ones((2, 2))
    html = matrix("M", values, scale, Side((("r", ("1", "2")),)), Side((("a", ("1",)), ("b", ("2",)))))
    assert [words(cell) for cell in re.findall(r"<td class[^>]*>.*?</td>", html)] == ["·", "≈0", "2", "−1"]
    assert html.count('class="edge') == 4  # heading, name and two numbers right of the line between blocks
    assert f'"p{SHADES}"' in html
    assert f'"edge n{SHADES}"' in html


@pytest.mark.parametrize("name", names())
def test_unbalance_is_that_of_check(name: str) -> None:
    stand = load(path(name))
    made = bodies.section(material(stand))
    assert made is not None
    text = plain(made.html)
    for row in summarize(stand).unbalance:
        numbers = re.search(rf"{row.name} ((?:[-\d.·]+ ){{4}})", text[text.index("Transverse: the mean") :])
        assert numbers is not None
        spin, _, static, dynamic = numbers[1].split()
        assert float(spin) == pytest.approx(row.spin_inertia, rel=1e-3)
        assert float(static) == pytest.approx(1e6 * row.static, rel=1e-2, abs=1e-6)
        assert float(dynamic) == pytest.approx(1e9 * row.dynamic, rel=1e-2, abs=1e-6)


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


def test_terms_of_the_balance_sum_to_what_is_left() -> None:
    """F - M V - J phi' - I phi'' = K V*, in the numbers shown."""
    stand = load(path("auv6"))
    made = matrices.section(material(stand))
    assert made is not None
    html = made.html[made.html.index("Balance of (8)") :]
    rows = [
        [float(re.sub(r"·10<sup>(.*?)</sup>", r"e\1", cell).replace("−", "-").replace("\u202f", "")) for cell in cells]
        for line in re.findall(r"<tr><th[^>]*scope=\"row\">.*?</tr>", html, re.DOTALL)
        if (cells := [c.replace("−", "-") for c in re.findall(r'<td class="right">(.*?)</td>', line)])
    ]
    F, MV, J, I, KV, _ = np.array(rows)
    size = np.abs(rows).max(axis=0)
    assert np.abs(F + MV + J + I - KV) == pytest.approx(np.zeros(6), abs=float(2e-3 * size.max()))


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
