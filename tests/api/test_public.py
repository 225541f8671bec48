"""The public interface: as recorded, loaded when asked for, typed, and as its page says."""

import ast
import doctest
import importlib
import inspect
import operator
import subprocess
import sys
import tomllib
from pathlib import Path
from typing import Any

import pytest

import mahovik
from api import typed_script
from api.models import model, stand
from docs.pages import ROOT

RECORD = Path(__file__).parent / "public.txt"
PUBLIC: tuple[str, ...] = tuple(vars(mahovik)["__all__"])


def signatures() -> list[str]:
    """A line for every public name and every attribute of a public class, sorted."""
    lines = []
    for name in PUBLIC:
        value = getattr(mahovik, name)
        if inspect.isclass(value):
            bases = ", ".join(base.__name__ for base in value.__bases__ if issubclass(base, Exception))
            lines.append(f"class {name}({bases})")
            if value.__module__.startswith("mahovik.out.") and not issubclass(value, Exception):
                lines += [f"{name}.{line}" for line in attributes(value)]
        else:
            lines.append(f"{name}{inspect.signature(value)}" if callable(value) else name)
    return sorted(lines)


def attributes(value: type) -> list[str]:
    """Public attributes of a class, its own and inherited, methods with their signatures."""
    names = []
    for name in getattr(value, "_fields", getattr(value, "__members__", dir(value))):
        attribute = inspect.getattr_static(value, name)
        if not name.startswith("_"):
            kind = isinstance(attribute, property)
            names.append(name if kind or not callable(attribute) else f"{name}{inspect.signature(attribute)}")
    return names


def test_signatures_are_as_recorded() -> None:
    """A change is deliberate: write the file again, tell the changelog, and keep the promise of docs/python.md."""
    assert RECORD.read_text(encoding="utf-8").splitlines() == signatures()


def test_importing_loads_nothing() -> None:
    code = (
        "import sys, mahovik; print(*dir(mahovik)); print(*(m for m in sys.modules if 'mahovik' in m or m == 'numpy'))"
    )
    printed = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True).stdout
    names, modules = printed.splitlines()
    assert set(PUBLIC) <= set(names.split())
    assert modules == "mahovik"


def test_every_name_can_be_had() -> None:
    scope: dict[str, Any] = {}
    exec("from mahovik import *", scope)
    assert set(PUBLIC) <= scope.keys()
    with pytest.raises(AttributeError, match="no attribute 'bild'"):
        operator.attrgetter("bild")(mahovik)


def test_type_checkers_know_the_same_names() -> None:
    """`__init__.pyi` names each public object, in the module where it is found."""
    stub = ast.parse(Path(mahovik.__file__).with_suffix(".pyi").read_text(encoding="utf-8"))
    known = {"__version__": mahovik.__version__}
    for node in ast.walk(stub):
        if isinstance(node, ast.ImportFrom) and node.module is not None:
            known |= {a.name: getattr(importlib.import_module(node.module), a.name) for a in node.names}
    assert known == {name: getattr(mahovik, name) for name in PUBLIC}


@pytest.mark.slow
@pytest.mark.parametrize("name", ["python.md", "data.md"])
def test_a_page_does_what_it_shows(name: str) -> None:
    flags = doctest.NORMALIZE_WHITESPACE | doctest.ELLIPSIS
    failed, tried = doctest.testfile(str(ROOT / "docs" / name), module_relative=False, optionflags=flags)
    assert failed == 0 and tried >= 5


def test_the_typed_script_runs(capsys: pytest.CaptureFixture[str]) -> None:
    """The script runs; that its types are right is checked by `make lint`."""
    typed_script.main()
    checked = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["mypy"]
    assert "tests" in checked["files"]
    assert not {"api.*", "api.typed_script"} & {m for o in checked["overrides"] for m in o["module"]}
    numbers = [float(word) for word in capsys.readouterr().out.strip("[]\n").split()]
    assert len(numbers) == 3 and numbers[0] == numbers[1] == numbers[2] > 0


def test_notebooks_show_tables() -> None:
    m = model("bench8")
    x = m.states(3)
    x.phi[1, 1] = float("nan")
    shown: dict[str, Any] = {
        "w8": stand("bench8"),
        "state by state": m,
        "rad/s; twist": x,
        "1 of 3 refused": m.forward(x, on_error="nan"),
        "0, 0, 0": m.state(),
    }
    for words, value in shown.items():
        html = value._repr_html_()
        assert words.partition(";")[0] in html and html.count("<table>") == html.count("</table>") > 0
        assert len(repr(value)) < 100 and "\n" not in repr(value) and "<script" not in html
