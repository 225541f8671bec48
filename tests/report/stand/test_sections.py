"""Sections of the report: the numbers are those of the stand, zeros and rounding are distinguished."""

from __future__ import annotations

import math
import re
from dataclasses import replace

import numpy as np
import pytest

from mahovik.core.stand import load
from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.core.stand.summary import summarize
from mahovik.core.stand.whole import mass_properties
from mahovik.out.report.stand import bodies, matrices
from mahovik.out.report.stand.markup import figure, figures, table
from mahovik.out.report.stand.material import WORDS, Material, choose_state, chosen_state
from mahovik.out.report.stand.matrices import SHADES, Side, matrix, shade
from mahovik.out.report.stand.page import ORDER
from mahovik.proof import reference
from mahovik.stands import names, path
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


def test_points_of_a_column_are_aligned() -> None:
    """Each number has its own significant digits, and after them the room of those of the others."""
    point, digit = "\N{PUNCTUATION SPACE}", "\N{FIGURE SPACE}"
    assert figures([12.0, 0.8, -0.751234567], 5) == [f"12{point}{5 * digit}", f"0.8{4 * digit}", "−0.75123"]
    assert figures([1.0, 2.0]) == ["1", "2"]
    assert figures([1e-9, 1.0]) == ["1·10<sup>−9</sup>", "1"]
    assert figures([]) == []


def test_small_and_large_numbers_of_a_table_keep_their_digits() -> None:
    html = table(("a", "n, kg m²>"), [[["x", figure(0.41970)], ["y", figure(0.00071234)]]], foot=["all", "12.5"])
    assert [len(cell) for cell in re.findall(r'<td class="right">(.*?)</td>', html)] == [10, 10, 11]
    assert "0.00071234" in html


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


def test_motion_comes_first_and_the_evidence_last() -> None:
    assert ORDER[:2] == ("histories", "programme") and ORDER[-3:] == ("matrices", "verification", "cost")


@pytest.mark.parametrize("value", [3.21987e-7, 0.98765432, 1.0e3, 54321.0, 9.99996e5])
def test_a_figure_reads_back_to_its_digits(value: float) -> None:
    text = str(figure(value)).replace("\u202f", "").replace("−", "-")
    read_back = float(re.sub(r"·10<sup>(.*)</sup>", r"e\1", text))
    assert read_back == pytest.approx(value, rel=5e-5)


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


def test_shades_rise_with_magnitude() -> None:
    found = [shade(10.0**-k, 1.0) for k in range(6)]
    assert found[0] == SHADES
    assert found == sorted(found, reverse=True)
    assert found[-1] == 1
    assert shade(0.0, 1.0) == 0


@pytest.mark.parametrize("name", names())
def test_sections_of_every_example_are_well_formed(name: str) -> None:
    found = material(load(path(name)))
    for made in (bodies.section(found), matrices.section(found)):
        assert made is not None
        assert read(made.html).wrong == []
        assert "nan" not in words(made.html)


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


def test_the_fluid_is_told() -> None:
    made = bodies.section(material(load(path("remus6"))))
    assert made is not None
    text = words(made.html)
    assert "Added mass of carrier: kg, kg m, kg m²" in text
    assert "damping of carrier" in text
    assert "light by" in text
    drives = bodies.section(material(load(path("sat4"))))
    assert drives is not None
    assert "Drives and encoders" in words(drives.html)
    assert "6000" in words(drives.html)


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


def test_many_flywheels_are_shown_as_rows() -> None:
    stand = load(path("bench8"))
    one = stand.flywheels[0]
    many = replace(stand, flywheels=tuple(replace(one, name=f"f{i}") for i in range(40)))
    made = matrices.section(material(many))
    assert made is not None
    assert "transposed" in words(made.html)
    few = matrices.section(material(stand))
    assert few is not None
    assert "transposed" not in words(few.html)


def test_a_singular_attitude_is_said() -> None:
    stand = load(path("bench8"))
    state = replace(chosen_state(stand), angles=None, quaternion=(math.sqrt(0.5), 0.0, math.sqrt(0.5), 0.0))
    made = matrices.section(material(stand, state))
    assert made is not None
    assert "Not shown: " in words(made.html)


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


def test_a_quaternion_gives_the_same_angles() -> None:
    stand = load(path("auv6"))
    state = chosen_state(stand)
    from scipy.spatial.transform import Rotation

    q = Rotation.from_euler("YZX", state.angles).as_quat(scalar_first=True)
    turned = replace(state, angles=None, quaternion=tuple(q.tolist()))
    assert matrices.with_angles(stand, turned).angles == pytest.approx(state.angles)


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
