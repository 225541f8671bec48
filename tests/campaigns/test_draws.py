"""What is drawn: distributions, grades, groups, correlations, designs, by SciPy, SALib and closed formulas."""

from __future__ import annotations

import itertools
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy import stats

import mahovik
from campaigns.files import RUN, read
from mahovik.out.campaign.report import variance_share
from mahovik.out.campaign.vary import DESIGNS, Design, _generator, grade_of, permissible_unbalance

Array = NDArray[np.float64]


def values(folder: Path, body: str, count: int = 4000) -> dict[str, Array]:
    """Numbers of the first samples of sat4, by path."""
    campaign = read(folder, body + RUN, stand="sat4", samples=count)
    return campaign.draw.values(campaign.design.unit(0, count))


LAWS: dict[str, Any] = {
    "{ normal = [3, 0.2] }": stats.norm(3, 0.2),
    "{ relative = 0.02 }": stats.norm(50.4, 0.02 * 50.4),
    '{ tolerance = ["-100 g", "300 g"] }': stats.uniform(50.3, 0.4),
    '{ tolerance = "0.5 kg" }': stats.uniform(49.9, 1.0),
    "{ uniform = [1, 4] }": stats.uniform(1, 3),
    "{ triangular = [1, 1.5, 4] }": stats.triang(0.5 / 3, 1, 3),
    '{ lognormal = ["2 kg", 0.3] }': stats.lognorm(0.3, scale=2),
    "{ normal = [1, 0.5], most = 1.2 }": stats.truncnorm(-2, 0.4, 1, 0.5),  # a mass ends at zero
    "{ normal = [1, 0.5], least = 0.8, most = 1.2 }": stats.truncnorm(-0.4, 0.4, 1, 0.5),
}


@pytest.mark.parametrize("entry", LAWS)
def test_numbers_are_distributed_as_scipy_says(tmp_path: Path, entry: str) -> None:
    drawn = values(tmp_path, f'[vary]\n"carrier.mass" = {entry}\n', 20_000)["carrier.mass"]
    assert stats.kstest(drawn, LAWS[entry].cdf).pvalue > 0.01
    # a test that accepts everything would not notice one part in twenty
    assert stats.kstest(1.05 * drawn, LAWS[entry].cdf).pvalue < 1e-3


def test_what_is_cut_off_is_said(tmp_path: Path) -> None:
    """A normal distribution about almost zero loses half, and has the mean sigma sqrt(2/pi)."""
    campaign = read(
        tmp_path, '[vary]\n"carrier.mass" = { normal = [0, 200] }\n"gravity[2]" = { normal = [0, 1] }' + RUN
    )
    mass, gravity = (varied.remark for varied in campaign.draw.varied)
    assert mass.startswith("carrier.mass: 50 % of its distribution is below 0 and ") and gravity == ""
    assert mass.endswith(f"; the mean is {200 * math.sqrt(2 / math.pi):.6g} kg")
    few = read(tmp_path, '[vary]\n"carrier.mass" = { normal = [3, 0.2] }' + RUN)
    assert few.draw.varied[0].remark == ""
    both = read(tmp_path, '[vary]\n"carrier.mass" = { uniform = [1, 2], least = 1.2, most = 1.6 }' + RUN)
    assert "60 % of its distribution is below 1.2 or above 1.6 and is cut off; the mean is 1.4 kg" in (
        both.draw.varied[0].remark
    )


def test_a_pattern_draws_each_match_by_itself_and_a_path_has_precedence(tmp_path: Path) -> None:
    pattern = '[vary]\n"rw*.mass" = { tolerance = "1 g" }\n'
    few = values(tmp_path, pattern)
    assert list(few) == [f"rw{i}.mass" for i in (1, 2, 3, 4)]
    assert np.abs(np.corrcoef(list(few.values())) - np.eye(4)).max() < 0.06
    more = values(tmp_path, pattern + '"rw2.mass" = { uniform = ["2 kg", "3 kg"] }\n"gravity[2]" = { normal = [0, 1] }')
    assert np.array_equal(few["rw1.mass"], more["rw1.mass"])  # numbers stay when others vary
    assert few["rw2.mass"].max() < 2.4011 and more["rw2.mass"].max() > 2.9


def test_a_grade_gives_the_permissible_unbalance_in_any_direction(tmp_path: Path) -> None:
    """ISO 21940-11: the velocity of the centre of mass, e_per omega, is the grade."""
    graded = '"rw*.unbalance" = { grade = "G 2.5", speed = "3000 rpm" }'
    drawn = values(tmp_path, f"[vary]\n{graded}")
    assert list(drawn)[:2] == ["rw1.unbalance.static", "rw1.unbalance.static_at"]
    for i in (1, 2, 3, 4):
        e_per = drawn[f"rw{i}.unbalance.static"] / mahovik.example("sat4").flywheels[i - 1].mass
        assert e_per * 100 * math.pi == pytest.approx(2.5e-3, rel=1e-12)
        angle = drawn[f"rw{i}.unbalance.static_at"]
        assert stats.kstest(angle, stats.uniform(-math.pi, 2 * math.pi).cdf).pvalue > 0.01
    part = values(tmp_path, f"[vary]\n{graded.replace(' }', ', share = { uniform = [0, 1] } }')}")
    most = drawn["rw1.unbalance.static"][0]
    assert stats.kstest(part["rw1.unbalance.static"], stats.uniform(0, most).cdf).pvalue > 0.01
    third = graded.replace("unbalance", "unbalance.static").replace(" }", ", share = 0.3 }")
    assert values(tmp_path, f"[vary]\n{third}")["rw1.unbalance.static"][0] == pytest.approx(0.3 * most, rel=1e-12)
    # the chart of the standard reads 8 um for G 2.5 at 3000 rpm
    assert permissible_unbalance(grade_of("G 2.5"), 100 * math.pi, 1.0) == pytest.approx(7.96e-6, rel=1e-3)


def test_a_group_is_at_one_quantile(tmp_path: Path) -> None:
    entry = '"{}" = {{ relative = "{} %", group = "batch" }}\n'
    drawn = values(tmp_path, "[vary]\n" + entry.format("rw*.spin_inertia", 1) + entry.format("carrier.mass", 2))
    *wheels, carrier = (column / np.mean(column) - 1 for column in drawn.values())
    for wheel in wheels:
        assert wheel == pytest.approx(carrier / 2, abs=2e-3)
        assert np.corrcoef(wheel, carrier)[0, 1] == pytest.approx(1)


def test_correlated_numbers_keep_their_distributions(tmp_path: Path) -> None:
    body = (
        '[vary]\n"rw*.unbalance.static" = { lognormal = ["1 g mm", 0.3] }\n"carrier.mass" = { tolerance = "1 kg" }\n'
        '[[correlation]]\nof = ["rw*.unbalance.static"]\ncoefficient = 0.6\n'
        '[[correlation]]\nof = ["rw1.unbalance.static", "carrier.mass"]\ncoefficient = -0.5\n'
    )
    drawn = values(tmp_path, body, 20_000)
    scores = np.log(drawn["rw1.unbalance.static"]), np.log(drawn["rw4.unbalance.static"])
    assert np.corrcoef(*scores)[0, 1] == pytest.approx(0.6, abs=0.02)
    ranks = stats.spearmanr(drawn["rw1.unbalance.static"], drawn["carrier.mass"]).statistic
    assert ranks == pytest.approx(6 / math.pi * math.asin(-0.5 / 2), abs=0.02)
    assert abs(np.corrcoef(drawn["carrier.mass"], scores[1])[0, 1]) < 0.02
    assert stats.kstest(drawn["rw1.unbalance.static"], stats.lognorm(0.3, scale=1e-6).cdf).pvalue > 0.01
    assert stats.kstest(drawn["carrier.mass"], stats.uniform(49.4, 2).cdf).pvalue > 0.01


FACTORS = ("a", "b", "c")


def made(kind: str, samples: int = 200, seed: int = 5) -> Design:
    return Design(kind, FACTORS, samples, seed)


@pytest.mark.parametrize("kind", DESIGNS)
def test_samples_depend_on_their_numbers_alone(kind: str) -> None:
    whole = made(kind).unit(0, 200)
    for first, last in itertools.pairwise((0, 1, 7, 64, 129, 200)):
        assert np.array_equal(made(kind).unit(first, last - first), whole[first:last])
    assert whole.shape == (200, 3) and (whole >= 0).all() and (whole <= 1).all()


@pytest.mark.parametrize("kind", ["random", "latin", "sobol"])
def test_factors_are_uniform_and_independent(kind: str) -> None:
    x = made(kind, 4096).unit(0, 4096)
    assert all(stats.kstest(column, "uniform").pvalue > 0.01 for column in x.T)
    assert np.abs(np.corrcoef(x.T) - np.eye(3)).max() < 0.06
    if kind == "latin":
        assert (np.sort(np.floor(x * 4096), axis=0) == np.arange(4096)[:, None]).all()


def test_a_sobol_sequence_halves_its_error_faster_than_random_samples() -> None:
    errors = {}
    for kind in ("random", "sobol"):
        x = np.array([made(kind, 4096, seed).unit(0, 4096) for seed in range(8)])
        errors[kind] = np.sqrt(np.mean((np.prod(2 * x, axis=2).mean(axis=1) - 1) ** 2))
    assert errors["sobol"] < errors["random"] / 20


def test_saltelli_s_samples_are_in_the_order_of_salib() -> None:
    from SALib.sample.sobol import sample

    problem = {"num_vars": 3, "names": list(FACTORS), "bounds": [[0.0, 1.0]] * 3}
    theirs = sample(problem, 16, calc_second_order=False, seed=_generator(9, "sobol"))
    assert np.array_equal(made("saltelli", 16 * 5, 9).unit(0, 16 * 5), theirs)


def ishigami(u: Array) -> Array:
    """Ishigami's function, whose indices are known: a = 7, b = 0.1, on -pi..pi."""
    x, y, z = (2 * np.pi * u - np.pi).T
    return np.asarray(np.sin(x) + 7 * np.sin(y) ** 2 + 0.1 * z**4 * np.sin(x))


def test_sobol_indices_of_ishigami_s_function() -> None:
    """Where two pairs have no value, the largest power of two of the others is used."""
    variance = 7**2 / 8 + 0.1 * np.pi**4 / 5 + 0.1**2 * np.pi**8 / 18 + 0.5
    first = np.array([0.5 * (1 + 0.1 * np.pi**4 / 5) ** 2, 7**2 / 8, 0.0]) / variance
    both = 0.1**2 * np.pi**8 * (1 / 18 - 1 / 50) / variance
    design = made("saltelli", 5 * 4096)
    y = ishigami(design.unit(0, design.samples))
    for missing, used in (([], design.samples), ([3, 77], design.samples // 2)):
        y[missing] = np.nan
        figures, count = design.sensitivity(y)
        assert figures["S1"] == pytest.approx(first, abs=0.03)
        assert figures["ST"] == pytest.approx(first + np.array([both, 0, both]), abs=0.03)
        assert np.all((figures["ST +-"] > 1e-3) & (figures["ST +-"] < 0.06)) and count == used
    random = made("random", 20_000)
    x = random.unit(0, random.samples)
    assert [variance_share(column, ishigami(x)) for column in x.T] == pytest.approx(first, abs=0.03)
    assert (design.sensitivity(np.ones(50))[0]["ST"] == 0).all()
    assert made("saltelli").sensitivity(np.zeros(7))[0] == made("random").sensitivity(np.zeros(200))[0] == {}


def test_morris_finds_what_is_linear_and_what_is_not() -> None:
    design = made("morris", 4 * 50)
    u = design.unit(0, design.samples)
    assert ((u > 0) & (u < 1)).all()  # the ends of a normal distribution are infinite
    figures, _ = design.sensitivity(3 * u[:, 0] + u[:, 1] * u[:, 2])
    assert figures["mu_star"][0] == pytest.approx(3 * 0.75)  # u grows by 3/4 from the lowest to the highest level
    assert figures["sigma"][0] == pytest.approx(0, abs=1e-12)
    assert figures["sigma"][1] > 0.05
