"""Programmes: phi_s(t) of the flywheels that makes the carrier move as required, and their files (JSON).

A file is strict JSON: every number the shortest that reads back to the same bits, no dates. All problems of the keys
are found before any is reported.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import Annotated, Any

import numpy as np

from mahovik.core.motion.functions import Angles, Array, Fourier, PlannedCourse, Samples
from mahovik.core.stand.coordinates import FREE, coordinates_of
from mahovik.core.stand.fields import Text, any_list, choice, rows, scalar, short_integer, validator, vector
from mahovik.core.stand.files import KINDS, TABLE, document_of, text_of
from mahovik.core.stand.masses import Unbalance, mean_stand
from mahovik.core.stand.model import Stand
from mahovik.core.stand.structure import identities
from mahovik.core.stand.tables import NOTHING, Context, Data, Default, Problems, QuantityValidator, keys_of
from mahovik.core.stand.units import PLAIN, TIME, QuantityError, show
from mahovik.errors import ProgrammeError
from mahovik.writing import write

_DURATION = scalar(TIME, above=0.0)

NO_SHIFT = 1e-15
"""m, rad: a smaller shift of the mean counts as none."""


@dataclass(frozen=True, eq=False)
class RunUpTable(Data):
    """A finite table of `duration` s from rest that ends on the programme's t = 0; or back: a run-down."""

    duration: Annotated[float, _DURATION]
    samples: Samples

    def at(self, t: Array) -> Angles:
        """phi, phi', phi'' (M, N each) at the times t (M, s) in 0..duration."""
        return self.samples.at(np.asarray(t, dtype=np.float64))


def _names(raw: Any) -> tuple[str, ...]:
    if not all(isinstance(name, str) for name in any_list(raw)):
        raise QuantityError("expected names")
    if not raw:
        raise QuantityError("expected at least one name")
    return tuple(raw)


def _turns(raw: Any, context: Context) -> tuple[int, ...]:
    N = context["flywheels"]
    if isinstance(raw, list) and len(raw) != N:
        raise QuantityError(f"expected {N} whole numbers, one per flywheel, found {len(raw)}")
    return rows(raw, short_integer)


def _bias(raw: Any) -> Array:
    """Any number of numbers."""
    return np.array(vector(raw, (len(raw) if isinstance(raw, list) else len(FREE),), PLAIN))


def _report(raw: Any) -> dict[str, Any]:
    """Figures of the search without exact decimals."""
    if not isinstance(raw, dict):
        raise QuantityError(f"expected an object, found {show(raw)}")
    return {key: _inexact(value) for key, value in raw.items()}


def _inexact(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _inexact(part) for key, part in value.items()}
    if isinstance(value, list):
        return [_inexact(part) for part in value]
    return value if value is None or isinstance(value, bool | int | str) else float(value)


@dataclass(frozen=True)
class ProgrammedStand(Data):
    """`stand` of a programme: name and identities (`structure.identities`)."""

    name: Text
    structure: Text
    physics: Text


@dataclass(frozen=True, eq=False)
class Programme(Data):
    """phi_s(t) for the flywheels of a stand that makes its carrier follow a required motion, (12)-(13), and its file.

    stand        `name`, `structure`, `physics` of the stand
    motion       name of the motion
    flywheels    their names in order
    period       of a periodic programme
    duration     of a finite one
    bias         shift of the mean: six numbers (m, rad), or one for each freedom
    coordinates  names of the freedoms of a held carrier
    winding      turns a period of each flywheel
    fourier      `mean` (a number a flywheel), `cos`, `sin` (a row a harmonic, from the first); rad: `phi_s = 2 pi
                 winding_s t/T + mean_s + sum_k cos_sk cos(2 pi k t/T) + sin_sk sin(2 pi k t/T)`
    samples      in place of `fourier`: `t`, and `phi`, `phi_dot`, `phi_ddot`, one row a time, quintic Hermite between;
                 s, rad
    runup        `duration` and `samples`; ends at the programme's `t = 0`, up to whole turns
    rundown      `duration` and `samples`, from there to rest
    carrier      of a slew: `t`, `q`, `q_dot`, `q_ddot`, the course that was found
    unbalance    `"averaged"`: (12) holds for the mean stand
    report       figures of the search, among them peaks with friction; nothing reads them again
    """

    stand: ProgrammedStand
    motion: Text
    flywheels: Annotated[tuple[str, ...], validator(_names)]
    period: Annotated[float | None, _DURATION, Default(None)]
    duration: Annotated[float | None, _DURATION, Default(None)]
    bias: Annotated[Array, validator(_bias, shape="numbers")]
    coordinates: Annotated[tuple[str, ...], validator(_names)] = ()
    winding: Annotated[tuple[int, ...], QuantityValidator(_turns)] = ()
    fourier: Fourier | None = None
    samples: Samples | None = None
    runup: RunUpTable | None = None
    rundown: RunUpTable | None = None
    carrier: PlannedCourse | None = None
    unbalance: Annotated[Unbalance, choice("averaged", "resisted")] = "resisted"
    report: Annotated[Mapping[str, Any], validator(_report), Default(NOTHING)] = field(default_factory=dict)

    @staticmethod
    def of(
        stand: Stand, motion: str, span: float, bias: Array, winding: tuple[int, ...] | None, course: Fourier | Samples,
        report: Mapping[str, Any] = NOTHING,
    ) -> Programme:  # fmt: skip
        """The programme of a stand for a motion of this name; `winding`: of a periodic one, None: it is finite."""
        hashes = identities(stand)
        return Programme(
            ProgrammedStand(stand.name, hashes.structure, hashes.physics),
            motion,
            tuple(s.name for s in stand.flywheels),
            None if winding is None else float(span),
            float(span) if winding is None else None,
            np.where(np.abs(bias) < NO_SHIFT, 0.0, bias),
            () if stand.hold is None else coordinates_of(stand).names,
            winding or (0,) * len(stand.flywheels),
            report=report,
        ).with_course(course)

    def with_course(self, course: Fourier | Samples) -> Programme:
        """The programme with another course."""
        of = (course, None) if isinstance(course, Fourier) else (None, course)
        return replace(self, fourier=of[0], samples=of[1])

    @property
    def periodic(self) -> bool:
        """Whether it repeats; a finite one ends."""
        return self.period is not None

    @property
    def span(self) -> float:
        """Period, or duration of a finite programme, s."""
        span = self.duration if self.period is None else self.period
        assert span is not None
        return span

    @property
    def course(self) -> Fourier | Samples:
        """Phases of the flywheels over time: a Fourier series, or the samples of a finite programme."""
        course = self.fourier or self.samples
        assert course is not None
        return course

    def planned_for(self, stand: Stand) -> Stand:
        """The stand whose equations the programme keeps: the given one, or its mean stand."""
        return mean_stand(stand) if self.unbalance == "averaged" else stand

    def at(self, t: Array) -> Angles:
        """phi, phi', phi'' (M, N each; rad, s) at the times t (M, s): any of a periodic programme, else 0..duration.

        phi_s = 2 pi winding_s t/T + mean_s + sum_k cos_k cos(2 pi k t/T) + sin_k sin(2 pi k t/T); or the table.
        """
        t = np.asarray(t, dtype=np.float64)
        if isinstance(self.course, Fourier):
            phi, phi_dot, phi_ddot = self.course.at(t, self.span)
            return Angles(phi + (t / self.span)[:, None] * self._turn, phi_dot + self._turn / self.span, phi_ddot)
        if not self.periodic:
            return self.course.at(t)
        periods = np.floor((t - self.course.t[0]) / self.span)
        phi, phi_dot, phi_ddot = self._whole_period.at(t - periods * self.span)
        return Angles(phi + periods[:, None] * self._turn, phi_dot, phi_ddot)

    @property
    def _turn(self) -> Array:
        """Angles that the flywheels gain in a period."""
        return 2 * np.pi * np.array(self.winding, dtype=np.float64)

    @cached_property
    def _whole_period(self) -> Samples:
        assert isinstance(self.course, Samples)
        return self.course.over_whole_period(self.span, self._turn)


# -- reading -----------------------------------------------------------------------------------------------------------


def load_programme(path: str | Path) -> Programme:
    """Read and check the programme file at `path`. Raises ProgrammeError with every problem."""
    path = Path(path)
    return read_programme(text_of(path, KINDS["programme"], TABLE, ProgrammeError), path.name)


def read_programme(text: str, source: str = "programme") -> Programme:
    """Read and check a programme given as text; `source` names it in messages. Raises ProgrammeError."""
    document = document_of(text, source, ProgrammeError, "programme")
    problems, names = Problems(source), document.get("flywheels")
    N = len(names) if isinstance(names, list) else 0
    programme = problems.valid(Programme, document, flywheels=N)
    for pair in (("period", "duration"), ("fourier", "samples")):
        there = [key for key in pair if key in document]
        if len(there) != 1:
            problems.add(f"expected one of {', '.join(pair)}, found {' and '.join(there) or 'none'}")
    if programme is not None and not problems.lines:
        _check(programme, problems)
    if programme is None or problems.lines:
        raise ProgrammeError(problems.lines)
    return replace(programme, winding=programme.winding or (0,) * N)


def _check(programme: Programme, problems: Problems) -> None:
    """Note keys that do not go together."""
    count, periodic = len(programme.coordinates or FREE), programme.periodic
    if len(programme.bias) != count:
        problems.add("bias", f"expected {count} numbers, found {len(programme.bias)}")
    if periodic and not programme.winding:
        problems.add("winding", "required, but missing")
    if not periodic and any(programme.winding):
        problems.add("winding", "not allowed with `duration`: winding is turns per period")
    if programme.samples is not None:
        programme.samples.check(problems, programme.span, periodic, "samples")
    elif not periodic:
        problems.add("fourier", "not allowed with `duration`: a finite programme has `samples`")
    elif programme.fourier is not None and len(programme.fourier.cos) != len(programme.fourier.sin):
        sines, cosines = len(programme.fourier.sin), len(programme.fourier.cos)
        problems.add("fourier", "sin", f"{sines} harmonics, but cos has {cosines}")
    for key, run in (("runup", programme.runup), ("rundown", programme.rundown)):
        if run is not None:
            run.samples.check(problems, run.duration, False, key, "samples")
    if programme.carrier is not None and periodic:
        problems.add("carrier", "t", "not allowed with `period`")
    elif programme.carrier is not None:
        programme.carrier.check(problems, programme.span, False, "carrier")


# -- writing ---------------------------------------------------------------------------------------------------------


def save_programme(programme: Programme, path: str | Path) -> None:
    """Write a programme whole or not at all. Raises UsageError."""
    write(Path(path), programme_text(programme))


def programme_text(programme: Programme) -> str:
    """The file's text. Raises ValueError where a number is not finite."""
    parts = _plain(programme)
    for key, left_out in (("winding", not programme.periodic), ("unbalance", programme.unbalance == "resisted")):
        if left_out:
            del parts[key]
    return _layout({"schema": 1, **{key: part for key, part in parts.items() if part not in (None, [], {})}}, 0) + "\n"


def _plain(value: Any) -> Any:
    """A value as JSON has it; no negative zero in an array of floats, as a reader has none."""
    if isinstance(value, np.ndarray):
        return (value + 0.0 if value.dtype.kind == "f" else value).tolist()
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, Data):
        return {key: _plain(getattr(value, key)) for key in keys_of(type(value))}
    if isinstance(value, Mapping):
        return {key: _plain(part) for key, part in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(part) for part in value]
    return value


def _layout(value: Any, depth: int) -> str:
    """Text of a document: objects with one key per line, lists of lists with one row per line."""
    pad = " " * (depth + 1)
    if isinstance(value, dict) and value:
        lines = [f"{pad}{json.dumps(key)}: {_layout(part, depth + 1)}" for key, part in value.items()]
        return "{\n" + ",\n".join(lines) + "\n" + " " * depth + "}"
    if isinstance(value, list) and any(isinstance(part, list | dict) for part in value):
        return "[\n" + ",\n".join(pad + _layout(part, depth + 1) for part in value) + "\n" + " " * depth + "]"
    return json.dumps(value, allow_nan=False)
