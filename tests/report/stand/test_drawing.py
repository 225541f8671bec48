"""The drawing is to scale, and the solids in it have the mass properties of their bodies."""

import re
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

import numpy as np
import pytest
from hypothesis import assume, given, settings
from pytest import approx

from mahovik.core.stand import load
from mahovik.core.stand.inertia import inertia_about_center
from mahovik.core.stand.model import Stand
from mahovik.out.report.stand.drawing import basis, draw
from mahovik.out.report.stand.shape import Disc, shape_of
from mahovik.stands import path
from strategies import stands

SVG = "{http://www.w3.org/2000/svg}"


def attribute(element: Element, name: str) -> str:
    """An attribute that the element has."""
    found = element.get(name)
    assert found is not None
    return found


def parsed_drawing(stand: Stand) -> Element:
    """The drawing of a stand, parsed."""
    return ElementTree.fromstring(draw(shape_of(stand))[0])


@settings(max_examples=25)
@given(stands(max_flywheels=6))
def test_any_stand_can_be_drawn(stand: Stand) -> None:
    """Well-formed, finite, inside its frame, in colours of the page alone."""
    markup, left_out = draw(shape_of(stand))
    root = ElementTree.fromstring(markup)
    width, height = (float(x) for x in attribute(root, "viewBox").split()[2:])
    assert left_out == 0
    assert "nan" not in markup
    assert "inf" not in markup
    assert set(re.findall(r"(?:fill|stroke):([^;\"]+)", markup)) <= {"none"} | {
        f"var(--{name})" for name in re.findall(r"var\(--(\w+)\)", markup)
    }
    for each in root.iter(f"{SVG}ellipse"):
        assert -1 <= float(attribute(each, "cx")) <= width + 1
        assert -1 <= float(attribute(each, "cy")) <= height + 1


@pytest.mark.parametrize("name", ["bench8", "sat4", "remus6"])
def test_distances_are_to_scale(name: str) -> None:
    """Faces of the first and the last flywheel in the front view, by the scale bar."""
    stand = load(path(name))
    shape, root = shape_of(stand), parsed_drawing(stand)
    front = next(g for g in root.iter(f"{SVG}g") if g.get("aria-label") == "front")
    faces = {}
    for g in front.iter(f"{SVG}g"):
        title, face = g.find(f"{SVG}title"), g.find(f"{SVG}ellipse")
        if title is not None and face is not None:
            faces[title.text] = np.array([float(attribute(face, "cx")), float(attribute(face, "cy"))])
    bar = [attribute(path_, "d") for path_ in root.findall(f"{SVG}path")][:5]
    ends = [float(x) for d in bar for x in re.findall(r"[ML](-?[\d.]+) ", d)]
    words = next(t.text for t in root.findall(f"{SVG}text") if t.text and re.fullmatch(r"[\d.]+ m?m", t.text))
    number, unit = words.split()
    scale = (max(ends) - min(ends)) / (float(number) * (1e-3 if unit == "mm" else 1.0))
    right, depth, up = basis(shape)

    def nearest_face(disc: Disc) -> np.ndarray:
        side = 1.0 if disc.C[:, 0] @ -depth >= 0 else -1.0
        return np.asarray(disc.center + side * disc.thickness / 2 * disc.C[:, 0])

    first, last = shape.flywheels[0], shape.flywheels[-1]
    distance = nearest_face(last) - nearest_face(first)
    found = faces[last.name] - faces[first.name]
    assert found == approx([scale * distance @ right, -scale * distance @ up], abs=0.5)


@settings(max_examples=20)
@given(stands(min_flywheels=1, max_flywheels=4))
def test_a_disc_has_the_spin_inertia_of_its_flywheel(stand: Stand) -> None:
    """m R^2/2 along the axis; across it m (3 R^2 + h^2)/12, where a cylinder can have as little."""
    for disc, body in zip(shape_of(stand).flywheels, stand.flywheels, strict=True):
        J = inertia_about_center(body)
        assert body.mass * disc.radius**2 / 2 == approx(J[0, 0], rel=1e-9)
        assume(disc.thickness > 0.0)
        assert body.mass * (3 * disc.radius**2 + disc.thickness**2) / 12 == approx((J[1, 1] + J[2, 2]) / 2, rel=1e-9)
