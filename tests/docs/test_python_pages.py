"""The pages of Python functions: arguments, defaults and results as they are in the code, and examples that run."""

from __future__ import annotations

import doctest
import inspect
from pathlib import Path

import pytest

import mahovik
from docs.pages import ROOT, links, rows

FOLDER = ROOT / "docs" / "python"
PLACES: dict[str, str] = vars(mahovik)["_PLACES"]
FUNCTIONS = tuple(name for name in PLACES if PLACES[name].startswith("out.functions.") and name.islower())

QUICK = ("balance",)
"""Pages whose example takes about a second or less; the others plan, or need a compiler or a program."""

each_function = pytest.mark.parametrize("name", FUNCTIONS)


def page_of(name: str) -> Path:
    return FOLDER / f"{name}.md"


def test_every_function_has_a_page_and_every_page_is_linked() -> None:
    pages = {f"python/{path.name}" for path in FOLDER.glob("*.md")}
    assert pages == {f"python/{name}.md" for name in (*FUNCTIONS, "gallery")}
    linked = [target for target in links(ROOT / "docs" / "python.md") if target.startswith("python/")]
    assert sorted(linked) == sorted(pages)


@each_function
def test_arguments_and_defaults_are_those_of_the_signature(name: str) -> None:
    listed = [(row[0].strip("`"), row[1].strip("`")) for row in rows(page_of(name), "argument")]
    parameters = inspect.signature(getattr(mahovik, name)).parameters
    empty = inspect.Parameter.empty
    assert listed == [(each, "" if p.default is empty else repr(p.default)) for each, p in parameters.items()]
    assert all(row[2] for row in rows(page_of(name), "argument"))


@pytest.mark.parametrize("name", [pytest.param(n, marks=() if n in QUICK else pytest.mark.slow) for n in FUNCTIONS])
def test_the_example_gives_what_is_shown(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    if name == "report":
        pytest.importorskip("matplotlib").use("Agg")
    failed, tried = doctest.testfile(str(page_of(name)), module_relative=False)
    assert failed == 0 and tried >= 4
    assert not list(tmp_path.iterdir()), "an example writes into a temporary folder of its own"
