"""Published cases of balancing, repeated to the digits printed."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest

import mahovik
from balance.published import BRUEL_KJAER, FEESE, GOODMAN, KELM, TURBOGENERATOR, solved
from mahovik.use.balance.influence import read_influence, read_polar


def numbers(texts: Sequence[str]) -> np.ndarray:
    return np.array([read_polar(text) for text in texts])


def test_bruel_kjaer_17_227() -> None:
    """J. Vaughan, Static and Dynamic Balancing, Brüel & Kjær 17-227, example 4: two planes."""
    result = mahovik.balance(influence=BRUEL_KJAER).to_dict()
    assert result["w"] == ["1.979@236.2", "1.071@121.8"]
    assert result["left"] == ["0@0", "0@0"]


def test_feese_grazier() -> None:
    """T. D. Feese, P. E. Grazier, Balance This!, Turbomachinery Symposium 2004: two planes, trial weights stay on."""
    result = mahovik.balance(influence=FEESE)
    assert [f"{abs(x):.1f}@{np.degrees(np.angle(x)) % 360:.0f}" for x in result["corrections"]] == ["15.3@3", "6.6@113"]
    trial = numbers(["11.1@35", "3.7@135"])
    assert np.allclose(numbers(result["add"]), result["corrections"] - trial, atol=0.02)


def test_kelm_pavelek() -> None:
    """R. Kelm, D. Pavelek, Rotor Balancing Tutorial, Turbomachinery Symposium 2016: 17.5 at 230, 30.3 at 0, by hand.

    Influences are printed with two digits, so amplitudes agree to 3 %. The angle of their second plane is 8 degrees off
    the least squares of the printed figures: theirs leaves more.
    """
    solution, ((problem,), _) = solved(KELM), read_influence(KELM)
    assert abs(solution.w) == pytest.approx([17.5, 30.3], rel=0.03)
    printed = problem.A + problem.alpha @ numbers(["17.5@230", "30.3@0"])
    assert np.linalg.norm(solution.left) < np.linalg.norm(printed)


def test_goodman() -> None:
    """T. P. Goodman, A Least-Squares Method for Computing Balance Corrections, 1964: his example, and its min-max.

    First his least squares, 0.81 and 1.48. The limit of his weights is min-max: three equal amplitudes.
    """
    assert solved(GOODMAN).w.real == pytest.approx([0.81, 1.48], abs=0.005)
    best = solved(GOODMAN, "min-max")
    assert np.ptp(np.abs(best.left)) < 1e-6 * np.abs(best.left).max()


def test_foiles_min_max() -> None:
    """Foiles, Allaire, Gunter: four planes, eleven vibrations; their weights are those of min-max."""
    solution, ((problem,), _) = solved(TURBOGENERATOR, "min-max"), read_influence(TURBOGENERATOR)
    printed = numbers(["4.42@88", "2.92@352", "1.588@322", "1.928@304"])
    assert np.abs(solution.w - printed).max() < 0.03 * np.abs(printed).max()
    theirs = np.abs(problem.A + problem.alpha @ printed).max()
    assert np.abs(solution.left).max() <= theirs
    assert solution.bound == pytest.approx(np.abs(solution.left).max(), rel=1e-6)
