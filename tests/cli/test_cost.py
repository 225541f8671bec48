"""cost: where it writes, and a gate that cannot be narrowed unseen. What is measured is made up here."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import cache
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from cli.run import AUV6, DEMO3, refused, run
from mahovik.core.emit.generate import generate
from mahovik.core.stand import load
from mahovik.core.stand.model import Stand
from mahovik.core.toolchain.board import require
from mahovik.core.toolchain.targets import Target
from mahovik.proof.cost import measure as measuring
from mahovik.proof.cost.measure import USUAL, Costs, FunctionCost, TargetCost
from mahovik.proof.verify import delivery
from mahovik.stands import path

FUNCTIONS = (FunctionCost("forward", 1000, 500, 490, 3000, ()), FunctionCost("inverse", 9000, 0, 0, 4000, ()))


@pytest.fixture(autouse=True)
def functions(monkeypatch: pytest.MonkeyPatch) -> list[FunctionCost]:
    """Figures of the functions on every target: to be changed by a test."""
    found = list(FUNCTIONS)

    def measure(
        stand: Stand,
        pairs: Sequence[tuple[Target, str]],
        progress: Callable[[int, int], None],
        only: tuple[str, ...] = (),
    ) -> Costs:
        targets = [
            TargetCost(
                *(target.name, target.title, real, "0" * 64, "gcc 1.2.3", "-O2", "qemu 7.2.0"),
                *(tuple(found), 5000, {}, {}, 8, {}),
            )
            for target, real in pairs
        ]
        return Costs(stand.name, "0", "1", 3, tuple(targets))

    monkeypatch.setattr(measuring, "measure", measure)
    monkeypatch.setattr(measuring, "require", lambda target: None)
    return found


@cache
def generated_files(name: str, real: str) -> dict[str, str]:
    """The C of an example stand, made once."""
    return generate(load(path(name)), real)


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The C of demo3 with its manifest."""

    def made(stand: Stand, real: str, only: tuple[str, ...] = ()) -> SimpleNamespace:
        return SimpleNamespace(files=generated_files(stand.name, real))

    monkeypatch.setattr(delivery, "generate_all", made)
    delivery.deliver(tmp_path / "out", load(DEMO3), "double", generated_files("demo3", "double"))
    return tmp_path / "out"


def contents(folder: Path) -> dict[str, bytes]:
    return {p.name: p.read_bytes() for p in folder.iterdir()}


def accepted(folder: Path) -> list[tuple[str, str]]:
    return [(t["target"], t["real"]) for t in json.loads((folder / "cost.json").read_text())["targets"]]


def edit(folder: Path, change: Callable[[dict[str, Any]], object]) -> None:
    """Other accepted figures, in a folder without a manifest."""
    data = json.loads((folder / "cost.json").read_text())
    change(data)
    (folder / "cost.json").write_text(json.dumps(data))


# ---- where it writes ----


def test_a_folder_in_float_is_measured_in_float(folder: Path, tmp_path: Path) -> None:
    """On every usual processor, also on those that have double."""
    place = tmp_path / "float"
    delivery.deliver(place, load(DEMO3), "float", generated_files("demo3", "float"))
    assert run("cost", DEMO3, "-o", str(place)).exit_code == 0
    assert {real for _, real in accepted(place)} == {"float"}
    assert {name for name, _ in accepted(place)} == {name for name, _ in USUAL}
    assert run("cost", DEMO3, "-o", str(place), "--check").exit_code == 0


def test_both_files_are_listed(folder: Path) -> None:
    result = run("cost", DEMO3, "-o", str(folder))
    assert result.exit_code == 0
    assert {"COST.md", "cost.json"} <= set(json.loads((folder / "manifest.json").read_text())["files"])
    assert accepted(folder) == list(USUAL)
    before = contents(folder)
    assert run("cost", DEMO3, "-o", str(folder)).exit_code == 0
    assert run("cost", DEMO3, "-o", str(folder), "--accept").exit_code == 0
    assert contents(folder) == before


@pytest.mark.parametrize("accept", [(), ("--accept",)])
def test_the_folder_of_another_stand_is_refused(accept: tuple[str, ...], folder: Path) -> None:
    run("cost", DEMO3, "-o", str(folder))
    before = contents(folder)
    assert 'holds the C of stand "demo3"' in refused("cost", AUV6, "-o", str(folder), *accept)
    assert contents(folder) == before


def test_other_c_of_the_stand_is_refused(folder: Path) -> None:
    (folder / "demo3.c").write_text((folder / "demo3.c").read_text() + "/* mine */\n")
    before = contents(folder)
    assert "holds other C than the stand file gives" in refused("cost", DEMO3, "-o", str(folder))
    assert contents(folder) == before


@pytest.mark.parametrize("name", ["COST.md", "cost.json"])
@pytest.mark.parametrize("text", ["what we paid\n", '{"stand": "auv6", "targets": []}', "# Cost of auv6\n\nWritten by"])
@pytest.mark.parametrize("bare", [True, False])
def test_a_file_of_others_is_not_replaced(name: str, text: str, bare: bool, folder: Path, tmp_path: Path) -> None:
    where = folder
    if bare:
        where = tmp_path / "bare"
        where.mkdir()
    (where / name).write_text(text)
    before = contents(where)
    for accept in ((), ("--accept",)):
        said = refused("cost", DEMO3, "-o", str(where), *accept)
        assert said.startswith(f"error: {where / name}: was not written by mahovik for demo3: ")
        assert said.count("\n") == 1
        assert contents(where) == before


@pytest.mark.parametrize("name", ["COST.md", "cost.json"])
def test_a_file_changed_by_hand_is_not_replaced(name: str, folder: Path) -> None:
    run("cost", DEMO3, "-o", str(folder))
    (folder / name).write_text((folder / name).read_text() + " ")
    before = contents(folder)
    assert f"{name}: was changed by hand" in refused("cost", DEMO3, "-o", str(folder), "--accept")
    assert contents(folder) == before


def test_a_folder_of_others_is_refused(tmp_path: Path) -> None:
    (tmp_path / "main.c").write_text("int main(void) { return 0; }\n")
    assert "neither empty nor a folder of `mahovik generate`" in refused("cost", DEMO3, "-o", str(tmp_path))
    assert set(contents(tmp_path)) == {"main.c"}


def test_check_does_not_take_the_figures_of_another_stand(tmp_path: Path) -> None:
    run("cost", AUV6, "-o", str(tmp_path / "new"))
    assert "no figures of `mahovik cost` for demo3" in refused("cost", DEMO3, "-o", str(tmp_path / "new"), "--check")


# ---- the gate ----


def test_some_targets_keep_the_figures_of_the_others(tmp_path: Path, functions: list[FunctionCost]) -> None:
    arguments = ("cost", DEMO3, "-o", str(tmp_path))
    run(*arguments)
    page, old = (tmp_path / "COST.md").read_bytes(), json.loads((tmp_path / "cost.json").read_text())["targets"]
    functions[0] = replace(FUNCTIONS[0], instructions=2000)
    result = run(*arguments, "--targets", "m4,m3", "--accept")
    assert result.exit_code == 0
    assert "| `forward` | 2,000 |" in result.stdout  # printed: COST.md has the tables of all
    assert (tmp_path / "COST.md").read_bytes() == page
    assert accepted(tmp_path) == [*USUAL, ("m3", "double"), ("m3", "float")]
    new = json.loads((tmp_path / "cost.json").read_text())["targets"]
    assert new[1:4] == old[1:]
    assert new[0]["functions"][0]["instructions"] == 2000
    failed = run(*arguments, "--check")
    assert failed.exit_code == 1
    assert failed.stdout.count("rise: ") == 3


def test_check_wants_figures_of_every_usual_target(tmp_path: Path) -> None:
    arguments = ("cost", DEMO3, "-o", str(tmp_path))
    assert run(*arguments, "--targets", "m4", "--accept").exit_code == 0
    for option in ((), ("--check",), ("--check", "--targets", "m4")):
        failed = run(*arguments, *option)
        assert failed.exit_code == 1, option
        assert "not accepted: m7, double\nnot accepted: rv32imafc, float\n" in failed.stdout
        assert "not all figures are accepted" in failed.stderr
        assert set(contents(tmp_path)) == {"cost.json"}
    assert run(*arguments, "--accept").exit_code == 0
    assert run(*arguments, "--check").exit_code == 0
    assert run(*arguments, "--check", "--targets", "m3").exit_code == 1
    assert run(*arguments, "--targets", "m3").exit_code == 0  # only asked what it costs


@pytest.mark.parametrize(
    ("change", "line"),
    [
        (lambda f: f.pop(1), "not accepted: m4, float: inverse, instructions"),
        (lambda f: f[0].pop("stack"), "not accepted: m4, float: forward, stack"),
        (lambda f: f.append(f[0] | {"function": "old"}), "not accepted: m4, float: old, which is not there any more"),
        (lambda f: f[0].update(code=0), "rise: m4, float: forward, code: 0 accepted, now 3000, there was none"),
    ],
)
def test_check_wants_every_figure(change: Callable[[Any], object], line: str, tmp_path: Path) -> None:
    run("cost", DEMO3, "-o", str(tmp_path))
    edit(tmp_path, lambda data: change(data["targets"][0]["functions"]))
    failed = run("cost", DEMO3, "-o", str(tmp_path), "--check")
    assert failed.exit_code == 1
    assert line in failed.stdout


@pytest.mark.parametrize("figure", ["12", True, None, -1, 1.5])
def test_figures_that_are_none_are_refused(figure: object, tmp_path: Path) -> None:
    run("cost", DEMO3, "-o", str(tmp_path))
    edit(tmp_path, lambda data: data["targets"][0]["functions"][0].update(stack=figure))
    assert "no figures of `mahovik cost`" in refused("cost", DEMO3, "-o", str(tmp_path), "--check")


def test_what_has_risen_is_not_written_until_it_is_accepted(folder: Path, functions: list[FunctionCost]) -> None:
    arguments = ("cost", DEMO3, "-o", str(folder))
    run(*arguments)
    before = contents(folder)
    functions[0] = replace(FUNCTIONS[0], stack=511)
    failed = run(*arguments)
    assert failed.exit_code == 1
    assert "rise: m4, float: forward, stack: 500 accepted, now 511" in failed.stdout
    assert contents(folder) == before
    assert run(*arguments, "--accept").exit_code == 0
    assert "| 511 |" in (folder / "COST.md").read_text()
    assert run(*arguments, "--check").exit_code == 0


def test_lower_figures_are_shown_but_the_accepted_stay(tmp_path: Path, functions: list[FunctionCost]) -> None:
    arguments = ("cost", DEMO3, "-o", str(tmp_path))
    run(*arguments)
    before = (tmp_path / "cost.json").read_bytes()
    functions[0] = replace(FUNCTIONS[0], stack=400)
    assert run(*arguments).exit_code == 0
    assert "| 400 |" in (tmp_path / "COST.md").read_text()
    assert (tmp_path / "cost.json").read_bytes() == before


def test_the_figures_as_json(folder: Path) -> None:
    result = run("cost", DEMO3, "-o", str(folder), "--json")
    assert result.exit_code == 0
    found = json.loads(result.stdout)
    assert found["stand"] == "demo3"
    assert [each["target"] for each in found["targets"]] == [name for name, _ in USUAL]
    assert json.loads((folder / "cost.json").read_text(encoding="utf-8")) == found


def test_targets_that_are_not_there_are_left_out_by_name(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(measuring, "require", require)
    monkeypatch.setattr(
        Target, "missing_commands", lambda target: ("qemu-system-arm",) if "cortex" in target.family else ()
    )
    result = run("cost", DEMO3, "-o", str(tmp_path))
    assert result.exit_code == 0
    lines = result.stderr.splitlines()
    assert [line.partition(": no ")[0] for line in lines] == ["left out: m4", "left out: m7"]
    assert all("apt-get install gcc-arm-none-eabi" in line for line in lines)
    assert "## RV64GC" in result.stdout
    assert "## Cortex" not in result.stdout
    assert list(tmp_path.iterdir()) == []
    assert run("cost", DEMO3, "-o", str(tmp_path), "--accept").exit_code == 0
    assert accepted(tmp_path) == [pair for pair in USUAL if pair[0].startswith("rv")]


def test_where_no_target_is_there_it_is_an_error(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(measuring, "require", require)
    monkeypatch.setattr(Target, "missing_commands", lambda target: ("gcc",))
    said = refused("cost", DEMO3, "-o", str(tmp_path))
    assert said.startswith("error: m4: no gcc: ")
    assert said.count("\n") == 1
