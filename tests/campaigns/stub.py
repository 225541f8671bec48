"""A campaign of arithmetic alone: rows that are known, and a file that processes can read it from."""

from __future__ import annotations

import hashlib
import json
import os
import signal
import time
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import mahovik
from mahovik.errors import UsageError
from mahovik.out.campaign.convergence import Goal
from mahovik.out.campaign.rows import Rows
from mahovik.out.campaign.sensitivity import Sensitivity

POISON = "no such body"


@dataclass(frozen=True)
class Stub:
    """Samples 0, 1, ...: a parameter drawn for each by its number, and its square root; negative ones are poison.

    pause    s for a shard
    killer   a file; while it exists, shard 0 ends the process that computes it
    once     the file is then removed
    """

    path: Path
    samples: int
    shard_size: int
    seed: int = 1
    pause: float = 0.0
    killer: str = ""
    once: bool = True
    stand_file: str = ""
    goal: Goal | None = None
    has_quantiles: bool = True

    @property
    def name(self) -> str:
        return "stub"

    @property
    def stand(self) -> mahovik.Stand:
        return mahovik.load(self.path.parent / self.stand_file) if self.stand_file else mahovik.example("shaker2")

    @property
    def identity(self) -> Mapping[str, str]:
        stand = json.dumps(self.stand.to_dict(), default=float)
        deciding = {"samples": self.samples, "seed": self.seed}
        known = {"stand": stand, "campaign": json.dumps(deciding)}
        hashes = {key: hashlib.sha256(text.encode()).hexdigest() for key, text in known.items()}
        return hashes | {"version": mahovik.__version__, "seed": str(self.seed)}

    @property
    def parameters(self) -> Mapping[str, str]:
        return {"carrier.mass": "kg"}

    @property
    def quantities(self) -> Mapping[str, str]:
        return {"root": "1", "double": "kg"}

    def rows(self, first: int, count: int) -> Rows:
        if self.killer and first == 0 and (self.path.parent / self.killer).exists():
            if self.once:
                (self.path.parent / self.killer).unlink()
            os.kill(os.getpid(), signal.SIGKILL)
        time.sleep(self.pause)
        sample = np.arange(first, first + count)
        drawn = np.array([self.draw(int(k)) for k in sample])
        with np.errstate(invalid="ignore"):
            root = np.sqrt(drawn)
        bad = drawn < 0.0
        reason = [f"{POISON}, sample {k}" if wrong else "" for k, wrong in zip(sample, bad, strict=True)]
        found = {"root": np.where(bad, np.nan, root), "double": np.where(bad, np.nan, 2.0 * drawn)}
        return Rows(sample, {"carrier.mass": drawn}, found, reason)

    def draw(self, sample: int) -> float:
        return float(np.random.Generator(np.random.Philox(key=self.seed, counter=sample << 64)).normal(1.0, 1.0))

    def stand_of(self, number: int) -> mahovik.Stand:
        return self.stand.replace({"carrier.mass": self.draw(number)})

    def sensitivity(self, values: NDArray[np.float64]) -> Sensitivity:
        raise UsageError("sensitivity: the design has none")


def write_stub(path: Path, **values: Any) -> Path:
    """Write the file of a campaign."""
    path.write_text(json.dumps(values))
    return path


def load_stub(path: Path, shard_size: int | None = None, computing: bool = True) -> Stub:
    """Read it: what processes get instead of the reader of campaign files."""
    known = json.loads(path.read_text())
    within = known.pop("within", None)
    goal = None if within is None else Goal("root", 0.9, 0.95, within)
    return Stub(path, goal=goal, **(known if shard_size is None else {**known, "shard_size": shard_size}))
