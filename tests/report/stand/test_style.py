"""The stylesheet of the report: contrast of its colours, on paper, on the screen by day and by night."""

from __future__ import annotations

import re
from itertools import product

import pytest

from mahovik.core.emit.templates import template

SHEET = template("report.css.j2").render()
TEXT = ("ink", "muted", "accent", "good", "bad", "warn")
LINES = ("faint", *(f"c{i}" for i in range(1, 9)))
SHADES = [float(part) for part in re.findall(r"\.p\d \{ background: rgb\(var\(--above\) / ([.\d]+)\)", SHEET)]


def variables(block: str) -> dict[str, str]:
    """Custom properties of a block of declarations."""
    return dict(re.findall(r"--([\w-]+):\s*([^;]+);", block))


LIGHT = variables(SHEET[SHEET.index(":root {") : SHEET.index("}")])
DARK = [variables(found) for found in re.findall(r":root[^{\n]*\{([^{}]*--paper: #1[^{}]*)\}", SHEET)]
PRINT = LIGHT | variables(SHEET[SHEET.index("@media print") :])
SCHEMES = {"light": LIGHT, "dark": LIGHT | DARK[0], "print": PRINT}


def rgb(colour: str) -> tuple[float, ...]:
    """0..1, of #rgb, #rrggbb or three numbers."""
    if " " in colour:
        return tuple(int(part) / 255 for part in colour.split())
    digits = colour.lstrip("#")
    if len(digits) == 3:
        digits = "".join(2 * d for d in digits)
    return tuple(int(digits[i : i + 2], 16) / 255 for i in (0, 2, 4))


def luminance(colour: tuple[float, ...]) -> float:
    """Relative, of WCAG 2."""
    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in colour]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def contrast(one: tuple[float, ...], other: tuple[float, ...]) -> float:
    """Contrast ratio of WCAG 2, 1 to 21."""
    low, high = sorted((luminance(one), luminance(other)))
    return (high + 0.05) / (low + 0.05)


def test_contrast_of_black_and_white_is_that_of_the_standard() -> None:
    assert contrast(rgb("#000"), rgb("#ffffff")) == pytest.approx(21.0)
    assert contrast(rgb("#777777"), rgb("#fff")) == pytest.approx(4.48, abs=0.01)


def test_the_sheet_has_three_schemes() -> None:
    """Dark by the system and by the button are the same; the button can force either."""
    assert len(DARK) == 2
    assert DARK[0] == DARK[1]
    assert set(DARK[0]) == set(LIGHT)
    assert "(prefers-color-scheme: dark)" in SHEET
    assert ':root:not([data-theme="light"])' in SHEET
    assert "@media print" in SHEET
    assert luminance(rgb(PRINT["paper"])) == pytest.approx(1.0)


@pytest.mark.parametrize(("scheme", "paper"), list(product(SCHEMES, ("paper", "panel"))))
def test_text_and_lines_are_readable(scheme: str, paper: str) -> None:
    """Text 4.5, lines of drawings 3: WCAG 2 AA."""
    colours = SCHEMES[scheme]
    for names, least in ((TEXT, 4.5), (LINES, 3.0)):
        for name in names:
            found = contrast(rgb(colours[name]), rgb(colours[paper]))
            assert found >= least, f"{scheme}: {name} on {paper}: {found:.2f}"


@pytest.mark.parametrize("scheme", list(SCHEMES))
@pytest.mark.parametrize("side", ["above", "below"])
def test_numbers_are_readable_on_their_shades(scheme: str, side: str) -> None:
    colours = SCHEMES[scheme]
    assert len(SHADES) == 6
    for alpha in SHADES:
        mixed = tuple(
            alpha * c + (1 - alpha) * p for c, p in zip(rgb(colours[side]), rgb(colours["paper"]), strict=True)
        )
        assert contrast(rgb(colours["ink"]), mixed) >= 4.5
