"""Campaign files for tests, and computations of their sections with tables of samples."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import mahovik
from mahovik.core.stand.numbers import exact
from mahovik.core.stand.problems import Problems
from mahovik.errors import CampaignError, UsageError
from mahovik.out.api.tables import Tables
from mahovik.out.campaign.compute import Computation, prepare
from mahovik.out.campaign.file import CampaignFile, load_campaign
from mahovik.out.campaign.over import OverTable
from mahovik.out.campaign.wanted import WantedTable

Keys = Mapping[str, Any]


def computation(stand: mahovik.Stand, run: Keys, quantities: Mapping[str, Keys], **options: Any) -> Computation:
    """The computation of these sections. Raises what is raised of the file."""
    problems = Problems("C.toml")
    over = problems.valid(OverTable, exact(run), "run")
    wanted = {name: problems.valid(WantedTable, exact(keys), f"quantity {name}") for name, keys in quantities.items()}
    if problems.lines:
        raise UsageError(problems.lines[0])
    assert over is not None
    return prepare(stand, over, {name: table for name, table in wanted.items() if table is not None}, **options)


def tables_of(base: Computation, changes: Mapping[str, Any]) -> Tables:
    """Tables of the stand of a computation."""
    return mahovik.build(base.stand).tables(changes)


HEAD = 'schema = 1\nstand = "{stand}"\nsamples = {samples}\nseed = {seed}\ndesign = "{design}"\n'


RUN = """
[over]
regime = { default = { speed = "1000 rpm" } }
until = "5 ms"
dt = "1 ms"
every = "1 ms"
[[quantity]]
name = "shake"
what = "rms velocity"
at = "carrier"
"""


VARY = """
[vary]
"w*.unbalance.static" = { normal = ["1 g mm", "0.5 g mm"] }
"w*.unbalance.static_at" = { uniform = ["0 deg", "360 deg"] }
"carrier.inertia.J12" = { tolerance = 1e-4 }
"carrier.mass" = { normal = [10, 1] }
"""


def write(
    folder: Path, body: str, *, stand: str = "sat4", samples: int = 2000, seed: int = 7, design: str = "random"
) -> Path:
    """Write a campaign file: a head, then `body`, which begins with keys or with [vary]."""
    path = folder / "C.toml"
    path.write_text(HEAD.format(stand=stand, samples=samples, seed=seed, design=design) + body, encoding="utf-8")
    return path


def read(folder: Path, body: str, **head: object) -> CampaignFile:
    """The campaign of such a file."""
    return load_campaign(write(folder, body, **head))  # type: ignore[arg-type]  # keys of the head, by name


def refusal(folder: Path, body: str, **head: object) -> str:
    """Message of the reader on a file that it refuses: one line."""
    try:
        read(folder, body, **head)
    except CampaignError as error:
        text = str(error)
        assert text.startswith("C.toml: "), text
        assert "\n" not in text, text
        return text
    raise AssertionError("accepted")
