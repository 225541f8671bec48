"""The page: its sections in their order, written as those on stands."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from mahovik.errors import CheckError, MahovikError
from mahovik.out.campaign.dataset import status
from mahovik.out.campaign.report.query import Query
from mahovik.out.campaign.report.sections import overview, quantity, worst_samples
from mahovik.out.campaign.rows import Work
from mahovik.out.notices import OnProgress, Progress, tell
from mahovik.out.report.page import write_page
from mahovik.out.report.plots import require
from mahovik.writing import probe


@dataclass(frozen=True)
class CampaignReport:
    """A page that was written, and stand files of the samples with the largest quantities."""

    page: Path
    stands: tuple[Path, ...]


def write_report(
    folder: Path, work: Work, path: Path, *, worst: int, progress: OnProgress | None = None
) -> CampaignReport:
    """Write the page, and the stand files of the worst samples into `worst` of the folder.

    Rows that are missing are said on top of the page. Raises UsageError; CheckError: there are no rows.
    """
    require("report")
    probe(path)
    state = status(folder, progress)
    if not state.records:
        raise CheckError(f"{folder}: no rows yet; `mahovik campaign resume {folder}`")
    if state.damaged:
        raise CheckError(f"{folder}: {len(state.damaged)} shards are damaged; `mahovik campaign resume {folder}`")
    query = Query(folder, state)
    files = _write_stands(folder, work, query, worst)
    names = list(state.manifest.quantities)
    found = [overview(state, query)]
    for k, name in enumerate(names):
        tell(progress, Progress(f"quantity {name}", k, len(names)))
        section = quantity(work, query, name, worst)
        if section is not None:
            found.append(section)
    last = worst_samples(query, worst, {key: str(place.relative_to(folder)) for key, place in files.items()})
    found += [last] if last is not None else []
    files_read = [("campaign", Path(state.manifest.file).name)]
    write_page(path, state.manifest.name, found, stand=work.stand, files=files_read)
    return CampaignReport(path, tuple(dict.fromkeys(files.values())))


def _write_stands(folder: Path, work: Work, query: Query, most: int) -> dict[tuple[str, int], Path]:
    """Stand files of the samples with the largest quantities, by quantity and sample."""
    files = {}
    for name in query.manifest.quantities:
        for number, _ in query.largest(name, most):
            path = folder / "worst" / f"{work.stand.name}-{number}.toml"
            try:
                work.stand_of(number).save(path)
            except MahovikError:  # the stand of a sample that cannot be has no file
                continue
            files[name, number] = path
    return files
