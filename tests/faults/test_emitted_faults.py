"""Every fault that is planted in emitted C is caught by the checks that it names; they find nothing without it."""

from __future__ import annotations

from pathlib import Path

import pytest

from faults.catalogue import FAULTS
from faults.checks import CHECKS, outcome
from faults.emitted import Emitted, Host
from faults.fault import Fault, planted

QUICK = (
    "NaN let through: a comparison turned round",
    "swapped sign in one harmonic",
    "second pivot not tested",
    "angle guard a thousand times too narrow",
)
"""Faults that `make test` plants; `make test-slow` plants a part of the others, `make test-all` all."""

USED = sorted({(fault.host, name) for fault in FAULTS for name in fault.caught_by}, key=str)


def test_the_catalogue_is_whole() -> None:
    names = [fault.name for fault in FAULTS]
    assert len(names) == len(set(names)) >= 50
    assert all(fault.caught_by for fault in FAULTS)
    assert {name for fault in FAULTS for name in fault.caught_by} == set(CHECKS)  # no check that catches nothing
    assert set(QUICK) <= set(names)


def test_a_fault_that_is_not_in_the_text_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(AssertionError, match="0 hits"):
        planted(Fault("none", "", (), "forward", "no such text", ""), tmp_path)


def caught(fault: Fault, folder: Path) -> None:
    made = planted(fault, folder)
    for name in fault.caught_by:
        assert outcome(name, made), f"{fault.name} is not caught by {name}"


@pytest.mark.parametrize("name", QUICK)
def test_a_quick_choice_is_caught(name: str, tmp_path: Path) -> None:
    (fault,) = (fault for fault in FAULTS if fault.name == name)
    caught(fault, tmp_path)


@pytest.mark.slow
@pytest.mark.parametrize("fault", [f for f in FAULTS if f.name not in QUICK], ids=lambda f: f.name)
def test_every_fault_is_caught(fault: Fault, tmp_path: Path) -> None:
    caught(fault, tmp_path)


@pytest.mark.slow
@pytest.mark.parametrize(("host", "name"), USED, ids=str)
def test_checks_pass_without_a_fault(host: Host, name: str, tmp_path: Path) -> None:
    assert outcome(name, Emitted(host, tmp_path)) == ""
