"""cost: where it writes, and what it leaves out. What is measured is made up here."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from functools import cache
from pathlib import Path
from types import SimpleNamespace

import pytest

from cli.run import DEMO3, refused, run
from mahovik.core.emit.delivered import deliver
from mahovik.core.emit.delivery import delivery as delivered
from mahovik.core.stand import load
from mahovik.core.stand.model import Stand
from mahovik.core.toolchain.targets import Target, require
from mahovik.proof import cost as measuring
from mahovik.proof.cost import USUAL, Costs, FunctionCost, TargetCost
from mahovik.stands import path

FUNCTIONS = (FunctionCost("forward", 1000, 500, 490, 3000, ()), FunctionCost("inverse", 9000, 0, 0, 4000, ()))


@pytest.fixture(autouse=True)
def functions(monkeypatch: pytest.MonkeyPatch) -> list[FunctionCost]:
    """Figures of the functions on every target: to be changed by a test."""
    names = list(FUNCTIONS)

    def measure(
        stand: Stand,
        pairs: Sequence[tuple[Target, str]],
        progress: Callable[[int, int], None],
        only: tuple[str, ...],
        recorder: bool,
    ) -> Costs:
        targets = [
            TargetCost(
                *(target.name, target.title, real, "0" * 64, "gcc 1.2.3", "-O2", "qemu 7.2.0"),
                *(tuple(names), 5000, {}, 8),
            )
            for target, real in pairs
        ]
        return Costs(stand.name, "0", "1", tuple(targets))

    monkeypatch.setattr(measuring, "measure", measure)
    monkeypatch.setattr(measuring, "require", lambda target: None)
    return names


@cache
def generated_files(name: str, real: str) -> dict[str, str]:
    """The C of an example stand, made once."""
    return delivered(load(path(name)), real)


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The C of demo3 with its manifest."""

    def made(stand: Stand, real: str, only: tuple[str, ...]) -> SimpleNamespace:
        return SimpleNamespace(files=generated_files(stand.name, real))

    monkeypatch.setattr(measuring, "generate_all", made)
    deliver(tmp_path / "out", load(DEMO3), generated_files("demo3", "double"))
    return tmp_path / "out"


def contents(folder: Path) -> dict[str, bytes]:
    return {p.name: p.read_bytes() for p in folder.iterdir()}


def test_the_page_lies_beside_the_delivery(folder: Path) -> None:
    result = run("verify", DEMO3, str(folder), "--cost", "--json")
    assert result.exit_code == 0
    assert [(t["target"], t["real"]) for t in json.loads(result.stdout)["targets"]] == list(USUAL)
    assert "COST.md" in contents(folder)
    assert "COST.md" not in json.loads((folder / "manifest.json").read_text())["files"]
    before = contents(folder)
    assert run("verify", DEMO3, str(folder), "--cost").exit_code == 0
    assert contents(folder) == before


@pytest.mark.parametrize("everything", [False, True])
def test_targets_that_are_not_there_are_left_out_by_name(
    everything: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """If no target is there, that is an error."""

    def missing(target: Target) -> tuple[str, ...]:
        return ("qemu-system-arm",) if everything or "cortex" in target.family else ()

    monkeypatch.setattr(measuring, "require", require)
    monkeypatch.setattr(Target, "missing_commands", missing)
    if everything:
        assert refused("verify", DEMO3, str(tmp_path), "--cost").startswith("error: m4: no qemu-system-arm: ")
        return
    result = run("verify", DEMO3, str(tmp_path), "--cost", "--json")
    assert result.exit_code == 0
    assert [line.partition(": no ")[0] for line in result.stderr.splitlines()] == [
        f"warning: left out: {x}" for x in ("m4", "m7")
    ]
    measured = [(t["target"], t["real"]) for t in json.loads(result.stdout)["targets"]]
    assert measured == [pair for pair in USUAL if pair[0].startswith("rv")]
