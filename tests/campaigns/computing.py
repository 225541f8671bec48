"""Computations for tests: sections of a campaign file as Python has them, and tables of samples."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import mahovik
from mahovik.core.motion.document import validate_table
from mahovik.core.stand.problems import Problems
from mahovik.errors import MahovikError, UsageError
from mahovik.out.api.editing import exact
from mahovik.out.api.tables import Tables
from mahovik.out.campaign.compute import Computation, prepare
from mahovik.out.campaign.over import OverTable
from mahovik.out.campaign.wanted import WantedTable

Keys = Mapping[str, Any]


def computation(stand: mahovik.Stand, run: Keys, quantities: Mapping[str, Keys], **options: Any) -> Computation:
    """The computation of these sections. Raises what is raised of the file."""
    problems = Problems("C.toml")
    over = validate_table(OverTable, exact(run), problems, "run")
    wanted = {
        name: validate_table(WantedTable, exact(keys), problems, f"quantity {name}")
        for name, keys in quantities.items()
    }
    if problems.lines:
        raise UsageError(problems.lines[0])
    assert over is not None
    return prepare(stand, over, {name: table for name, table in wanted.items() if table is not None}, **options)


def tables_of(own: Computation, changes: Mapping[str, Any]) -> Tables:
    """Tables of the stand of a computation."""
    return mahovik.build(own.stand).tables(changes)


def refusal(name: str, run: Keys, quantities: Mapping[str, Keys], folder: Path = Path()) -> str:
    """Message about sections that are refused: one line."""
    try:
        computation(mahovik.example(name), run, quantities, folder=folder)
    except MahovikError as error:
        assert "\n" not in str(error)
        return str(error)
    raise AssertionError("accepted")
