"""Campaigns in Python: what the commands `mahovik campaign ...` do."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from mahovik.out.campaign import dataset, folder
from mahovik.out.campaign.cluster import require_scheduler
from mahovik.out.campaign.engine import Outcome, run_shards
from mahovik.out.campaign.folder import Load, load_campaign
from mahovik.out.campaign.manifest import Manifest, read_manifest
from mahovik.out.campaign.reached import Accuracy
from mahovik.out.campaign.rows import Rows, Work
from mahovik.out.campaign.shards import Record, read_shard

if TYPE_CHECKING:
    from mahovik.out.campaign.report.page import CampaignReport
    from mahovik.out.notices import OnProgress

WORST = 3
"""Samples with the largest value of each quantity that a report writes as stand files."""


class Campaign:
    """A campaign file, checked: what varies in a stand, and what is computed of each sample.

    Raises CampaignError with every problem of the file.
    """

    def __init__(self, file: str | Path, *, load: Load = load_campaign) -> None:
        self._file, self._load = Path(file), load
        self._work: Work = load(Path(file), None, True)

    @staticmethod
    def open(folder: str | Path) -> CampaignFolder:
        """The folder of a campaign that was begun. Raises UsageError."""
        return CampaignFolder(folder)

    @property
    def name(self) -> str:
        """Name of the campaign."""
        return self._work.name

    @property
    def samples(self) -> int:
        """Number of samples."""
        return self._work.samples

    @property
    def shard_size(self) -> int:
        """Samples a shard."""
        return self._work.shard_size

    @property
    def parameters(self) -> Mapping[str, str]:
        """Units of what is drawn, by name."""
        return self._work.parameters

    @property
    def quantities(self) -> Mapping[str, str]:
        """Units of what is computed, by name."""
        return self._work.quantities

    def rows(self, first: int, count: int) -> Rows:
        """Compute some samples here and now; nothing is kept."""
        return self._work.rows(first, count)

    def prepare(self, out: str | Path) -> CampaignFolder:
        """Begin a folder without computing anything. Raises UsageError: rows of another campaign are in it."""
        folder.begin(Path(out), self._file, self._work)
        return CampaignFolder(out, load=self._load, work=self._work)

    def run(
        self,
        out: str | Path,
        *,
        workers: int | None = None,
        scheduler: str | None = None,
        progress: OnProgress | None = None,
    ) -> Outcome:
        """Compute all samples that the folder does not have.

        out        folder, new or of the same campaign
        workers    number of processes on this machine; None: one for each core
        scheduler  address of a scheduler of dask whose workers see the same folder; None: this machine

        A script that calls this needs `if __name__ == "__main__":` around it, as each worker imports the script.
        Raises UsageError; CheckError: the scheduler is gone.
        """
        return self.prepare(out).resume(workers=workers, scheduler=scheduler, progress=progress)


class CampaignFolder:
    """Folder of a campaign that was begun. Raises UsageError: no campaign was begun there."""

    def __init__(self, path: str | Path, *, load: Load = load_campaign, work: Work | None = None) -> None:
        """`load` reads campaign files, `work` is the campaign if it has been read."""
        self.path = Path(path)
        self._load, self._read = load, work
        self.manifest: Manifest = read_manifest(self.path)

    def shard(self, number: int) -> Record:
        """Compute one shard in this process, unless it is there and whole. Raises UsageError."""
        return folder.make_shard(self.path, number, self._load)

    def resume(
        self, *, workers: int | None = None, scheduler: str | None = None, progress: OnProgress | None = None
    ) -> Outcome:
        """Compute the shards that are missing or damaged; arguments as of `Campaign.run`."""
        if scheduler is not None:
            require_scheduler(scheduler)
        goal = self._work(computing=True).goal
        accuracy = None if goal is None else Accuracy(goal)
        return run_shards(
            self.path, workers=workers, scheduler=scheduler, load=self._load, accuracy=accuracy, progress=progress
        )

    def _work(self, computing: bool) -> Work:
        return self._read or folder.open_work(self.path, self._load, computing)

    def status(self, progress: OnProgress | None = None) -> dataset.Status:
        """State of the folder: every shard is read and checked."""
        return dataset.status(self.path, progress)

    def merge(self, path: str | Path, progress: OnProgress | None = None) -> int:
        """Write all rows into one Parquet file; return their number. Raises CheckError: some are missing."""
        return dataset.merge(self.path, Path(path), progress)

    def report(self, path: str | Path, *, worst: int = WORST, progress: OnProgress | None = None) -> CampaignReport:
        """Write a page on the rows, and the stand files of the `worst` samples of each quantity into the folder.

        Functions of the campaign file are not imported: a folder of somebody else is data.
        """
        from mahovik.out.campaign.report.page import write_report

        return write_report(self.path, self._work(computing=False), Path(path), worst=worst, progress=progress)

    def columns(self) -> dict[str, NDArray[Any]]:
        """All rows so far: arrays by the names of the columns. Raises DamagedError."""
        manifest, parts = read_manifest(self.path), []
        for number in range(manifest.shards):
            try:
                parts.append(read_shard(self.path, manifest, number))
            except FileNotFoundError:
                continue
        names = ["sample", *manifest.parameters, *manifest.quantities, "error"]
        return {
            name: np.concatenate([part.column(name).to_numpy(zero_copy_only=False) for part in parts] or [np.empty(0)])
            for name in names
        }
