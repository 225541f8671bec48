"""The drawing is to scale, and the solids in it have the mass properties of their bodies."""

from __future__ import annotations

import numpy as np
from hypothesis import assume, given, settings
from pytest import approx

from mahovik.core.stand.masses import inertia_about_center
from mahovik.core.stand.model import Stand
from mahovik.out.report.drawing import disc, draw_stand, ellipsoid
from strategies import stands


@settings(max_examples=12)
@given(stands(max_flywheels=6))
def test_any_stand_can_be_drawn(stand: Stand) -> None:
    """All views have one scale, and what is drawn lies in its frame; every flywheel has its name in the legend."""
    figure, _ = draw_stand(stand)
    figure.canvas.draw()
    top, front, side = figure.axes
    names = [text.get_text() for text in figure.legends[0].get_texts()]
    assert {s.name for s in stand.flywheels} | {"carrier", "centre of mass of the whole"} <= set(names)
    assert (
        top.get_xlim() == front.get_xlim() and front.get_ylim() == side.get_ylim() and top.get_ylim() == side.get_xlim()
    )
    scales = [np.ptp(axes.get_window_extent().intervalx) / np.ptp(axes.get_xlim()) for axes in (top, front, side)]
    assert scales == approx([scales[0]] * 3, rel=1e-6)
    assert not figure.legends[0].get_window_extent().overlaps(top.get_window_extent())
    for axes in (top, side):
        assert np.all(axes.dataLim.min >= np.array([axes.get_xlim()[0], axes.get_ylim()[0]]))
        assert np.all(axes.dataLim.max <= np.array([axes.get_xlim()[1], axes.get_ylim()[1]]))


@settings(max_examples=20)
@given(stands(min_flywheels=1, max_flywheels=4))
def test_a_disc_has_the_spin_inertia_of_its_flywheel(stand: Stand) -> None:
    """m R^2/2 along the axis; across it m (3 R^2 + h^2)/12, where a cylinder can have as little."""
    for body in stand.flywheels:
        shown = disc(stand, body, 0.01)
        J = inertia_about_center(body)
        assert body.mass * shown.radius**2 / 2 == approx(J[0, 0], rel=1e-9)
        assume(shown.thickness > 0.0)
        assert body.mass * (3 * shown.radius**2 + shown.thickness**2) / 12 == approx((J[1, 1] + J[2, 2]) / 2, rel=1e-9)


@settings(max_examples=20)
@given(stands(max_flywheels=1))
def test_an_ellipsoid_has_the_inertia_of_its_body(stand: Stand) -> None:
    """m/5 (E tr(A A^T) - A A^T), A its semi-axes in columns."""
    axes = ellipsoid(stand.carrier)
    square = axes @ axes.T
    J = stand.carrier.mass / 5 * (np.trace(square) * np.eye(3) - square)
    assert np.allclose(J, inertia_about_center(stand.carrier), atol=1e-9 * np.abs(J).max())
