"""A run: moments of a backend collected in columns; an interrupted run keeps what was computed."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import numpy as np

from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand
from mahovik.errors import StateError, UsageError
from mahovik.use.simulate import columns
from mahovik.use.simulate.case import Array, Case
from mahovik.use.simulate.moment import Motion

BACKENDS = ("c", "scipy")


@dataclass(frozen=True, eq=False)
class Run:
    """Columns by name. `stopped`: why it ended early, or None; `interrupted`: whether the user stopped it.

    `identity`: name and identities of the stand, as `identity_of` gives them; a file of columns may carry them.
    """

    names: tuple[str, ...]
    data: Array
    stopped: str | None = None
    interrupted: bool = False
    identity: Mapping[str, str] = field(default_factory=dict)

    def __getitem__(self, name: str) -> Array:
        """A column by its full name, including the unit."""
        return np.asarray(self.data[:, self.names.index(name)])

    @property
    def weak_motors(self) -> dict[str, tuple[float, float]]:
        """Flywheels with too weak a motor: time of the worst moment (s), missing torque (N m)."""
        found = {}
        for name in self.names:
            if name.startswith("margin ") and len(self.data):
                worst = int(np.argmin(self[name]))
                missing = -float(self[name][worst])
                if missing > 1e-12:
                    found[name.split()[1]] = (float(self.data[worst, 0]), missing)
        return found


def simulate(
    case: Case, backend: str = "c", mounts: bool = False, progress: Callable[[float], None] | None = None
) -> Run:
    """Run a case. `progress` receives each time of output. Raises UsageError, ToolchainError, StateError.

    A motion that leaves its ranges and Ctrl-C end the run early: `stopped` says why. If there is nothing to keep,
    StateError and KeyboardInterrupt are raised.
    """
    motion = _motion(case, backend)
    names = tuple(columns.column_names(case.stand, mounts))
    rows: list[list[float]] = []
    stopped, interrupted = None, False
    try:
        for moment in motion.moments(mounts):
            rows.append(columns.column_values(case.stand, moment))
            if progress is not None:
                progress(moment.t)
    except StateError as error:
        if not rows:
            raise
        stopped = str(error)
    except KeyboardInterrupt:
        if not rows:
            raise
        stopped, interrupted = f"stopped at t = {rows[-1][0]:.6g} s of {case.until:g} s", True
    data = np.array(rows, dtype=np.float64).reshape(len(rows), len(names))
    return Run(names, data, stopped, interrupted, identity_of(case.stand))


def identity_of(stand: Stand) -> dict[str, str]:
    """Stand name and hashes of the run: `stand`, `structure`, `physics`."""
    found = identities(stand)
    return {"stand": stand.name, "structure": found.structure, "physics": found.physics}


def _motion(case: Case, backend: str) -> Motion:
    if backend == "c":
        from mahovik.use.simulate.by_c import CMotion

        return CMotion(case)
    if backend == "scipy":
        from mahovik.use.simulate.by_scipy import SciPyMotion

        return SciPyMotion(case)
    raise UsageError(f"--backend {backend}: expected one of {', '.join(BACKENDS)}")
