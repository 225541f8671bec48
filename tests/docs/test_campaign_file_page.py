"""docs/campaign-file.md: its files are campaigns, its keys, distributions, designs and signals those of the reader."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from docs.pages import ROOT, Block, blocks, cells, tables
from mahovik.out.campaign.campaign import Campaign
from mahovik.out.campaign.designs import DESIGNS
from mahovik.out.campaign.file import CampaignTable, load_campaign
from mahovik.out.campaign.over import KINDS as RUNS
from mahovik.out.campaign.vary import KINDS

PAGE = ROOT / "docs" / "campaign-file.md"
FILES = [block for block in blocks(PAGE) if block.language == "toml"]


def names(first: str, column: int = 0) -> list[str]:
    """Names in a column of the table whose head begins with `first`."""
    (found,) = (lines for lines in tables(PAGE) if cells(lines[0])[0] == first)
    return [name for line in found[2:] for name in re.findall(r"`\"?([\w-]+)\"?`", cells(line)[column])]


def write(block: Block, folder: Path) -> Path:
    path = folder / (block.file or "C.toml")
    path.write_text(block.text, encoding="utf-8")
    return path


@pytest.mark.parametrize("block", FILES, ids=lambda block: block.file)
def test_the_files_are_campaigns(block: Block, tmp_path: Path) -> None:
    found = load_campaign(write(block, tmp_path))
    assert found.draw.parameters
    assert found.table.quantity


@pytest.mark.slow
@pytest.mark.parametrize("block", FILES, ids=lambda block: block.file)
def test_the_campaigns_give_rows(block: Block, tmp_path: Path) -> None:
    campaign = Campaign.load(write(block, tmp_path))
    rows = campaign.rows(0, 3)
    assert not any(rows.reason)
    for column in rows.quantities.values():
        assert len(np.unique(column)) == 3


def test_the_tables_are_those_of_the_reader() -> None:
    keys = [lines for lines in tables(PAGE) if cells(lines[0])[0] == "key"]
    first, second = ([cells(line)[0] for line in lines[2:]] for lines in keys)
    told = {name for cell in first for name in re.findall(r"`(\w+)`", cell)}
    assert told == {"schema", *CampaignTable.model_fields}
    assert [cell.strip("`") for cell in second] == list(KINDS)
    assert names("design") == list(DESIGNS)
    assert names("key of `[over]`") == list(RUNS)
    (runs,) = (lines for lines in tables(PAGE) if cells(lines[0])[0] == "key of `[over]`")
    for line, further in zip(runs[2:], RUNS.values(), strict=True):
        assert tuple(re.findall(r"`(\w+)`", cells(line)[2])) == further


def test_paths_of_the_page_are_found() -> None:
    from api.models import stand
    from identify.test_excite_held import STICK
    from mahovik.errors import UsageError
    from mahovik.out.api.stands import Stand
    from mahovik.out.campaign.places import Places

    (lines,) = (lines for lines in tables(PAGE) if cells(lines[0])[0] == "path")
    paths = [path for line in lines[2:] for path in re.findall(r'`"([^"]+)"`', cells(line)[0])]
    assert len(paths) > 8
    places = [Places(Stand.of(stand(name))) for name in ("sat4", "remus6", "everything")]
    hold = {**STICK["hold"], "pivot": [0, 0, 0.1], "angles": [0, 0, 0]}
    places.append(Places(Stand.from_dict({**STICK, "hold": hold})))
    for path in paths:
        found = 0
        for each in places:
            try:
                found += len(each.find(path))
            except UsageError:
                continue
        assert found, path
