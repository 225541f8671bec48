"""Record of a closed loop, a row per sample, and the accuracy of following: error of each coordinate, a total.

A stand that differs from its file hangs at a slightly different mean pose. Flywheels cannot correct that: they have no
mean wrench. So the error is that of the motion about its mean, and the mean is reported separately.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from mahovik.core.stand.coordinates import Coordinates, coordinates_of
from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.errors import CheckError
from mahovik.proof.verify.programme.mechanics import Scale, scale_of, twist
from mahovik.use.control.plant import Plant
from mahovik.use.control.reference_motion import ReferenceMotion
from mahovik.use.numeric import Array
from mahovik.use.simulate.run import Run, identity_of

_AXES = "xyz"
_ANGLES = ("psi", "theta", "phi")


@dataclass(eq=False)
class Record:
    """Rows at the samples; fewer if the run ended early. `stopped`: why it did, or None.

    t (M, s), position (M, 3), attitude (M, 4), V (M, 6), phi, phi_dot (M, N each): the true state
    tau           (M, N; N m): of motors and friction, during the step that ends there
    q, required   (M, 6; held M, m): the carrier's coordinates, actual and required; m, rad
    apart         (M, N; rad): of the flywheels from the programme with its corrections
    command       (M, N; N m): of the servos
    corrections   (M, N, T; rad): of the trim
    rounds, limited   corrections made; samples in which a torque was cut
    """

    reference: ReferenceMotion
    start: State
    t: Array
    position: Array
    attitude: Array
    V: Array
    phi: Array
    phi_dot: Array
    tau: Array
    q: Array
    required: Array
    apart: Array
    command: Array
    corrections: Array
    stopped: str | None = None
    interrupted: bool = False
    rounds: int = 0
    limited: int = 0

    @staticmethod
    def empty(wanted: ReferenceMotion, first: int, last: int, period: float, start: State) -> Record:
        """An empty record for samples with these numbers."""
        t: Array = period * np.arange(first, last + 1, dtype=np.float64)
        M, N, count = len(t), len(wanted.stand.flywheels), coordinates_of(wanted.stand).count

        def rows(width: int) -> Array:
            return np.zeros((M, width))

        return Record(
            wanted, start, t, rows(3), rows(4), rows(6), rows(N), rows(N), rows(N), rows(count), rows(count), rows(N),
            rows(N), np.zeros((M, N, 1)),
        )  # fmt: skip

    def write_row(
        self, n: int, t: float, own: Plant, q: Array, required: Array, apart: Array, command: Array, corrections: Array
    ) -> None:
        """Keep the plant and its firmware at t (s) as row n; the first row tells how many corrections there are."""
        if n == 0 and corrections.shape != self.corrections.shape[1:]:
            self.corrections = np.zeros((len(self.t), *corrections.shape))
        self.t[n] = t
        self.position[n], self.attitude[n], self.V[n] = own.position, own.attitude, own.V
        self.phi[n], self.phi_dot[n], self.tau[n] = own.phi, own.phi_dot, own.tau
        self.q[n], self.required[n], self.apart[n], self.command[n] = q, required, apart, command
        self.corrections[n] = corrections

    def end(self, rows: int, why: str) -> None:
        """Keep only the first rows."""
        for name, value in vars(self).items():
            if isinstance(value, np.ndarray):
                setattr(self, name, value[:rows])
        self.stopped = why

    def run(self) -> Run:
        """The record as columns with units: those of `mahovik simulate` and the required motion."""
        stand = self.reference.stand
        names = [f"{a} [m]" for a in _AXES] + ["qw", "qx", "qy", "qz"]
        names += [f"v_{a} [m/s]" for a in _AXES] + [f"omega_{a} [rad/s]" for a in _AXES]
        if stand.hold is None:
            names += [*(f"{a} [rad]" for a in _ANGLES), *(f"required_{a} [m]" for a in _AXES)]
            names += [f"required_{a} [rad]" for a in _ANGLES]
        else:
            own = coordinates_of(stand)
            units = [f" [{unit}]" if unit else "" for unit in own.unit_names]
            names += [
                f"{kind} {a}{unit}" for kind in ("q", "required") for a, unit in zip(own.names, units, strict=True)
            ]
        q = self.q[:, 3:] if stand.hold is None else self.q
        parts = [self.position, self.attitude, self.V, q, self.required]
        kinds = (
            ("phi", "rad", self.phi), ("phi_dot", "rad/s", self.phi_dot), ("tau", "N m", self.tau),
            ("apart", "rad", self.apart), ("command", "N m", self.command),
        )  # fmt: skip
        for kind, unit, columns in kinds:
            names += [f"{kind} {s.name} [{unit}]" for s in stand.flywheels]
            parts.append(columns)
        data = np.hstack([self.t[:, None], *parts])
        return Run(("t [s]", *names), data, self.stopped, self.interrupted, identity_of(stand))


HARMONICS = 6
"""Harmonics of the error, at least; more if the motion has more."""

STILL = 1e-9
"""m, rad: a coordinate with a smaller amplitude is held still."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Errors:
    """Errors of following a required motion (all in m and rad), six; of a held carrier one a freedom.

    coordinates  that these are of
    amplitude  (6): of the required motion
    peak, rms  (6): of the error
    share, share_rms   largest and root mean square of the error of all six together, by the inertia's norm, as shares
               of the largest of the motion: no choice of units or axes changes them (`Scale` of proof/verify/programme)
    apart      (N): largest distance of the flywheels from the programme, rad
    """

    coordinates: Coordinates
    amplitude: Array
    peak: Array
    rms: Array
    share: float
    share_rms: float
    apart: Array

    def shares(self) -> list[float | None]:
        """Peak errors over each coordinate's own amplitude; None for one that is held still."""
        return [float(p / a) if a > STILL else None for p, a in zip(self.peak, self.amplitude, strict=True)]

    def as_json(self) -> Mapping[str, Any]:
        """The object for `--json`, in SI."""
        return self._object({})

    def _object(self, of_coordinates: Mapping[str, Array]) -> dict[str, Any]:
        """That object with more values of each coordinate; the first axis of these counts the coordinates."""
        values = {"amplitude": self.amplitude, "peak": self.peak, "rms": self.rms, **of_coordinates}
        return {
            "error": self.share,
            "error_rms": self.share_rms,
            "coordinates": {
                name: {"share": share, **{key: value[i].tolist() for key, value in values.items()}}
                for i, (name, share) in enumerate(zip(self.coordinates.names, self.shares(), strict=True))
            },
            "flywheels_apart": self.apart.tolist(),
        }


@dataclass(frozen=True, eq=False, kw_only=True)
class Following(Errors):
    """Errors over the last `periods` whole periods of a run, about their mean; so is the amplitude of the motion.

    mean       (6): of the error
    harmonics  (K, 6): amplitudes of the error at harmonics 1..K of the programme
    """

    periods: int
    mean: Array
    harmonics: Array

    def as_json(self) -> Mapping[str, Any]:
        """See Errors."""
        return {"periods": self.periods, **self._object({"mean": self.mean, "harmonics": self.harmonics.T})}


def following(record: Record, periods: int) -> Following:
    """Errors of a run. Raises CheckError if it is shorter than `periods` periods of the programme."""
    wanted = record.reference
    span, step = wanted.motion.span, float(record.t[1] - record.t[0]) if len(record.t) > 1 else np.inf
    rows = round(periods * span / step)
    if rows >= len(record.t):
        raise CheckError(f"the run ended at t = {record.t[-1] if len(record.t) else 0:.6g} s, before {periods} periods")
    last = slice(len(record.t) - 1 - rows, len(record.t) - 1)
    q, required = record.q[last], record.required[last]
    error = q - required
    K = max(HARMONICS, *wanted.motion.harmonics, 1)
    terms = _waves(record.t[last] / span, min(K, max(1, round(span / step) // 2 - 1)))
    found = np.linalg.lstsq(terms, error, rcond=None)[0]  # samples need not divide a period
    error, mean = error - found[0], found[0]
    about = required - np.linalg.lstsq(terms, required, rcond=None)[0][0]
    scale = scale_of(wanted.stand, wanted.motion, wanted.exact)
    shares = displacement_shares(scale, wanted.stand, required, error)
    return Following(
        periods=periods,
        coordinates=coordinates_of(wanted.stand),
        amplitude=np.abs(about).max(axis=0),
        peak=np.abs(error).max(axis=0),
        rms=np.sqrt(np.mean(error**2, axis=0)),
        mean=mean,
        harmonics=np.hypot(found[1::2], found[2::2]),
        share=float(shares.max()),
        share_rms=float(np.sqrt(np.mean(shares**2))),
        apart=np.abs(record.apart[last]).max(axis=0),
    )


def displacement_shares(scale: Scale, stand: Stand, required: Array, error: Array) -> Array:
    """Errors (M, 6; m, rad) of all six coordinates together (M), as shares of the largest of the motion."""
    moved = [twist(stand, q, e) for q, e in zip(required, error, strict=True)]
    return scale.displacement_share(np.array(moved).reshape(-1, 6))


def _waves(turns: Array, K: int) -> Array:
    """1, cos, sin, cos 2, ... (M, 2 K + 1) of the programme's phase in turns (M)."""
    a = 2.0 * np.pi * np.outer(turns % 1.0, np.arange(1, K + 1))
    found = np.ones((len(turns), 2 * K + 1))
    found[:, 1::2], found[:, 2::2] = np.cos(a), np.sin(a)
    return found
