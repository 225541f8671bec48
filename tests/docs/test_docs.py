"""The pages are correct: links, C, files, keys, statuses, ranges; the site builds and needs no network."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest
import reference_tables
import sympy as sp

from docs.pages import PAGES, ROOT, Block, anchors, blocks, links, prose, rows
from mahovik.contract.limits import JOINT, TABLE
from mahovik.core.derive import flywheel
from mahovik.core.emit.delivery import added_files
from mahovik.core.emit.generate import generate, generate_all
from mahovik.core.motion.motion_file import (
    MotionTable,
    SlewEnd,
    SlewStart,
    SlewTable,
    read_motion,
    read_motion_or_slew,
)
from mahovik.core.motion.programme import Programme
from mahovik.core.motion.required import Bounds, Objective, Slew
from mahovik.core.stand import laws, load, loads
from mahovik.core.stand.datasheet import UnbalanceTable
from mahovik.core.stand.model import Encoder, Point, Task
from mahovik.core.stand.motor import Motor
from mahovik.core.stand.tables import keys_of
from mahovik.core.stand.units import Dimension
from mahovik.core.toolchain.compiler import BITS, WARNINGS, find_compiler
from mahovik.out.campaign.file import load_campaign
from mahovik.out.campaign.quantities import SIGNALS, STATISTICS
from mahovik.out.campaign.runs import KINDS as RUNS
from mahovik.out.campaign.vary import DESIGNS, KINDS
from mahovik.proof.verify.programme.verification import tolerance_for
from mahovik.stands import path
from report.chromium import Opened, launched

PACKAGE = ROOT / "generator" / "mahovik"
MODEL, STAND_FILE = (ROOT / "docs" / f"{name}.md" for name in ("model", "stand-file"))
MORE_WARNINGS = ("-Wshadow", "-Wstrict-prototypes", "-Wdouble-promotion", "-Wcast-qual", "-Wundef", "-Wfloat-equal")

pages = pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)


# ---- pages ----


@pages
def test_relative_links_resolve(page: Path) -> None:
    for target in links(page):
        if re.match(r"[a-z]+:", target):
            continue
        path, _, anchor = target.partition("#")
        file = (page.parent / path).resolve() if path else page
        assert file.exists(), target
        assert not anchor or anchor in anchors(file), target


def test_pages_named_in_the_code_exist() -> None:
    """A page of the repository by its path, or one that a template makes; names in capitals are of delivered files."""
    for source in sorted(PACKAGE.rglob("*.py")):
        for name in re.findall(r"\b[a-z][a-z/-]+\.md\b", source.read_text(encoding="utf-8")):
            assert (ROOT / name).is_file() or (ROOT / "templates" / f"{name}.j2").is_file(), (source.name, name)


@pytest.mark.parametrize("name", ["architecture", "model"])
def test_files_of_the_package_named_on_a_page_exist(name: str) -> None:
    """A file is named by its path in the package, or below the folder that the head of the table names."""
    folders = [
        PACKAGE,
        *(
            PACKAGE / path
            for path in ("core", "core/stand", "proof/reference", "proof/second", "laws/fin", "laws/cross_flow")
        ),
    ]
    named = set(re.findall(r"`([a-z][\w/]*\.py)`", prose(ROOT / "docs" / f"{name}.md")))
    files = {path for path in named if not path.startswith(("tools/", "tests/"))}
    assert [path for path in files if not any((folder / path).is_file() for folder in folders)] == []


# ---- C ----

SNIPPETS = [
    b
    for page in PAGES
    for b in blocks(page)
    if b.language == "c" and not b.file and re.search(r'#include "(\w+)\.h"', b.text)
]
"""A program that is a file is run by the commands of its page."""


def emit(name: str, folder: Path) -> None:
    """C of an example stand or of a held one; auv6 with a run-time wrench on its carrier, as the page says."""
    held = ROOT / "docs" / "held" / f"{name}.toml"
    stand = load(held if held.exists() else PACKAGE / "stands" / f"{name}.toml")
    if name == "auv6":
        stand = replace(stand, carrier=replace(stand.carrier, wrench_input=True))
    for file, text in generate(stand).items():
        (folder / file).write_text(text, encoding="ascii")


@pytest.mark.parametrize("block", SNIPPETS, ids=lambda b: b.name)
def test_c_compiles_without_a_warning(block: Block, tmp_path: Path) -> None:
    (name, batch), *encoder = re.findall(r'#include "(\w+?)(_batch)?\.h"', block.text)
    emit(name, tmp_path)
    if batch or encoder:
        stand = load(PACKAGE / "stands" / f"{name}.toml")
        added = added_files(stand, generate_all(stand), ("batch" if batch else "encoder",))
        for file, text in added.items():
            (tmp_path / file).write_text(text, encoding="ascii")
    (tmp_path / "snippet.c").write_text(block.text, encoding="utf-8")
    output = ["snippet.c", f"{name}.c", "-o", "main"] if "int main(" in block.text else ["-c", "snippet.c"]
    command = [*find_compiler(), *WARNINGS, *MORE_WARNINGS, *BITS, "-O2", *output]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    if "int main(" in block.text:
        printed = subprocess.run([tmp_path / "main"], capture_output=True, text=True, check=True).stdout
        (shown,) = (b.text for b in blocks(block.page)[block.number :][:3] if b.language == "text")
        assert printed == shown


def test_the_header_in_the_readme_is_what_is_generated() -> None:
    """It shows a function of the example shaker2, whose file is called mine.toml there."""
    (shown,) = (block.text for block in blocks(ROOT / "README.md") if block.language == "c")
    text = (PACKAGE / "stands" / "shaker2.toml").read_text(encoding="utf-8").replace('"shaker2"', '"mine"')
    assert shown in generate_all(loads(text), only=("forward", "inverse_fast")).files["mine.h"]


# ---- model ----


def test_harmonics_are_those_of_the_derivation() -> None:
    """The table of harmonics in model.md is what core/derive/flywheel.py gives."""
    w = flywheel.generic()
    known = {f"b{i + 1}": w.b[i] for i in range(3)}
    known |= {f"J{i + 1}{j + 1}": w.J[i, j] for i in range(3) for j in range(i, 3)}
    derived = flywheel.spun_inertia(w)
    listed = rows(MODEL, "harmonic")
    assert len(listed) == len(flywheel.HARMONICS)
    for line, name in zip(listed, flywheel.HARMONICS, strict=True):
        moment, *inertia = (sp.sympify(cell.strip("`"), locals=known) for cell in line[1:])
        assert sp.Matrix(moment or (0, 0, 0)) == derived[name].b
        assert sp.Matrix(inertia).expand() == derived[name].J.expand()


# ---- stand file ----


@pytest.mark.parametrize("block", [b for b in blocks(STAND_FILE) if b.language == "toml"], ids=lambda b: b.name)
def test_stand_files_load(block: Block) -> None:
    assert loads(block.text).bodies


def test_units_are_known() -> None:
    """Every quantity in quotes under *Numbers and units* can be read."""
    from mahovik.core.stand import units

    kinds = [x for x in vars(units).values() if isinstance(x, units.Dimension)]
    section = prose(STAND_FILE).partition("## Numbers and units")[2].partition("\n## ")[0]
    quantities = re.findall(r'"(\d[^"]*)"', section)
    assert len(quantities) > 4
    for quantity in quantities:
        assert any(_reads(quantity, kind) for kind in kinds), quantity


def _reads(quantity: str, kind: Dimension) -> bool:
    from mahovik.core.stand import units

    try:
        units.number(quantity, kind)
    except units.QuantityError:
        return False
    return True


def test_every_key_is_documented() -> None:
    inside: list[type] = [UnbalanceTable, Motor.table(), Encoder.table(), Task.table(), laws.hold_table()]
    models = [*laws.headers(), *laws.tables().values(), *laws.arrays().values()]
    keys = {key for model in (*models, *inside) for key in keys_of(model)}
    written = set(re.findall(r"\w+", " ".join(re.findall(r"`[^`]+`", prose(STAND_FILE)))))
    assert keys - written == set()


DOCS = ROOT / "docs"


def names(page: str, head: str) -> set[str]:
    """Names in the first column of all tables of a page whose head begins with a cell."""
    return {name for row in rows(DOCS / page, head) for name in re.findall(r"`\"?([\w.-]+)\"?`", row[0])}


def fields(*tables: type) -> set[str]:
    """Keys of tables of a file."""
    return {key for table in tables for key in keys_of(table)}


@pytest.mark.parametrize(
    ("page", "head", "keys"),
    [
        ("campaigns.md", "distribution", {*KINDS}),
        ("campaigns.md", "design", {*DESIGNS}),
        ("campaigns.md", "key of `[over]`", {*RUNS}),
        ("campaigns.md", "signal", {*SIGNALS}),
        ("campaigns.md", "statistic", {*STATISTICS}),
    ],
)
def test_a_table_has_the_keys_of_the_reader(page: str, head: str, keys: set[str]) -> None:
    assert names(page, head) == keys


def test_keys_of_motions_programmes_and_slews_are_documented() -> None:
    motion = {*fields(MotionTable, Bounds, Objective), "schema"}
    slew = fields(SlewTable, SlewStart, SlewEnd)
    text = (DOCS / "planning.md").read_text(encoding="utf-8")
    documented = set(re.findall(r"`(\w+)`", text))
    assert motion | slew | fields(Programme) - {"report"} <= documented


def test_units_of_signals_are_those_of_the_code() -> None:
    for row in rows(DOCS / "campaigns.md", "signal"):
        for name in re.findall(r"`(\w+)`", row[0]):
            assert SIGNALS[name].dimension.si.replace("^", "") in ["", *row[1].split(", ")], name


def test_motions_are_read() -> None:
    motion, turn = (block.text for block in blocks(DOCS / "planning.md") if block.language == "json")
    assert read_motion(motion, load(path("bench8"))).name == json.loads(motion)["name"]
    slew = read_motion_or_slew(turn, load(path("sat4")))
    assert isinstance(slew, Slew) and slew.name == json.loads(turn)["name"]


def test_campaigns_give_rows(tmp_path: Path) -> None:
    """Every sample has all quantities, which differ from sample to sample."""
    (text,) = (block.text for block in blocks(DOCS / "campaigns.md") if block.file)
    (tmp_path / "tolerances.toml").write_text(text, encoding="utf-8")
    campaign = load_campaign(tmp_path / "tolerances.toml")
    rows = campaign.rows(0, 3)
    assert rows["error"] == [""] * 3
    for quantity in campaign.quantities:
        assert len(np.unique(rows[quantity.name])) == 3 and np.isfinite(rows[quantity.name]).all()


def test_limits_of_the_verification_of_programmes() -> None:
    accepted = {
        name: [float(x) for x in re.findall(r"\d[\de.-]*", row[2])]
        for row in rows(DOCS / "planning.md", "item")
        for name in re.findall(r"`([^`]+)`", row[0])
    }
    smooth, kinked = (tolerance_for(load(path(name)), None) for name in ("bench8", "auv6"))
    assert accepted["residual"] == [smooth.residual]
    assert accepted["simulation"] == [smooth.error]
    assert accepted["table"] == accepted["periodicity"] == [TABLE]
    assert accepted["run-up table"] == [TABLE, JOINT]
    assert accepted["run-up end"] == [smooth.runup]
    text = (DOCS / "planning.md").read_text(encoding="utf-8")
    for size in (kinked.residual, kinked.error):
        assert f"accepted to {size:.0e}".replace("e-0", "e-") in text


class Loads(HTMLParser):
    """Files that a browser loads with a page, and targets of its links."""

    def __init__(self) -> None:
        super().__init__()
        self.loaded: list[str] = []
        self.links: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        attributes = dict(attrs)
        if tag in ("script", "img", "link", "iframe", "source", "object", "embed"):
            self.loaded += [value for key in ("src", "href", "data") if (value := attributes.get(key))]
        elif tag == "a" and attributes.get("href"):
            self.links.append(str(attributes["href"]))


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Built as `make docs` builds it."""
    out = tmp_path_factory.mktemp("site")
    command = [sys.executable, "-m", "sphinx", "-W", "--keep-going", "-n", "-q", "-b", "html", str(DOCS), str(out)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert " ".join(command[2:-2]) in (ROOT / "Makefile").read_text(encoding="utf-8")
    return out


@pytest.mark.slow
def test_nothing_is_loaded_from_the_network(site: Path) -> None:
    """Pages and style sheets load nothing; every link into the site leads to a file."""
    pages = sorted(site.rglob("*.html"))
    assert len(pages) > len(list(DOCS.rglob("*.md")))
    for page in pages:
        loads = Loads()
        loads.feed(page.read_text(encoding="utf-8"))
        assert not [target for target in loads.loaded if re.match(r"(https?:)?//", target)], page.name
        for target in loads.loaded + loads.links:
            path = re.split(r"[?#]", target)[0]
            if path and not re.match(r"[a-z]+:", path):
                assert (page.parent / path).exists(), f"{page.name}: {target}"
    for sheet in site.rglob("*.css"):
        assert not re.search(r"url\(['\"]?(https?:)?//|@import", sheet.read_text(encoding="utf-8")), sheet.name


@pytest.mark.slow
def test_pages_fit_a_phone_and_ask_for_nothing(site: Path) -> None:
    """In a browser with dark colours no page is wider than the screen, logs an error or makes a request."""
    root = "document.documentElement"
    with launched() as browser:
        opened = Opened(browser, site / "index.html", viewport={"width": 390, "height": 844}, color_scheme="dark")
        for page in sorted(site.rglob("*.html")):
            opened.page.goto(page.as_uri())
            assert opened.page.evaluate(f"{root}.scrollWidth <= {root}.clientWidth"), page.name
        assert opened.complaints == []
        assert [url for url in opened.requests if not url.startswith("file:")] == []


def test_a_key_without_an_entry_is_said_in_one_line(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(reference_tables, "entries", lambda *classes: {})
    with pytest.raises(SystemExit, match="Point: name has no entry in its docstring"):
        list(reference_tables.key_rows(Point.table(), Point))
