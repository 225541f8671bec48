"""`campaign`: many samples of a stand whose numbers vary, computed by many processes, and what they say."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Annotated

from mahovik.errors import whole_number
from mahovik.out.arguments import Folder, Progressing, command, reading
from mahovik.out.notices import Progress, notify
from mahovik.out.result import Result
from mahovik.writing import format_of, probe


@command(excludes={"chunk": ("scheduler", "workers", "merge", "report"), "scheduler": ("workers",)})
def campaign(
    file: Annotated[str | Path, "C.toml"],
    *,
    output: Folder,
    scheduler: Annotated[str, "ADDRESS"] | None = None,
    workers: int | None = None,
    chunk: int | None = None,
    merge: Annotated[str | Path, "FILE.parquet"] | None = None,
    report: Annotated[str | Path, "FILE.html"] | None = None,
    progress: Progressing = None,
) -> Result:
    """Compute many samples of a stand whose numbers vary; say how its quantities are spread.

    Computes what is missing of the campaign in the folder, chunk by chunk; a chunk that is there and whole is done. So
    the same command goes on after an interrupt, a crash or a killed worker, and may run on many machines at once. Rows
    are in rows/chunk-000017.parquet: the sample, the numbers that vary by their paths, the quantities, all in SI, and
    why a sample has none. They are the same to the bit with any number of workers.

    Args:
        file: the campaign file.
        output: keep the rows in this folder.
        scheduler: use the workers of this scheduler of dask, tcp://10.0.0.1:8786, which see the same files.
        workers: processes on this machine; default one for each core, and this one alone where that is sooner.
        chunk: compute this chunk alone, from 0, in this process: for job arrays.
        merge: write all rows into one Parquet file.
        report: write a page with quantiles, histograms and what they depend on.

    Raises:
        CampaignError: every problem of the file.
        UsageError: the folder has rows of another campaign, a file cannot be written.
        CheckError: the scheduler is gone; some chunks are missing.
    """
    from mahovik.out.campaign.chunks import compute, read_chunk, tables
    from mahovik.out.campaign.chunks import merge as merge_chunks
    from mahovik.out.campaign.file import load_campaign
    from mahovik.out.campaign.report import summarise, write_report

    for name, path, suffix in (("merge", merge, ".parquet"), ("report", report, ".html")):
        if path is not None:
            format_of(Path(path), (suffix,), name)
            probe(Path(path))
    if workers is not None:
        whole_number("workers", workers)
    campaign_ = reading("campaign", Path(file), load_campaign)
    folder = Path(output)
    wanted = range(campaign_.chunks) if chunk is None else [chunk]
    missing = [number for number in wanted if read_chunk(campaign_, folder, number) is None]
    if missing:
        notify(progress, Progress(f"{campaign_.name}: compiling {campaign_.stand.name}"))
        campaign_.rows(0, 0)  # refuses what it cannot compute, and compiles the C, before there are workers
    lost: dict[int, str] = {}
    done = len(wanted) - len(missing)
    try:
        for number, why in compute(campaign_, folder, missing, workers, scheduler):
            lost |= {number: why} if why else {}
            done += 1
            notify(progress, Progress(campaign_.name, float(done), float(len(wanted))))
    except KeyboardInterrupt:
        chunks = f"{done - len(lost)} of {len(wanted)} chunks are in {folder}"
        raise KeyboardInterrupt(f"{chunks}, and the same command goes on") from None
    whole = [number for number in wanted if number not in lost]
    result = summarise(campaign_, tables(campaign_, folder, whole), len(whole))
    if lost:
        messages = [f"chunk {number} is missing: {why}; run the campaign again" for number, why in lost.items()]
        return replace(result, messages=[*result.messages, *messages], ok=False)
    if merge is not None:
        merge_chunks(campaign_, folder, Path(merge))
    if report is not None:
        write_report(campaign_, result, Path(report))
    return result
