"""Commands are thin layers: each calls the function of Python of its name, and has an option for each argument."""

from __future__ import annotations

import importlib
import inspect
from pathlib import Path

import click
import pytest

import mahovik
from cli.run import refused
from mahovik import stands
from mahovik.errors import UsageError
from mahovik.out.cli import main

SHAKER2 = str(stands.path("shaker2"))
SPIN = str(Path(SHAKER2).parent / "shaker2_spin.motion.json")

CALLS: dict[str, tuple[str, ...]] = {
    "simulate": ("--until", "1", "-o", "run.csv"),
    "follow": ("--programme", "p.json", "--motion", SPIN, "--servo", "s.toml"),
    "response": ("--speed", "left=100rpm", "--at", "carrier"),
    "jitter": ("--speed", "left=100rpm", "--at", "carrier"),
    "quiet": ("--point", "base", "--band", "1..2Hz", "--momentum", "0 0 0"),
    "balance": ("--influence", "rotor.json"),
    "balance_stand": ("--data", "run.csv"),
    "identify": ("--data", "run.csv", "--free", "carrier.mass", "-o", "new.toml"),
    "rest": (),
    "modes": (),
    "linearize": ("-o", "model.json"),
    "plan": ("--motion", SPIN, "-o", "p.json"),
    "excite": ("-o", "p.json"),
    "verify_programme": ("--motion", SPIN, "--programme", "p.json"),
    "design": ("--motion", SPIN, "--free", "unbalance", "-o", "out.toml"),
    "generate": (),
    "verify": (),
    "judge": ("--with", "true"),
    "report": ("-o", "report.html"),
}
"""Function: arguments of its command after the stand."""

COMMANDS = {"balance_stand": "balance", "follow": "simulate", "verify_programme": "verify-programme"}
"""Commands of other names than their function's."""

NO_STAND = ("balance",)
"""Functions without a stand."""

OTHERWISE = {
    "table": "table", "go_on": "seconds", "speeds": "speeds", "locked": "flywheels", "at": "point", "modes": "avoid",
    "run": "run_file", "programme": "programme_file", "motion": "motion_file", "cost": "cost_folder",
    "folder": "output", "judges": "judges", "against": "against",
}  # fmt: skip
"""Argument of a function: the parameter of the command, where it has another name."""


def test_every_function_of_a_command_is_listed() -> None:
    functions = {name for name in vars(mahovik)["__all__"] if inspect.isfunction(getattr(mahovik, name))}
    assert functions - set(CALLS) == {"build", "example", "examples", "identifiable", "load"}


@pytest.mark.parametrize("name", CALLS)
def test_the_command_calls_the_function(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    function = getattr(mahovik, name)

    def reached(*_: object, **__: object) -> None:
        raise UsageError(f"{name} was called")

    monkeypatch.setattr(importlib.import_module(function.__module__), name, reached)
    stand = () if name in NO_STAND else (SHAKER2,)
    assert f"error: {name} was called\n" in refused(COMMANDS.get(name, name), *stand, *CALLS[name])


@pytest.mark.parametrize("name", CALLS)
def test_every_argument_is_an_option(name: str) -> None:
    command = main.commands[COMMANDS.get(name, name)]
    assert isinstance(command, click.Command)
    options = {parameter.name for parameter in command.params}
    for argument in inspect.signature(getattr(mahovik, name)).parameters:
        if argument not in ("stand", "progress"):
            assert argument in options or OTHERWISE.get(argument) in options, argument
