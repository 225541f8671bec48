"""The pages are correct: links, C, stand files, keys, statuses, ranges, the table of harmonics."""

from __future__ import annotations

import re
import subprocess
from dataclasses import replace
from pathlib import Path

import pytest
import sympy as sp

from docs.pages import PAGES, ROOT, Block, anchors, blocks, links, prose, rows
from mahovik.core.derive import flywheel
from mahovik.core.emit.delivery import added_files
from mahovik.core.emit.generate import generate, generate_all
from mahovik.core.stand import laws, load, loads
from mahovik.core.stand.datasheet import UnbalanceTable
from mahovik.core.stand.model import Encoder, Task
from mahovik.core.stand.motor import Motor
from mahovik.core.stand.tables import keys_of
from mahovik.core.stand.units import Dimension
from mahovik.core.toolchain.compiler import BITS, WARNINGS, find_compiler

PACKAGE = ROOT / "generator" / "mahovik"
MODEL, STAND_FILE, C_INTERFACE = (ROOT / "docs" / f"{name}.md" for name in ("model", "stand-file", "c-interface"))
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
