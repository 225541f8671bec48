"""mahovik report: one page that stands alone; what fails is said to fail."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from cli.run import DEMO3, refused, run
from mahovik import __version__
from mahovik.contract import limits
from mahovik.contract.limits import DOUBLE
from mahovik.core.stand import identities, load
from mahovik.out.commands import report as page
from report.reports import read, words


def report_page(*options: str, stand: str = DEMO3) -> str:
    """The page."""
    result = run("report", stand, "-o", "r.html", *options)
    assert (result.exit_code, result.stdout) == (0, "file: r.html\n"), result.output
    return Path("r.html").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """The report of demo3, all of it."""
    folder = tmp_path_factory.mktemp("report")
    result = run("report", DEMO3, "-o", str(folder / "r.html"))
    assert result.exit_code == 0, result.output
    assert [file.name for file in folder.iterdir()] == ["r.html"]
    yield (folder / "r.html").read_text(encoding="utf-8")


def test_the_page_is_well_formed_and_says_what_it_is_of(whole: str) -> None:
    seen = read(whole)
    assert seen.wrong == []
    linked = {value.removeprefix("#") for _, name, value in seen.attributes if name == "href"}
    ids = {value for _, name, value in seen.attributes if name == "id"}
    assert set(seen.sections) <= linked <= ids
    names = identities(load(DEMO3))
    text = words(whole)
    for part in ("demo3.toml", names.structure, names.physics, f"mahovik {__version__}", "3 flywheels"):
        assert part in text
    assert "FAIL" not in text
    assert "passed: worst" in text and "Three derivations" in text


def test_the_page_needs_nobody_else(whole: str) -> None:
    """The page has no address, no path of this machine and no date, and is small."""
    addresses = re.sub(r'xmlns(:\w+)?="[^"]*"', "", whole)  # names, which nobody asks for
    assert not re.search(r"(https?:|file:|//[a-z])", addresses)
    assert "@import" not in whole
    assert not re.search(r"url\((?!#|data:)", whole)
    for tag, name, value in read(whole).attributes:
        if name in ("src", "href"):
            assert value.startswith(("#", "data:")), (tag, value)
    assert str(Path.cwd().anchor + "tmp") not in whole
    assert str(Path(DEMO3).parent) not in whole
    assert not re.search(r"\b20\d\d-\d\d-\d\d\b", whole)
    assert len(whole.encode("utf-8")) < 300_000


def test_a_comparison_that_fails_is_shown_as_failing(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing is as near as 1e-30: the page is written, red at its top, and the status is 1."""
    monkeypatch.setattr(page, "STATES", 4)
    monkeypatch.setitem(limits.LIMITS, "double", replace(DOUBLE, value=1e-30))
    result = run("report", DEMO3, "-o", "r.html")
    assert result.exit_code == 1
    assert "error: verification: FAILED: " in result.stdout
    html = Path("r.html").read_text(encoding="utf-8")
    assert read(html).wrong == []
    assert "FAIL verification: FAILED" in words(html[: html.index("<main>")])
    assert '<div class="failure" role="alert">' in html and '<span class="bad">FAILED' in html


def test_a_held_carrier_has_a_page() -> None:
    """A force table: its reaction over speeds; no modes."""
    stand = Path(__file__).resolve().parents[2] / "docs" / "held" / "force_table.toml"
    seen = read(report_page(stand=str(stand)))
    assert seen.wrong == [] and "Modes" not in seen.text
    assert "hold.reaction at most 7.11 N RMS at 3000 rpm" in seen.text
    assert refused("report", str(stand), "--at", "nowhere", "-o", "q.html") == (
        'error: --at nowhere: unknown, did you mean "wheel"?\n'
    )
