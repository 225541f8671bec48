"""The report of a campaign: what its tables and charts say is what the rows say."""

from __future__ import annotations

import re
from html import unescape
from pathlib import Path

import numpy as np
import pytest

import mahovik
from campaigns.sections import write
from campaigns.stub import POISON, load_stub, write_stub
from mahovik.out.campaign.convergence import quantile_interval
from mahovik.out.campaign.face import Campaign, CampaignFolder
from mahovik.out.campaign.report.influence import influences


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> CampaignFolder:
    """300 samples, of which some are poison."""
    place = tmp_path_factory.mktemp("campaign")
    file = write_stub(place / "c.json", samples=300, shard_size=100, within=0.5)
    found = Campaign(file, load=load_stub).prepare(place / "out")
    for number in range(3):
        found.shard(number)
    return found


def text_of(page: Path) -> str:
    """Words of a page without scripts and styles, one space between them."""
    html = re.sub(r"<(script|style|svg).*?</\1>", " ", page.read_text(encoding="utf-8"), flags=re.DOTALL)
    return " ".join(unescape(re.sub(r"<[^>]*>", " ", html)).replace("\u2007", "").replace("\u2008", "").split())


def test_the_page_says_what_the_rows_say(folder: CampaignFolder, tmp_path: Path) -> None:
    written = folder.report(tmp_path / "page.html", worst=2)
    text = text_of(written.page)
    columns = folder.columns()
    bad = np.isnan(columns["root"])
    assert f"300 samples in 3 shards, {bad.sum()} of them without quantities. Numbers that vary: 1." in text
    assert POISON in text
    found = quantile_interval(columns["root"], 0.95)
    assert f"95 % below {found.value:.5g}".rstrip("0") in text
    assert f"90 % of root below {quantile_interval(columns['root'], 0.9).value:.4g} ±" in text
    worst = int(np.nanargmax(columns["double"]))
    assert f"double, kg {worst}" in text
    html = written.page.read_text(encoding="utf-8")
    assert html.count("<figure") == 2  # of each quantity histogram, convergence, scatter
    assert not re.search(r'(src|href)="(http|//)', html)


def test_the_worst_samples_are_stand_files(folder: CampaignFolder, tmp_path: Path) -> None:
    written = folder.report(tmp_path / "page.html", worst=3)
    columns = folder.columns()
    order = np.argsort(-np.nan_to_num(columns["double"], nan=-np.inf))[:3]
    masses = {mahovik.load(path).carrier.mass for path in written.stands}
    assert masses == {columns["carrier.mass"][k] for k in order}
    assert {path.name for path in written.stands} == {f"shaker2-{k}.toml" for k in order}
    assert folder.report(tmp_path / "none.html", worst=0).stands == ()


OWN = """
import pathlib
pathlib.Path(__file__).with_name("imported").touch()
def most(arrays):
    return float(abs(arrays["V"]).max())
"""


def test_the_report_of_a_folder_runs_no_code_of_its_campaign(tmp_path: Path) -> None:
    (tmp_path / "own.py").write_text(OWN)
    quantities = DEPENDS + '[[quantity]]\nname = "most"\nfunction = "own.py:most"\n'
    file = write(tmp_path, quantities, stand="shaker2", samples=4)
    Campaign(file).prepare(tmp_path / "out").shard(0)
    (tmp_path / "imported").unlink()
    report = CampaignFolder(tmp_path / "out").report(tmp_path / "page.html", worst=1)
    assert not (tmp_path / "imported").exists()
    assert "most" in text_of(report.page)


DEPENDS = """
[vary]
"left.unbalance.static" = { uniform = ["1800 g mm", "2200 g mm"] }
"carrier.mass" = { relative = "0.1 %" }
[over]
regime = { default = { speed = "300 rpm" } }
until = "5 ms"
dt = "0.5 ms"
[[quantity]]
name = "shake"
what = "rms acceleration"
at = "carrier"
"""


def test_shares_of_the_variance_are_those_of_ishigami() -> None:
    """sin x1 + 7 sin^2 x2 + x3^4 sin(x1)/10: shares 0.314, 0.442, 0; a line sees nothing of x2."""
    rng = np.random.default_rng(1)
    x = {f"x{k}": rng.uniform(-np.pi, np.pi, 40_000) for k in (1, 2, 3, 4)}
    y = np.sin(x["x1"]) + 7.0 * np.sin(x["x2"]) ** 2 + 0.1 * x["x3"] ** 4 * np.sin(x["x1"])
    found, explained = influences(x, y)
    shares = {each.parameter: each.share for each in found}
    assert shares["x1"] == pytest.approx(0.314, abs=0.015)
    assert shares["x2"] == pytest.approx(0.442, abs=0.015)
    assert shares["x3"] < 0.005 and shares["x4"] < 0.005
    assert [each.parameter for each in found[:2]] == ["x2", "x1"]
    assert abs(next(each.change for each in found if each.parameter == "x2")) < 0.02
    assert explained == pytest.approx(0.19, abs=0.02)
