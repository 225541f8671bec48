"""Outlines of the drawing as the browser fills them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest

from mahovik.out.report.stand.projection import Projection

if TYPE_CHECKING:
    from playwright.sync_api import Browser

pytestmark = pytest.mark.slow

INSIDE = """([d, points]) => {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  const path = document.createElementNS("http://www.w3.org/2000/svg", "path");
  path.setAttribute("d", d);
  svg.append(path);
  document.body.append(svg);
  return points.map(([x, y]) => path.isPointInFill(new DOMPoint(x, y)));
}"""


def test_a_cylinder_fills_its_silhouette(browser: Browser) -> None:
    """Every place of both rims is inside the outline, moved a little inwards, and none outside, moved outwards."""
    page = browser.new_page()
    page.set_content("<p></p>")
    rng = np.random.default_rng(4)
    view = Projection(np.array([1.0, 0.0, 0.0]), np.array([0.0, 0.0, 1.0]), 1000.0, (300.0, 200.0))
    for _ in range(20):
        C = np.linalg.qr(rng.normal(size=(3, 3)))[0]
        radius, half = rng.uniform(0.03, 0.1), rng.uniform(0.0, 0.05)
        angle = np.linspace(0.0, 2 * np.pi, 24, endpoint=False)
        rim = radius * (np.outer(np.cos(angle), C[1]) + np.outer(np.sin(angle), C[2]))
        near, far = half * C[0], -half * C[0]
        if C[0] @ view.towards < 0:
            near, far = far, near
        outline = view.cylinder(near, far, C[0], radius)
        for face in (near, far):
            places = [view.point(face + 0.97 * x).tolist() for x in rim]
            assert all(page.evaluate(INSIDE, [outline, places]))
        outwards = 1.04 * np.array([view.rows @ (face + x) for face in (near, far) for x in rim])
        hull = np.abs(outwards @ _perpendicular(view, C[0])) > 1.02 * 1000.0 * radius
        outside = [p + np.array(view.at) for p, out in zip(outwards, hull, strict=True) if out]
        assert not any(page.evaluate(INSIDE, [outline, [p.tolist() for p in outside]]))
    page.close()


def _perpendicular(view: Projection, axis: np.ndarray) -> np.ndarray:
    """Unit vector of the paper across the axis as it is seen."""
    u = view.rows @ axis
    return np.asarray(np.array([-u[1], u[0]]) / np.hypot(*u))
