"""Numbers that vary: paths and patterns, values about those of the stand, groups, tables, correlations."""

import math
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy import stats

import mahovik
from campaigns.sections import read
from mahovik.out.campaign.designs import Random
from mahovik.out.campaign.file import CampaignFile

Array = NDArray[np.float64]


def first_values(file: CampaignFile, count: int = 4000) -> dict[str, Array]:
    """Values of the first samples, as a campaign draws them."""
    design = Random(file.draw.factors, count, file.table.seed)
    return file.draw.values(design.unit(0, count))


def values(folder: Path, body: str, count: int = 4000, stand: str = "sat4") -> dict[str, Array]:
    return first_values(read(folder, body, stand=stand), count)


def test_a_pattern_draws_each_of_its_matches_by_itself(tmp_path: Path) -> None:
    found = values(tmp_path, '[vary]\n"rw*.unbalance.static" = { normal = ["1 g mm", "0.2 g mm"] }')
    assert list(found) == [f"rw{i}.unbalance.static" for i in (1, 2, 3, 4)]
    columns = np.array(list(found.values()))
    assert columns.mean(axis=1) == pytest.approx([1e-6] * 4, rel=0.02)
    assert columns.std(axis=1) == pytest.approx([2e-7] * 4, rel=0.05)
    assert np.abs(np.corrcoef(columns) - np.eye(4)).max() < 0.06


def test_a_plain_path_has_precedence_over_a_pattern_and_a_number_stays_when_others_vary(tmp_path: Path) -> None:
    pattern = '[vary]\n"rw*.mass" = { tolerance = "1 g" }\n'
    few = values(tmp_path, pattern)
    more = values(
        tmp_path, pattern + '"rw2.mass" = { uniform = ["2 kg", "3 kg"] }\n"carrier.mass" = { relative = 0.1 }'
    )
    assert np.array_equal(few["rw1.mass"], more["rw1.mass"])
    assert few["rw2.mass"].max() < 2.4011
    assert more["rw2.mass"].max() > 2.9


def test_tolerances_are_about_the_value_of_the_stand_file(tmp_path: Path) -> None:
    found = values(
        tmp_path,
        '[vary]\n"carrier.center_of_mass" = { tolerance = "0.5 mm" }\n'
        '"rw1.position[0]" = { tolerance = ["-1 mm", "2 mm"] }'
        '\n"carrier.mass" = { relative = "2 %" }\n"rw1.unbalance.dynamic" = { relative = 0.01, most = "2.2 g cm^2" }',
    )
    middle = np.array([4e-3, -3e-3, 12e-3])
    for i, x in enumerate(middle):
        column = found[f"carrier.center_of_mass[{i}]"]
        assert stats.kstest(column, stats.uniform(x - 5e-4, 1e-3).cdf).pvalue > 0.01
    assert stats.kstest(found["rw1.position[0]"], stats.uniform(0.109, 3e-3).cdf).pvalue > 0.01
    assert stats.kstest(found["carrier.mass"], stats.norm(50.4, 0.02 * 50.4).cdf).pvalue > 0.01
    assert found["rw1.unbalance.dynamic"].max() <= 2.2e-7


def test_magnitudes_do_not_go_below_zero(tmp_path: Path) -> None:
    found = values(
        tmp_path,
        '[vary]\n"rw1.unbalance.static" = { normal = ["1 g mm", "1 g mm"] }\n'
        '"rw1.unbalance.static_at" = { normal = [0, "90 deg"] }\n'
        '"rw2.unbalance.static" = { normal = ["1 g mm", "1 g mm"], least = "0.5 g mm", most = "1.5 g mm" }',
    )
    expected = stats.truncnorm(-1, np.inf, 1e-6, 1e-6)
    assert found["rw1.unbalance.static"].min() >= 0
    assert stats.kstest(found["rw1.unbalance.static"], expected.cdf).pvalue > 0.01
    assert found["rw1.unbalance.static_at"].min() < -1
    assert 5e-7 <= found["rw2.unbalance.static"].min() < found["rw2.unbalance.static"].max() <= 1.5e-6


def test_a_grade_gives_the_permissible_unbalance_in_any_direction(tmp_path: Path) -> None:
    found = values(tmp_path, '[vary]\n"rw*.unbalance" = { grade = "G 2.5", speed = "3000 rpm" }')
    assert list(found)[:2] == ["rw1.unbalance.static", "rw1.unbalance.static_at"]
    omega = 100 * math.pi
    for i in (1, 2, 3, 4):
        e_per = found[f"rw{i}.unbalance.static"] / mahovik.example("sat4").flywheels[i - 1].mass
        assert e_per * omega == pytest.approx(2.5e-3, rel=1e-12)
        angle = found[f"rw{i}.unbalance.static_at"]
        assert stats.kstest(angle, stats.uniform(-math.pi, 2 * math.pi).cdf).pvalue > 0.01
    part = values(
        tmp_path, '[vary]\n"rw1.unbalance" = { grade = "G 2.5", speed = "3000 rpm", share = { uniform = [0, 1] } }'
    )
    most = found["rw1.unbalance.static"][0]
    assert stats.kstest(part["rw1.unbalance.static"], stats.uniform(0, most).cdf).pvalue > 0.01


def test_columns_of_a_table_are_of_the_same_measured_part(tmp_path: Path) -> None:
    rows = [(0.5, 10.0), (1.5, 200.0), (2.5, -30.0), (0.7, 90.0)]
    table = "".join(f"{static},x{i},{at}\n" for i, (static, at) in enumerate(rows))
    (tmp_path / "wheels.csv").write_text("static [g mm],serial,at [deg]\n" + table)
    found = values(
        tmp_path,
        '[vary]\n"rw*.unbalance.static" = { table = "wheels.csv" }\n'
        '"rw*.unbalance.static_at" = { table = "wheels.csv", column = "at" }',
    )
    statics = np.array([static for static, _ in rows])
    for i in (1, 2, 3, 4):
        which = np.abs(found[f"rw{i}.unbalance.static"][:, None] * 1e6 - statics).argmin(axis=1)
        angles = np.deg2rad([at for _, at in rows])[which]
        assert found[f"rw{i}.unbalance.static_at"] == pytest.approx(angles)
        assert stats.chisquare(np.bincount(which, minlength=4)).pvalue > 0.01
    assert (found["rw1.unbalance.static"] != found["rw2.unbalance.static"]).mean() > 0.7


def test_correlated_numbers_keep_their_distributions(tmp_path: Path) -> None:
    body = (
        '[vary]\n"rw*.unbalance.static" = { lognormal = ["1 g mm", 0.3] }\n"carrier.mass" = { tolerance = "1 kg" }\n'
        '[[correlation]]\nof = ["rw*.unbalance.static"]\ncoefficient = 0.6\n'
        '[[correlation]]\nof = ["rw1.unbalance.static", "carrier.mass"]\ncoefficient = -0.5\n'
    )
    found = values(tmp_path, body, 20_000)
    scores = np.log(found["rw1.unbalance.static"]), np.log(found["rw4.unbalance.static"])
    assert np.corrcoef(*scores)[0, 1] == pytest.approx(0.6, abs=0.02)
    ranks = stats.spearmanr(found["rw1.unbalance.static"], found["carrier.mass"]).statistic
    assert ranks == pytest.approx(6 / math.pi * math.asin(-0.5 / 2), abs=0.02)
    assert abs(np.corrcoef(found["carrier.mass"], scores[1])[0, 1]) < 0.02
    for i in (1, 2, 3, 4):
        column = found[f"rw{i}.unbalance.static"]
        assert stats.kstest(column, stats.lognorm(0.3, scale=1e-6).cdf).pvalue > 0.01
    assert stats.kstest(found["carrier.mass"], stats.uniform(49.4, 2).cdf).pvalue > 0.01
