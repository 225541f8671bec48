"""`mahovik report --derivation`: the page stands alone, the numbers are the reference's."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pytest

from mahovik import __version__
from mahovik.core.derive.carrying import weight
from mahovik.core.derive.document import Formula, Table, sections, symbol
from mahovik.core.stand import Stand, State, load
from mahovik.core.stand.random import Features, random_stand, random_state
from mahovik.core.stand.structure import identities
from mahovik.out.commands.report import report
from mahovik.out.report.derivation import document
from mahovik.proof.reference.evaluate import evaluate
from report.reports import read
from toolchain.quick import quick

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
def test_page_stands_alone(example: Stand, tmp_path: Path) -> None:
    """Well-formed, no external resource, both identities and the version, no date."""
    report(example, output=tmp_path / "d.html", derivation=True)
    page = (tmp_path / "d.html").read_text(encoding="utf-8")
    parsed = read(page)
    assert parsed.wrong == []
    assert all(value.startswith("#") for _, key, value in parsed.attributes if key in ("src", "href", "data", "srcset"))
    without_names = re.sub(r'xmlns="[^"]*"', "", page)
    assert not re.search(r"https?:|url\(|@import|<link|<img|<script|\b(19|20)\d\d-\d\d-\d\d\b", without_names)
    names = identities(example)
    assert f"mahovik {__version__}" in page
    for text in (names.structure, names.physics):
        assert text in page
    for element in re.findall(r"<math.*?</math>", page, re.DOTALL):
        ET.fromstring(element)


@pytest.mark.parametrize("added", [False, True])
def test_no_two_symbols_look_the_same(added: bool) -> None:
    """It compares names of the table of the C, indices of symmetric and square matrices, and rates."""
    names = {"m", "phi_dot", "phi_ddot", "mu", "c", "s", "c2", "s2", "dc", "ds", "dc2", "ds2", "ddc", "dds", "two_c2"}
    names |= {f"{name}[{k}]" for name in ("J", "J_c", "J_2c", "J_2s", "A_inv", "S") for k in range(6)}
    names |= {f"{name}[{k}]" for name in ("R", "C", "G", "U", "B") for k in range(9)}
    names |= {
        f"{name}[{k}]" for name in ("mu", "mu_c", "mu_s", "t_0", "t_c", "O", "omega", "omega_dot") for k in range(3)
    }
    assert len({symbol(name) for name in names}) == len(names)
    assert symbol("J_2c[3]") == "J^{2c}_{12}" and symbol("q[0]") == "q_{0}" and symbol("phi_dot") == r"\dot{\varphi}"
    shown = sections("euler", added_mass=added, weight=weight(added), displaces=added)
    assert "_" not in re.sub(
        r"_(\w|\{\w+\}|\\\w+)", "", " ".join(b.tex for x in shown for b in x.blocks if isinstance(b, Formula))
    )


def cell(text: str) -> float:
    """A number of the page."""
    return float(re.sub(r"\\cdot 10\^\{(.*?)\}", r"e\1", text) or 0.0)


def matrix(tex: str) -> np.ndarray:
    """A matrix of numbers of the page."""
    body = tex[tex.index(r"\begin{bmatrix}") + 15 : tex.index(r"\end{bmatrix}")]
    return np.array([[cell(text.strip()) for text in row.split("&")] for row in body.split(r"\\")])


def shown_matrices(example: Stand, state: State) -> tuple[np.ndarray, np.ndarray]:
    """K and I at a state, from the tables of the page alone."""
    numbers = {section.title: section.blocks for section in document(example)}
    (K_c,) = (b.tex for b in numbers["Numbers: mass matrix"] if isinstance(b, Formula) and b.tex.startswith("K_c"))
    K, columns = matrix(K_c), []
    tables = [b for b in numbers["Numbers: flywheels"] if isinstance(b, Table)]
    for table, phi in zip(tables, state.phi, strict=True):
        rows = np.array([[cell(text) for text in row[1:]] for row in table.rows])
        waves = np.array([1, np.cos(phi), np.sin(phi), np.cos(2 * phi), np.sin(2 * phi)])
        rates = np.array([0, -np.sin(phi), np.cos(phi), 0, 0])
        mu, J, t = rows[:3] @ waves, rows[3:9] @ waves, rows[9:] @ waves
        K += inertia(mu, J)
        columns.append(np.concatenate([rows[:3] @ rates, t]))
    return K, np.array(columns).T


def cross(a: np.ndarray) -> np.ndarray:
    """<a>."""
    return np.array([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]])


def inertia(mu: np.ndarray, J: np.ndarray) -> np.ndarray:
    """{0, -<mu>; <mu>, J} with J as 11 22 33 12 13 23."""
    tensor = np.array([[J[0], J[3], J[4]], [J[3], J[1], J[5]], [J[4], J[5], J[2]]])
    return np.block([[np.zeros((3, 3)), -cross(mu)], [cross(mu), tensor]])


@pytest.mark.parametrize("seed", quick(1, range(2)))
def test_numbers_give_the_matrices_of_the_reference(seed: int) -> None:
    """K and I of (8) from the tables of the page agree with the literal reference at random states."""
    example = general(4, seed)
    state = random_state(example, np.random.default_rng(seed))
    wanted = evaluate(example, state, ["matrices"])
    for shown, name in zip(shown_matrices(example, state), ("K", "I"), strict=True):
        # six digits are shown
        assert np.max(np.abs(shown - wanted[name])) <= 2e-5 * np.max(np.abs(wanted[name])), name


@pytest.mark.slow
def test_a_held_carrier_has_a_section_on_its_hold() -> None:
    """A clamped carrier has words alone, a free one no section."""
    folder = STANDS.parents[2] / "docs" / "held"
    cube, clamped = (load(folder / f"{name}.toml") for name in ("cube", "force_table"))
    hold = next(section for section in document(cube) if section.title == "Hold")
    projected = next(b.tex for b in hold.blocks if isinstance(b, Formula) and b.tex.startswith("S^T K S ="))
    assert matrix(projected).shape == (3, 3) and np.all(np.linalg.eigvalsh(matrix(projected)) > 0.0)
    assert [section.title for section in document(clamped)].count("Hold") == 1
    assert "Hold" not in [section.title for section in document(stand("demo3"))]
