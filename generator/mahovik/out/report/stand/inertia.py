"""Inertia of the whole stand and axes of its bodies, in axes of the carrier."""

from __future__ import annotations

import numpy as np
from markupsafe import Markup
from numpy.typing import NDArray

from mahovik.core.stand.frames import pose
from mahovik.core.stand.inertia import inertia_about_center
from mahovik.core.stand.model import Stand
from mahovik.core.stand.whole import mass_properties
from mahovik.out.report.stand.markup import Cell, figure, figures, paragraph, table

Array = NDArray[np.float64]

ROUNDING = 1e-12
"""Part of the largest of its kind below which a number is rounding."""


def inertia_table(stand: Stand) -> Markup:
    """Tensor of the whole, its principal moments and their axes."""
    whole = mass_properties(stand)
    tensor, axes = _clean(np.array(whole.inertia)), _clean(np.array(whole.principal_axes).T)
    columns = [figures(column) for column in (*tensor.T, whole.principal_inertia, *axes)]
    rows: list[list[Cell]] = [[name, *cells] for name, *cells in zip("123", *columns, strict=True)]
    head = ("axis", "J 1, kg m²>", "J 2>", "J 3>", "principal moment, kg m²>", "its axis: 1>", "2>", "3>")
    words = paragraph(
        "All bodies about their common mass centre, in axes of `E_1`, flywheels at phase zero, without added mass; a "
        "product of inertia carries its sign: the integral of −x y dm. Principal axes are unit vectors in `E_1`."
    )
    return Markup("<h3>Inertia of the whole</h3>\n") + words + table(head, [rows])


def products_table(stand: Stand) -> Markup:
    """Products of inertia of the bodies that have any."""
    found = []
    for body in stand.bodies:
        J = inertia_about_center(body)
        products = np.array([J[0, 1], J[0, 2], J[1, 2]])
        products[np.abs(products) <= ROUNDING * np.trace(J)] = 0.0
        if products.any():
            found.append((body.name, 1e6 * products))
    if not found:
        return Markup("")
    columns = [figures([float(products[k]) for _, products in found]) for k in range(3)]
    rows: list[list[Cell]] = [[name, *cells] for (name, _), *cells in zip(found, *columns, strict=True)]
    head = ("body", *(Markup("J<sub>{}</sub>, kg mm²>").format(ij) for ij in ("12", "13", "23")))
    words = paragraph("About the mass centre of each body, in its own axes, with their sign: integrals of −x y dm.")
    return Markup("<h3>Products of inertia</h3>\n") + words + table(head, [rows])


def axes_table(stand: Stand) -> Markup:
    """Origin, spin axis and second axis of each flywheel."""
    places = [pose(stand, body) for body in stand.flywheels]
    columns = [figures(_clean(np.array([1e3 * origin[k] for origin, _ in places])).tolist()) for k in range(3)]
    for which in (0, 1):
        columns += [[figure(float(_unit(C[k, which])), 4) for _, C in places] for k in range(3)]
    rows: list[list[Cell]] = [[s.name, *cells] for s, *cells in zip(stand.flywheels, *columns, strict=True)]
    head = ("flywheel", "origin x, mm>", "y>", "z>", "spin axis x>", "y>", "z>", "axis 2 x>", "y>", "z>")
    words = paragraph("Origins and unit vectors in axes of `E_1`, about `O_1`; the second axis is that at phase zero.")
    return Markup("<h3>Axes of the flywheels</h3>\n") + words + table(head, [rows])


def _unit(component: float) -> float:
    return 0.0 if abs(component) < ROUNDING else component


def _clean(values: Array) -> Array:
    """Rounding is zero."""
    return np.where(np.abs(values) > ROUNDING * np.abs(values).max(initial=0.0), values, 0.0)
