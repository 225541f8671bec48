"""Programmes: phi_s(t) of the flywheels that makes the carrier move as required, and their files (JSON).

A file is strict JSON: every number the shortest that reads back to the same bits, no dates. All problems of the keys
are found before any is reported.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Annotated, Any

import numpy as np

from mahovik.core.motion.document import any_list, choice, document_of, rows, short_integer, text_of
from mahovik.core.motion.functions import Angles, Array, Fourier, PlannedCourse, Samples
from mahovik.core.stand.coordinates import FREE
from mahovik.core.stand.fields import Text, scalar, validator, vector
from mahovik.core.stand.files import KINDS, TABLE
from mahovik.core.stand.masses import Unbalance, mean_stand
from mahovik.core.stand.model import Stand
from mahovik.core.stand.tables import NOTHING, Context, Data, Problems, QuantityValidator, Table, keys_of
from mahovik.core.stand.units import PLAIN, TIME, QuantityError, show
from mahovik.errors import ProgrammeError
from mahovik.writing import write

_DURATION = scalar(TIME, above=0.0)


@dataclass(frozen=True, eq=False)
class RunUpTable(Data):
    """A finite table of `duration` s from rest that ends on the programme's t = 0; or back: a run-down."""

    duration: Annotated[float, _DURATION]
    samples: Samples

    def at(self, t: Array) -> Angles:
        """phi, phi', phi'' (M, N each) at the times t (M, s) in 0..duration."""
        return self.samples.at(np.asarray(t, dtype=np.float64))


@dataclass(frozen=True, eq=False)
class Programme:
    """phi_s(t) for the flywheels of a stand that makes its carrier follow a required motion, (12)-(13).

    stand, structure, physics   the stand's name and identities (stand.identity)
    motion      name of the required motion
    flywheels   their names, in the stand's order
    periodic, span   period (or duration of a finite programme), s
    bias        6; m, rad: shift of the motion's mean; of a held carrier in its coordinates
    coordinates names of those of a held carrier; empty: the six of a free one
    winding     turns per period of each flywheel; zeros of a finite programme
    course      Fourier (periodic only) or Samples
    runup, rundown   from rest to t = 0, and back
    report      figures of the search, as JSON holds them
    carrier     course of the carrier that was found, of a slew; else None
    unbalance   resisted: (12) holds for the stand; averaged: for its mean stand
    """

    stand: str
    structure: str
    physics: str
    motion: str
    flywheels: tuple[str, ...]
    periodic: bool
    span: float
    bias: Array
    winding: tuple[int, ...]
    course: Fourier | Samples
    runup: RunUpTable | None = None
    rundown: RunUpTable | None = None
    report: Mapping[str, Any] = field(default_factory=dict)
    carrier: PlannedCourse | None = None
    coordinates: tuple[str, ...] = ()
    unbalance: Unbalance = "resisted"

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


# -- reading ---------------------------------------------------------------------------------------------------------


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


def _bias(raw: Any) -> tuple[float, ...]:
    """Any number of numbers."""
    return vector(raw, (len(raw) if isinstance(raw, list) else len(FREE),), PLAIN)


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


class IdentityTable(Table):
    """`stand`: name and identities of the stand."""

    name: Text
    structure: Text
    physics: Text


class ProgrammeTable(Table):
    """A programme file.

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

    stand: IdentityTable
    motion: Text
    flywheels: Annotated[tuple[str, ...], validator(_names)]
    period: Annotated[float | None, _DURATION] = None
    duration: Annotated[float | None, _DURATION] = None
    bias: Annotated[tuple[float, ...], validator(_bias)]
    coordinates: Annotated[tuple[str, ...], validator(_names)] = ()
    winding: Annotated[tuple[int, ...] | None, QuantityValidator(_turns)] = None
    fourier: Fourier | None = None
    samples: Samples | None = None
    runup: RunUpTable | None = None
    rundown: RunUpTable | None = None
    carrier: PlannedCourse | None = None
    unbalance: Annotated[Unbalance, choice("averaged", "resisted")] = "resisted"
    report: Annotated[Mapping[str, Any], validator(_report)] = NOTHING


def load_programme(path: str | Path) -> Programme:
    """Read and check the programme file at `path`. Raises ProgrammeError with every problem."""
    path = Path(path)
    return read_programme(text_of(path, KINDS["programme"], TABLE, ProgrammeError), path.name)


def read_programme(text: str, source: str = "programme") -> Programme:
    """Read and check a programme given as text; `source` names it in messages. Raises ProgrammeError."""
    document = document_of(text, source, ProgrammeError, "programme")
    problems, names = Problems(source), document.get("flywheels")
    N = len(names) if isinstance(names, list) else 0
    table = problems.valid(ProgrammeTable, document, flywheels=N)
    for pair in (("period", "duration"), ("fourier", "samples")):
        there = [key for key in pair if key in document]
        if len(there) != 1:
            problems.add(f"expected one of {', '.join(pair)}, found {' and '.join(there) or 'none'}")
    if table is None or problems.lines:
        raise ProgrammeError(problems.lines)
    periodic, span, course = table.period is not None, table.period or table.duration, table.fourier or table.samples
    assert span is not None and course is not None
    _check(table, span, periodic, problems)
    if problems.lines:
        raise ProgrammeError(problems.lines)
    kept = ("motion", "flywheels", "runup", "rundown", "report", "carrier", "coordinates", "unbalance")
    return Programme(
        stand=table.stand.name,
        structure=table.stand.structure,
        physics=table.stand.physics,
        periodic=periodic,
        span=span,
        bias=np.array(table.bias),
        winding=table.winding or (0,) * N,
        course=course,
        **{key: getattr(table, key) for key in kept},
    )


def _check(table: ProgrammeTable, span: float, periodic: bool, problems: Problems) -> None:
    """Note keys that do not go together."""
    count = len(table.coordinates or FREE)
    if len(table.bias) != count:
        problems.add("bias", f"expected {count} numbers, found {len(table.bias)}")
    if periodic and table.winding is None:
        problems.add("winding", "required, but missing")
    if not periodic and any(table.winding or ()):
        problems.add("winding", "not allowed with `duration`: winding is turns per period")
    if table.samples is not None:
        table.samples.check(problems, span, periodic, "samples")
    elif table.fourier is not None and not periodic:
        problems.add("fourier", "not allowed with `duration`: a finite programme has `samples`")
    elif table.fourier is not None and len(table.fourier.cos) != len(table.fourier.sin):
        sines, cosines = len(table.fourier.sin), len(table.fourier.cos)
        problems.add("fourier", "sin", f"{sines} harmonics, but cos has {cosines}")
    for key, run in (("runup", table.runup), ("rundown", table.rundown)):
        if run is not None:
            run.samples.check(problems, run.duration, False, key, "samples")
    if table.carrier is not None and periodic:
        problems.add("carrier", "t", "not allowed with `period`")
    elif table.carrier is not None:
        table.carrier.check(problems, span, False, "carrier")


# -- writing ---------------------------------------------------------------------------------------------------------


def save_programme(programme: Programme, path: str | Path) -> None:
    """Write a programme whole or not at all. Raises UsageError."""
    write(Path(path), programme_text(programme))


def programme_text(programme: Programme) -> str:
    """The file's text. Raises ValueError where a number is not finite."""
    course = programme.course
    parts = {
        "schema": 1,
        "stand": {"name": programme.stand, "structure": programme.structure, "physics": programme.physics},
        "motion": programme.motion,
        "flywheels": programme.flywheels,
        "period" if programme.periodic else "duration": float(programme.span),
        "bias": programme.bias,
        "coordinates": programme.coordinates or None,
        "winding": list(map(int, programme.winding)) if programme.periodic else None,
        "fourier" if isinstance(course, Fourier) else "samples": course,
        "runup": programme.runup,
        "rundown": programme.rundown,
        "carrier": programme.carrier,
        "unbalance": None if programme.unbalance == "resisted" else programme.unbalance,
        "report": programme.report or None,
    }
    return _layout({key: _plain(value) for key, value in parts.items() if value is not None}, 0) + "\n"


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
