"""The wheel of a clean checkout, installed elsewhere, generates the same C: templates and stands travel in it."""

import os
import shutil
import subprocess
import sys
import tomllib
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from mahovik import __version__
from mahovik import stands as examples
from mahovik.core.emit.generate import generate_all
from mahovik.core.stand import load

ROOT = Path(__file__).resolve().parent.parent


def run(*command: str | Path, **options: Any) -> str:
    """Output of a command that must succeed."""
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, check=False, **options)
    assert done.returncode == 0, done.stdout + done.stderr
    return str(done.stdout)


def tracked() -> list[str]:
    """The files of a clean checkout; of an unpacked archive those that no tool made."""
    if (ROOT / ".git").exists() and shutil.which("git"):
        return run("git", "ls-files", "-z", cwd=ROOT).strip("\0").split("\0")
    made = {".venv", "build", "dist", ".hypothesis"}
    files = (file.relative_to(ROOT) for file in ROOT.rglob("*"))
    return [str(f) for f in files if f.parts[0] not in made and not f.parts[0].endswith("_cache")]


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The wheel of the tracked files alone, as a clean checkout has them."""
    folder = tmp_path_factory.mktemp("package")
    checkout = folder / "checkout"
    for name in tracked():
        if (ROOT / name).is_file():
            (checkout / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(ROOT / name, checkout / name)
    command = (sys.executable, "-m", "build", "--wheel", "--no-isolation", "--outdir", folder / "dist", checkout)
    run(*command, cwd=folder)
    (file,) = (folder / "dist").iterdir()
    return file


@pytest.fixture(scope="module")
def site(wheel: Path) -> Path:
    """A folder outside the repository where the wheel is installed."""
    target = wheel.parent.parent / "site"
    options = ("--quiet", "--disable-pip-version-check", "--no-deps", "--no-index", "--target", target)
    run(sys.executable, "-m", "pip", "install", *options, wheel)
    return target


@pytest.fixture
def installed(site: Path, tmp_path: Path) -> Callable[..., str]:
    """Runs Python in another folder with the installed package before all others on its path."""

    def python(*arguments: str) -> str:
        return run(sys.executable, *arguments, cwd=tmp_path, env=os.environ | {"PYTHONPATH": str(site)})

    place = Path(python("-c", "import mahovik; print(mahovik.__file__)").strip())
    assert place.is_relative_to(site), place
    return python


def test_what_travels(wheel: Path) -> None:
    names = zipfile.ZipFile(wheel).namelist()
    assert wheel.name == f"mahovik-{__version__}-py3-none-any.whl"
    folder = ROOT / "templates"
    templates = {f"mahovik/templates/{file.relative_to(folder)}" for file in folder.rglob("*") if file.is_file()}
    assert {"mahovik/templates/stand.c.j2", "mahovik/templates/stand.h.j2"} < templates
    stands = {f"mahovik/stands/{name}.toml" for name in examples.names()}
    assert templates | stands | {"mahovik/py.typed"} <= set(names)
    assert [n for n in names if not n.startswith(("mahovik/", f"mahovik-{__version__}.dist-info/"))] == []
    assert [n for n in names if "__pycache__" in n or "tests/" in n] == []
    assert any(n.endswith("LICENSE") for n in names)


@pytest.mark.slow
def test_the_installed_package_generates_the_same_c(installed: Callable[..., str], tmp_path: Path) -> None:
    code = "from mahovik.out.command_line import main; main()"
    place = installed("-c", "from mahovik import stands; print(stands.path('bench8'))").strip()
    installed("-c", code, "generate", place, "--with", "selftest", "-o", "out")
    files = [file for file in (tmp_path / "out").rglob("*") if file.is_file()]
    written = {str(file.relative_to(tmp_path / "out")): file.read_text(encoding="ascii") for file in files}
    expected = generate_all(load(examples.path("bench8")), only=()).files
    assert expected.items() <= written.items()
    assert {"verification/bench8_selftest.c", "README.md", "manifest.json"} <= written.keys()


def test_the_installed_command_knows_its_version_and_examples(installed: Callable[..., str], tmp_path: Path) -> None:
    code = "from mahovik.out.command_line import main; main()"
    assert __version__ in installed("-c", code, "--version")
    installed("-c", code, "new", "sat4", "-o", "mine.toml")
    example = examples.path("sat4").read_bytes()
    assert (tmp_path / "mine.toml").read_bytes() == example.replace(b'\nname = "sat4"\n', b'\nname = "mine"\n', 1)
    installed("-c", code, "check", "mine.toml")


def test_an_old_python_is_refused_before_anything_is_tried() -> None:
    """The backend that pip asks first ends with one line; some pips would try all versions of all packages first."""
    with open(ROOT / "pyproject.toml", "rb") as file:
        system = tomllib.load(file)["build-system"]
    code = f"import sys; sys.version_info = (3, 10, 13); sys.path.insert(0, '{system['backend-path'][0]}')"
    command = (sys.executable, "-c", f"{code}; import {system['build-backend']}")
    done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=ROOT)
    assert (done.returncode, done.stderr) == (1, "mahovik needs Python 3.11 or newer, this is Python 3.10\n")
