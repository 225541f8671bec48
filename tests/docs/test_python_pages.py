"""The pages of Python functions: arguments, defaults and results as they are in the code, and examples that run."""

from __future__ import annotations

import ast
import doctest
import inspect
import re
import sys
import textwrap
from pathlib import Path
from typing import Any

import pytest

import mahovik
from docs.pages import ROOT, blocks, links, prose, rows
from mahovik.out.functions.table import Table

FOLDER = ROOT / "docs" / "python"
PLACES: dict[str, str] = vars(mahovik)["_PLACES"]
FUNCTIONS = tuple(name for name in PLACES if PLACES[name].startswith("out.functions.") and name.islower())

COMMANDS = {"balance_stand": "balance", "follow": "simulate"}
"""Commands of another name than their function."""

QUICK = ("balance", "jitter", "linearize", "modes", "quiet", "response", "rest")
"""Pages whose example takes about a second or less; the others plan, or need a compiler or a program."""

each_function = pytest.mark.parametrize("name", FUNCTIONS)


def page_of(name: str) -> Path:
    return FOLDER / f"{name}.md"


def results(name: str) -> list[type]:
    """Class of the result of a function; for `plan` also that of its programmes."""
    function = getattr(mahovik, name)
    module = sys.modules[function.__module__]
    found = [getattr(module, inspect.signature(function).return_annotation)]
    return [*found, vars(module)["Programme"]] if name == "plan" else found


def own_attributes(kind: type) -> set[str]:
    """Public attributes of a class and of its objects, without those that every table has and does not change."""
    tree = ast.parse(textwrap.dedent(inspect.getsource(kind)))
    set_by_it = {
        node.attr
        for node in ast.walk(tree)
        if isinstance(node, ast.Attribute)
        and isinstance(node.ctx, ast.Store)
        and isinstance(node.value, ast.Name)
        and node.value.id == "self"
    }
    found = {name for name in set_by_it | set(vars(kind)) if not name.startswith("_")}
    return found - {"columns"} - ({"index"} if "index" not in set_by_it else set())


def test_every_function_has_a_page_and_every_page_is_linked() -> None:
    assert len(FUNCTIONS) == 17
    pages = {f"python/{path.name}" for path in FOLDER.glob("*.md")}
    assert pages == {f"python/{name}.md" for name in (*FUNCTIONS, "gallery")}
    linked = [target for target in links(ROOT / "docs" / "python.md") if target.startswith("python/")]
    assert sorted(linked) == sorted(pages)


@each_function
def test_the_page_begins_with_its_use_an_example_and_its_command(name: str) -> None:
    page = page_of(name)
    text = page.read_text(encoding="utf-8")
    assert text.startswith(f"# mahovik.{name}\n\n")
    heads = re.findall(r"^## (.*)$", text, re.MULTILINE)
    assert heads == ["Arguments", "Result"]
    assert blocks(page)[0].section == 1 and {block.language for block in blocks(page)} == {"pycon"}
    command = COMMANDS.get(name, name.replace("_", "-"))
    assert f"../commands.md#mahovik-{command}" in links(page)


@each_function
def test_arguments_and_defaults_are_those_of_the_signature(name: str) -> None:
    listed = [(row[0].strip("`"), row[1].strip("`")) for row in rows(page_of(name), "argument")]
    parameters = inspect.signature(getattr(mahovik, name)).parameters
    empty = inspect.Parameter.empty
    assert listed == [(each, "" if p.default is empty else repr(p.default)) for each, p in parameters.items()]
    assert all(row[2] for row in rows(page_of(name), "argument"))


@each_function
def test_every_attribute_of_the_result_is_named(name: str) -> None:
    heads = {"attribute": results(name)[0]}
    if name == "plan":
        heads["attribute of a programme"] = results(name)[1]
    for head, kind in heads.items():
        cells = " ".join(row[0] for row in rows(page_of(name), head))
        named = set(re.findall(r"`(\w+)(?:\([^`]*\))?`", cells))
        assert named == own_attributes(kind), kind
        for each in named:
            called = f"`{each}(" in cells
            assert called == inspect.isfunction(inspect.getattr_static(kind, each, None)), each


def test_attributes_are_seen() -> None:
    class Small(Table):
        index = "row"

        def __init__(self) -> None:
            self.stand, self._own = 1, 2

        @property
        def columns(self) -> Any:
            return ()

        def save(self) -> None: ...

    assert own_attributes(Small) == {"stand", "save"}


@pytest.mark.parametrize("name", [pytest.param(n, marks=() if n in QUICK else pytest.mark.slow) for n in FUNCTIONS])
def test_the_example_gives_what_is_shown(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    if name == "report":
        pytest.importorskip("matplotlib").use("Agg")
    failed, tried = doctest.testfile(str(page_of(name)), module_relative=False)
    assert failed == 0 and tried >= 4
    assert not list(tmp_path.iterdir()), "an example writes into a temporary folder of its own"


@each_function
def test_the_first_sentence_says_what_a_reader_can_do(name: str) -> None:
    """It opens with a verb of the imperative."""
    first = prose(page_of(name)).split("\n\n")[1]
    assert re.match(r"(Move|Find|Choose|Get|Plan|Check|See|Make) ", first), first
