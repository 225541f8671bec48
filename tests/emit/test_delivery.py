"""README of the delivered folder: its example compiles and runs, and what it says is so."""

import json
import re
import subprocess
from pathlib import Path

import pytest

from emit.stands import stand, write
from mahovik.core.emit.delivery import delivery
from mahovik.core.emit.generate import generate_all
from mahovik.core.emit.manifest import manifest
from mahovik.core.stand.identity import identities
from toolchain.quick import quick
from toolchain.tools import compile_c, run

TRIED = ("bench8", "auv6", "everything0", "everything6", "bare0")


def block(readme: str, language: str) -> str:
    """Code of the first block of a language."""
    found = re.search(rf"```{language}\n(.*?)```", readme, re.DOTALL)
    assert found is not None
    return found[1]


@pytest.mark.slow
@pytest.mark.parametrize("real", quick(1, ["double", "float"]))
@pytest.mark.parametrize("name", quick(2, TRIED))
def test_the_example_compiles_and_prints_an_acceleration(name: str, real: str, tmp_path: Path) -> None:
    files = delivery(stand(name), real)
    write(files, tmp_path)
    (tmp_path / "main.c").write_text(block(files["README.md"], "c"), encoding="ascii")
    compile_c("gcc", tmp_path / "main.c", "-O0", tmp_path / f"{name}.c", "-o", tmp_path / "main")
    numbers = [float(line) for line in run(tmp_path / "main").splitlines()]
    assert len(numbers) == 6
    assert any(numbers)


@pytest.mark.slow
def test_its_commands_compile(tmp_path: Path) -> None:
    files = delivery(stand("demo3"))
    readme = files["README.md"]
    write({**files, "main.c": block(readme, "c")}, tmp_path)
    for commands in re.findall(r"```sh\n(.*?)```", readme, re.DOTALL):
        done = subprocess.run(["sh", "-ec", commands], cwd=tmp_path, capture_output=True, text=True, check=False)
        assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.endswith("failures 0\n")


@pytest.mark.parametrize("real", ["double", "float"])
def test_it_names_every_function_status_identity_and_file(real: str) -> None:
    given = stand("bench8")
    files = delivery(given, real)
    readme = files["README.md"]
    found = identities(given)
    for word in (found.structure, found.physics, f"`{real}`", "COST.md", "manifest.json"):
        assert word in readme
    for function in generate_all(given, real).program.functions:
        assert (f"| `{function.name}` |" in readme) == function.public
    statuses = re.findall(r"    (BENCH8_\w+) = (-?\d+)", files["bench8.h"].split("bench8_status;")[1].split("};")[0])
    assert len(statuses) == 13
    for name, value in statuses:
        assert f"| `{name}` | {value} |" in readme
    assert [name for name in files if name not in readme and not name.endswith("_recorder.c")] == ["README.md"]


def test_nothing_of_this_machine_is_in_it() -> None:
    files = delivery(stand("demo3"))
    for text in (*files.values(), manifest(stand("demo3"), "double", files)):
        assert not re.search(r"/(home|work|tmp|usr|root)/|20\d\d-\d\d", text)
        text.encode("ascii")


def test_the_manifest_is_json_in_a_fixed_order() -> None:
    files = {"b.c": "two\n", "a.h": "one\n"}
    text = manifest(stand("demo3"), "double", files)
    assert list(json.loads(text)["files"]) == ["a.h", "b.c"]
    assert text == manifest(stand("demo3"), "double", dict(reversed(files.items())))
    # sha256sum of the five bytes "one" and a line feed
    assert json.loads(text)["files"]["a.h"] == "2c8b08da5ce60398e1f19af0e5dccc744df274b826abe585eaba68c525434806"


@pytest.mark.slow
def test_every_equation_that_the_c_names_is_in_the_readme() -> None:
    """The folder stands alone."""
    for name in ("bench8", "everything6"):
        files = delivery(stand(name))
        explained = set(re.findall(r"^(\(\d+\)) ", files["README.md"], re.MULTILINE))
        assert explained == {f"({n})" for n in range(1, 14) if n != 3}  # the model has no use for (3)
        comments = " ".join(re.findall(r"/\*.*?\*/", files[f"{name}.h"] + files[f"{name}.c"], re.DOTALL))
        named = set(re.findall(r"(?<=\s)\(\d+\)", comments))
        assert "(8)" in named
        assert named <= explained
        assert "README.md" in files[f"{name}.h"]


def test_what_keeps_the_bits_is_said_wherever_compiling_is() -> None:
    files = delivery(stand("demo3"))
    for name in ("README.md", "demo3.h", "verification/demo3_selftest.c"):
        assert "-ffp-contract=off" in files[name]
        assert "-fno-tree-vectorize" in files[name]


@pytest.mark.parametrize(("name", "legs"), [("bench8", False), ("hung5", True)])
def test_out_of_range_means_what_the_stand_has(name: str, legs: bool) -> None:
    files = delivery(stand(name))
    for text in (files["README.md"], files[f"{name}.h"]):
        assert ("leg of no length" in text) == legs
