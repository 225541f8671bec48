"""A run: moments of a backend collected in columns with units, and written to a CSV or Parquet file."""

from __future__ import annotations

import io
import json
import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from importlib import import_module
from pathlib import Path

import numpy as np

from mahovik.core.motion.laws import available_torque, required_torque
from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import WRENCH_LETTERS, Motor, Stand
from mahovik.errors import StateError, UsageError
from mahovik.use.simulate.case import Array, Case, Moment
from mahovik.use.simulate.held import coordinate_columns, coordinate_values, count_turns
from mahovik.writing import format_of, probe, write

_AXES = "xyz"


def column_names(stand: Stand, mounts: bool) -> list[str]:
    """Column names in order, each with its unit."""
    found = ["t [s]", *(f"{a} [m]" for a in _AXES), "qw", "qx", "qy", "qz"]
    found += [f"v_{a} [m/s]" for a in _AXES] + [f"omega_{a} [rad/s]" for a in _AXES]
    found += [f"v_dot_{a} [m/s2]" for a in _AXES] + [f"omega_dot_{a} [rad/s2]" for a in _AXES]
    for s in stand.flywheels:
        found += [f"phi {s.name} [rad]", f"phi_dot {s.name} [rad/s]", f"phi_ddot {s.name} [rad/s2]"]
        found.append(f"tau {s.name} [N m]")
        if s.motor is not None:
            found.append(f"motor {s.name} [N m]")
            if s.motor.torque is not None:
                found.append(f"margin {s.name} [N m]")
    if stand.hold is not None:
        found += [f"hold.reaction.{a} [{u}]" for a, u in zip("xyzkmn", ("N",) * 3 + ("N m",) * 3, strict=True)]
    found += coordinate_columns(stand)
    for name in (*(p.name for p in stand.instruments), *(p.name for p in stand.points)):
        found += [f"force_{a} {name} [m/s2]" for a in _AXES]
        found += [f"gyro_{a} {name} [rad/s]" for a in _AXES]
    if mounts:
        for s in stand.flywheels:
            units = ("N",) * 3 + ("N m",) * 3
            found += [f"mount_{a} {s.name} [{u}]" for a, u in zip(WRENCH_LETTERS, units, strict=True)]
    return found


def column_values(stand: Stand, moment: Moment) -> list[float]:
    """Numbers of these columns at one time."""
    state = moment.state
    found = [moment.t, *state.position, *(state.quaternion or (1.0, 0.0, 0.0, 0.0)), *state.V, *state.V_dot]
    for i, s in enumerate(stand.flywheels):
        tau, speed = float(moment.tau[i]), state.phi_dot[i]
        found += [float(moment.phi[i]), speed, state.phi_ddot[i], tau]
        if s.motor is not None:
            found += _motor(s.motor, tau, speed)
    if moment.reaction is not None:
        found += [float(x) for x in moment.reaction]
    found += coordinate_values(stand, state)
    for reading in moment.points.values():
        found += [float(x) for x in (*reading["specific_force"], *reading["twist"][3:])]
    if moment.mounts is not None:
        found += [float(x) for row in moment.mounts for x in row]
    return found


def _motor(motor: Motor, tau: float, speed: float) -> Iterator[float]:
    """Torque of the motor itself, and how much more it could give."""
    own = required_torque(motor, tau, speed)
    yield own
    if motor.torque is not None:
        most = available_torque(motor, own, speed)
        yield most - abs(own) if math.isfinite(most) else 0.0


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
    names = tuple(column_names(case.stand, mounts))
    rows: list[list[float]] = []
    stopped, interrupted = None, False
    try:
        for moment in _moments(case, backend, mounts):
            rows.append(column_values(case.stand, moment))
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
    count_turns(case.stand, dict(zip(names, data.T, strict=True)))
    return Run(names, data, stopped, interrupted, identity_of(case.stand))


def identity_of(stand: Stand) -> dict[str, str]:
    """Stand name and hashes of the run: `stand`, `structure`, `physics`."""
    found = identities(stand)
    return {"stand": stand.name, "structure": found.structure, "physics": found.physics}


def _moments(case: Case, backend: str, mounts: bool) -> Iterator[Moment]:
    if backend == "c":
        from mahovik.use.simulate.by_c import CMotion

        return CMotion(case).moments(mounts)
    if backend == "scipy":
        if case.real == "float" or case.carried:
            given = "--real float" if case.real == "float" else "--carried"
            raise UsageError(f"--backend scipy: not allowed with {given}")
        from mahovik.use.simulate.by_scipy import SciPyMotion

        return SciPyMotion(case).moments(mounts)
    raise UsageError(f"--backend {backend}: expected one of {', '.join(BACKENDS)}")


RUN_SUFFIXES = (".csv", ".parquet")

IDENTITY = "mahovik"
"""Metadata key in a Parquet file: an object with the stand's name, structure and physics. CSV has no metadata."""


def check_output(path: Path) -> str:
    """Check, before anything is computed, that the file can be written; return its format. Raises UsageError."""
    suffix = format_of(path, RUN_SUFFIXES)
    if suffix is None:
        raise UsageError(f"-o {path}: expected a name that ends in {' or '.join(RUN_SUFFIXES)}")
    if suffix == ".parquet":
        try:
            import_module("pyarrow.parquet")
        except ImportError:
            raise UsageError(f'-o {path}: Parquet needs pyarrow: pip install "mahovik[campaign]"') from None
    probe(path)
    return suffix


def save_run(run: Run, path: Path) -> None:
    """Write a run. Raises UsageError."""
    suffix = check_output(path)
    write(path, csv_text(run) if suffix == ".csv" else parquet_bytes(run))


def csv_text(run: Run) -> str:
    """A header of names, then a line per moment; the numbers read back to the same bits."""
    lines = [",".join(run.names), *(",".join(map(repr, row)) for row in run.data.tolist())]
    return "\n".join(lines) + "\n"


def parquet_bytes(run: Run) -> bytes:
    """A table of doubles, with the stand's identity as metadata under IDENTITY."""
    arrow, parquet = import_module("pyarrow"), import_module("pyarrow.parquet")
    table = arrow.table({name: run.data[:, i].copy() for i, name in enumerate(run.names)})
    if run.identity:
        table = table.replace_schema_metadata({IDENTITY: json.dumps(dict(run.identity))})
    buffer = io.BytesIO()
    parquet.write_table(table, buffer)
    return buffer.getvalue()
