"""The drawing is to scale, its names can be read, its colours are the page's."""

import re
from dataclasses import replace
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

import numpy as np
import pytest
from hypothesis import given, settings
from pytest import approx

from mahovik.core.stand import load
from mahovik.core.stand.model import Stand
from mahovik.core.stand.random import Features, random_stand
from mahovik.out.report.stand.drawing import basis, draw, section
from mahovik.out.report.stand.material import gather
from mahovik.out.report.stand.projection import Box, Places
from mahovik.out.report.stand.shape import Disc, shape_of
from mahovik.stands import names, path
from strategies import stands

SVG = "{http://www.w3.org/2000/svg}"


def html_of(stand: Stand, file: str) -> str:
    """The section of the report with the drawing."""
    found = section(gather(stand, file))
    assert found is not None
    return found.html


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


@pytest.mark.parametrize("name", names())
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


def test_up_is_against_gravity() -> None:
    """z down in remus6, z up in bench8; a view is never a mirror image."""
    for name, up in (("remus6", [0, 0, -1]), ("bench8", [0, 0, 1])):
        axes = basis(shape_of(load(path(name))))
        assert axes[2] == approx(up)
        assert np.linalg.det(axes) == approx(1.0)


def test_names_do_not_cover_one_another() -> None:
    """64 flywheels have their numbers, or are counted as left out."""
    rng = np.random.default_rng(2)
    shape = shape_of(random_stand(rng, 64, Features(points=2, instruments=2)))
    markup, left_out = draw(shape)
    root = ElementTree.fromstring(markup)
    for view in (g for g in root.iter(f"{SVG}g") if g.get("aria-label")):
        boxes = []
        for t in view.findall(f"{SVG}text"):
            if t.get("text-anchor") == "middle":
                x, y, half = float(attribute(t, "x")), float(attribute(t, "y")), 3.1 * len(t.text or "")
                boxes.append((x - half, y - 9.0, x + half, y + 2.0))
        assert len(boxes) + left_out >= 64 + 2 + 2
        for i, (x0, y0, x1, y1) in enumerate(boxes):
            assert Box(x0, y0, x1, y1).overlap(np.array(boxes[:i]).reshape(-1, 4)) < 1.0


def test_places_run_out() -> None:
    """In a frame with room for one name there is none for a second."""
    places = Places(Box(0.0, 0.0, 40.0, 30.0), [])
    at, away = np.array([10.0, 15.0]), np.array([1.0, 0.0])
    assert places.find("w1", at, away, 2.0) is not None
    assert places.find("a name that is long", at, away, 2.0) is None


def test_names_beside_one_another_do_not_touch() -> None:
    places = Places(Box(0.0, 0.0, 300.0, 60.0), [])
    found = [places.find(f"w{k}", np.array([150.0, 30.0]), np.array([1.0, 0.0]), 2.0) for k in range(6)]
    boxes = [box for box in found if box is not None]
    assert len(boxes) >= 4
    for i, a in enumerate(boxes):
        for b in boxes[:i]:
            level = a.y0 < b.y1 and b.y0 < a.y1
            assert not level or max(b.x0 - a.x1, a.x0 - b.x1) >= 3.0


def test_the_text_says_what_is_drawn() -> None:
    """Equivalent shapes are named as such; signs that are not there are not explained."""
    html = html_of(load(path("bench8")), "bench8.toml")
    assert "equivalent ellipsoid of inertia" in html
    assert "third-angle projection" in html
    assert "suspension" in html
    assert "centre of buoyancy" not in html


def test_names_are_escaped() -> None:
    """A name of a point comes from a file."""
    stand = load(path("sat4"))
    stand = replace(stand, points=(replace(stand.points[0], name="<b>&"),))
    assert "<b>&" not in html_of(stand, "sat4.toml")
