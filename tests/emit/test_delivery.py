"""README of the delivered folder: its example compiles and runs, and what it says is so."""

import json
import re
from pathlib import Path

import pytest

from emit.stands import stand, write
from mahovik.contract.functions import ALL
from mahovik.core.emit.delivery import ADDITIONS, delivery
from mahovik.core.emit.generate import generate_all
from mahovik.core.emit.manifest import manifest
from mahovik.core.stand.structure import identities
from toolchain.tools import compile_c, run


def block(readme: str, language: str) -> str:
    """Code of the first block of a language."""
    match = re.search(rf"```{language}\n(.*?)```", readme, re.DOTALL)
    assert match is not None
    return match[1]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "real", "only"),
    [
        ("bench8", "double", ()),
        ("everything6", "float", ()),
        ("bare0", "double", ()),
        ("demo3", "double", ("matrices",)),
    ],
)
def test_the_example_compiles_and_prints_six_numbers(
    name: str, real: str, only: tuple[str, ...], tmp_path: Path
) -> None:
    files = delivery(stand(name), real, only)
    write(files, tmp_path)
    (tmp_path / "main.c").write_text(block(files["README.md"], "c"), encoding="ascii")
    compile_c("gcc", tmp_path / "main.c", "-O0", tmp_path / f"{name}.c", "-o", tmp_path / "main")
    numbers = [float(line) for line in run(tmp_path / "main").splitlines()]
    assert len(numbers) == 6
    assert any(numbers) or only


@pytest.mark.parametrize("real", ["double", "float"])
def test_it_names_every_function_status_identity_and_file(real: str) -> None:
    example = stand("bench8")
    files = delivery(example, real, ALL, tuple(ADDITIONS))
    readme = files["README.md"]
    hashes = identities(example)
    for word in (hashes.structure, hashes.physics, f"`{real}`", "COST.md", "manifest.json"):
        assert word in readme
    for function in generate_all(example, real).program.functions:
        assert (f"| `{function.name}` |" in readme) == function.public
    statuses = re.findall(r"    (BENCH8_\w+) = (-?\d+)", files["bench8.h"].split("bench8_status;")[1].split("};")[0])
    assert len(statuses) == 13
    for name, value in statuses:
        assert f"| `{name}` | {value} |" in readme
    assert [name for name in files if name not in readme and not name.endswith(("r.c", "h.c"))] == ["README.md"]


def test_the_manifest_is_json_in_a_fixed_order() -> None:
    files = {"b.c": "two\n", "a.h": "one\n"}
    text = manifest(stand("demo3"), "double", files)
    assert list(json.loads(text)["files"]) == ["a.h", "b.c"]
    assert text == manifest(stand("demo3"), "double", dict(reversed(files.items())))
    # sha256sum of the five bytes "one" and a line feed
    assert json.loads(text)["files"]["a.h"] == "2c8b08da5ce60398e1f19af0e5dccc744df274b826abe585eaba68c525434806"
