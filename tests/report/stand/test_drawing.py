"""The drawing is to scale, and the solids in it have the mass properties of their bodies."""

import re
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

from hypothesis import assume, given, settings
from pytest import approx

from mahovik.core.stand.inertia import inertia_about_center
from mahovik.core.stand.model import Stand
from mahovik.out.report.stand.drawing import draw
from mahovik.out.report.stand.shape import shape_of
from strategies import stands

SVG = "{http://www.w3.org/2000/svg}"


def attribute(element: Element, name: str) -> str:
    """An attribute that the element has."""
    found = element.get(name)
    assert found is not None
    return found


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


@settings(max_examples=20)
@given(stands(min_flywheels=1, max_flywheels=4))
def test_a_disc_has_the_spin_inertia_of_its_flywheel(stand: Stand) -> None:
    """m R^2/2 along the axis; across it m (3 R^2 + h^2)/12, where a cylinder can have as little."""
    for disc, body in zip(shape_of(stand).flywheels, stand.flywheels, strict=True):
        J = inertia_about_center(body)
        assert body.mass * disc.radius**2 / 2 == approx(J[0, 0], rel=1e-9)
        assume(disc.thickness > 0.0)
        assert body.mass * (3 * disc.radius**2 + disc.thickness**2) / 12 == approx((J[1, 1] + J[2, 2]) / 2, rel=1e-9)
