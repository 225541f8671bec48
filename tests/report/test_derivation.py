"""`mahovik derive`: the page stands alone, the article is whole, and their numbers are those of the reference."""

from __future__ import annotations

import re
import subprocess
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pytest

from mahovik import __version__
from mahovik.core.stand import Stand, State, load
from mahovik.core.stand.hold import twists
from mahovik.core.stand.identity import identities
from mahovik.core.stand.random import Features, random_stand, random_state
from mahovik.out.report.derivation.numbers import numbers
from mahovik.out.report.derivation.page import html, latex
from mahovik.proof.reference.evaluate import evaluate
from mahovik.use.simulate.held import home
from report.stand.reports import read
from toolchain.quick import quick
from toolchain.tools import require

STANDS = Path(__file__).resolve().parents[2] / "generator" / "mahovik" / "stands"


def stand(name: str) -> Stand:
    """An example stand."""
    return load(STANDS / f"{name}.toml")


def general(flywheels: int, seed: int = 1) -> Stand:
    """A stand with everything."""
    everything = Features(
        angles="euler",
        instruments=2,
        gravity=True,
        stream=False,
        fluid=True,
        points=1,
        wrench_inputs=True,
        motors=False,
        laws={"suspension": 1, "leg": 1},
    )
    return random_stand(np.random.default_rng(seed), flywheels, everything)


@pytest.mark.parametrize(
    "example", [general(0), pytest.param(stand("auv6"), marks=pytest.mark.slow)], ids=["rigid", "auv6"]
)
def test_page_stands_alone(example: Stand) -> None:
    """Well-formed, no external resource, both identities and the version, no date; the article is ASCII."""
    page, article = html(example), latex(example)
    parsed = read(page)
    assert parsed.wrong == []
    assert all(value.startswith("#") for _, key, value in parsed.attributes if key in ("src", "href", "data", "srcset"))
    assert not re.search(r"https?:|url\(|@import|<link|<img|<iframe|\b(19|20)\d\d-\d\d-\d\d\b", page)
    assert article.isascii()
    found = identities(example)
    for text in (found.structure, found.physics, f"mahovik {__version__}"):
        assert text in page and text in article
    assert page.count("<details") == len(example.flywheels)
    for element in re.findall(r"<math.*?</math>", page, re.DOTALL):
        ET.fromstring(element)


@pytest.mark.slow
@pytest.mark.parametrize("example", [stand("auv6"), general(3)], ids=["auv6", "general"])
def test_article_compiles_without_overfull_lines(example: Stand, tmp_path: Path) -> None:
    """Nothing runs out of the page."""
    require("pdflatex", "texlive-latex-base")
    (tmp_path / "stand.tex").write_text(latex(example), encoding="ascii")
    command = ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "stand.tex"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False, timeout=120)
    assert done.returncode == 0, done.stdout[-2000:]
    assert "Overfull" not in done.stdout


class AtPhase:
    """The matrices of (8) put together from the numbers that the page shows."""

    def __init__(self, example: Stand, state: State) -> None:
        self.found = numbers(example)
        omega, v = np.array(state.V[3:]), np.array(state.V[:3])
        Phi = np.block([[cross(omega), np.zeros((3, 3))], [cross(v), cross(omega)]])
        self.K = np.array(self.found.K_constant)
        self.K_dot = np.zeros((6, 6))
        columns, rates = [], []
        for own, phi, speed in zip(self.found.flywheels, state.phi, state.phi_dot, strict=True):
            waves = np.array([1, np.cos(phi), np.sin(phi), np.cos(2 * phi), np.sin(2 * phi)])
            turning = waves * np.array([0, 1, 1, 1, 1])
            rows = [np.array(q.rows) for q in own.quantities]
            mu, J, J_prime, I1, I2, I1_prime, I2_prime = rows
            self.K += inertia(mu @ turning, J @ turning)
            self.K_dot += inertia(I1 @ waves, J_prime @ waves) * speed
            I = np.concatenate([I1 @ waves, I2 @ waves])
            columns.append(I)
            rates.append(Phi @ I + np.concatenate([I1_prime @ waves, I2_prime @ waves]) * speed)
        self.I, self.J = np.array(columns).T, np.array(rates).T
        self.M = Phi @ self.K + self.K_dot


def cross(a: np.ndarray) -> np.ndarray:
    """<a>."""
    return np.array([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]])


def inertia(mu: np.ndarray, J: np.ndarray) -> np.ndarray:
    """{0, -<mu>; <mu>, J} with J as 11 22 33 12 13 23."""
    tensor = np.array([[J[0], J[3], J[4]], [J[3], J[1], J[5]], [J[4], J[5], J[2]]])
    return np.block([[np.zeros((3, 3)), -cross(mu)], [cross(mu), tensor]])


@pytest.mark.parametrize("seed", quick(1, range(2)))
def test_numbers_give_the_matrices_of_the_reference(seed: int) -> None:
    """K, K*, M, I, J of (8) from the tables of the page, at random states, against the literal reference."""
    example = general(4, seed)
    state = random_state(example, np.random.default_rng(seed))
    wanted = evaluate(example, state, ["matrices"])
    shown = AtPhase(example, state)
    for name in ("K", "K_dot", "M", "I", "J"):
        own, expected = getattr(shown, name), wanted[name]
        # sums of a few dozen products of the same size: rounding only
        assert np.max(np.abs(own - expected)) <= 1e-12 * np.max(np.abs(expected)), name


@pytest.mark.slow
def test_a_held_carrier_has_a_section_on_its_hold() -> None:
    """The mass matrix is that of the reference; a clamped carrier has an equation alone, a free one no section."""
    folder = STANDS.parents[2] / "docs" / "held"
    cube, clamped = (load(folder / f"{name}.toml") for name in ("cube", "force_table"))
    found = numbers(cube).hold
    assert found is not None
    K = evaluate(cube, home(cube), ["matrices"])["K"]
    assert cube.hold is not None
    S = twists(cube.hold)
    assert np.allclose(np.array(found.mass), S.T @ K @ S, rtol=1e-13)
    for text in (html(cube), latex(cube)):
        assert "3 freedoms" in text
    assert latex(clamped).count("section{Hold") == 1 and "The carrier is clamped" in html(clamped)
    assert numbers(stand("demo3")).hold is None and "Hold" not in latex(stand("demo3"))
