"""Programme file (JSON) -> Programme. All problems of the keys are found before any is reported."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import numpy as np
from pydantic import Field

from mahovik.core.motion.course import PlannedCourse
from mahovik.core.motion.document import document_of, text_of, validate_table
from mahovik.core.motion.fields import NOT_NULL, Times, any_list, choice, context_validator, integers, rows
from mahovik.core.motion.programme.course import Array, Fourier, Samples
from mahovik.core.motion.programme.model import Programme, RunUpTable
from mahovik.core.stand.content import TABLE
from mahovik.core.stand.coordinates import FREE
from mahovik.core.stand.fields import Table, Text, scalar, validator
from mahovik.core.stand.mean import Unbalance
from mahovik.core.stand.problems import Problems
from mahovik.core.stand.shapes import vector
from mahovik.core.stand.units import PLAIN, TIME, QuantityError, show
from mahovik.errors import ProgrammeError


def _names(raw: Any) -> tuple[str, ...]:
    if not all(isinstance(name, str) for name in any_list(raw)):
        raise QuantityError("expected names")
    if not raw:
        raise QuantityError("expected at least one name")
    return tuple(raw)


def _one_each(raw: Any, context: dict[str, Any]) -> tuple[float, ...]:
    return vector(raw, (context["flywheels"],), PLAIN)


def _rows(raw: Any, context: dict[str, Any]) -> tuple[tuple[float, ...], ...]:
    return rows(raw, lambda row: _one_each(row, context))


def _turns(raw: Any, context: dict[str, Any]) -> tuple[int, ...]:
    N = context["flywheels"]
    if isinstance(raw, list) and len(raw) != N:
        raise QuantityError(f"expected {N} whole numbers, one per flywheel, found {len(raw)}")
    return integers(raw)


def _report(raw: Any) -> dict[str, Any]:
    if not isinstance(raw, dict):
        raise QuantityError(f"expected an object, found {show(raw)}")
    return {key: _plain(value) for key, value in raw.items()}


Row = Annotated[tuple[float, ...], context_validator(_one_each)]
Rows = Annotated[tuple[tuple[float, ...], ...], context_validator(_rows)]
Span = Annotated[float | None, scalar(TIME, above=0.0)]


class IdentityTable(Table):
    """`stand`: name and identities of the stand."""

    name: Text
    structure: Text
    physics: Text


class FourierTable(Table):
    """`fourier`."""

    mean: Row
    cos: Rows
    sin: Rows


class SamplesTable(Table):
    """`samples`."""

    t: Times
    phi: Rows
    phi_dot: Rows
    phi_ddot: Rows


def _six_rows(raw: Any) -> tuple[tuple[float, ...], ...]:
    return rows(raw, lambda row: vector(row, (6,), PLAIN))


SixRows = Annotated[tuple[tuple[float, ...], ...], validator(_six_rows)]


class CarrierTable(Table):
    """`carrier`: its course, of a slew."""

    t: Times
    q: SixRows
    q_dot: SixRows
    q_ddot: SixRows


class RunUpFields(Table):
    """`runup` or `rundown`."""

    duration: Annotated[float, scalar(TIME, above=0.0)]
    samples: SamplesTable


def _bias(raw: Any) -> tuple[float, ...]:
    """Any number of numbers."""
    return vector(raw, (len(raw) if isinstance(raw, list) else len(FREE),), PLAIN)


class ProgrammeTable(Table):
    """A programme file."""

    stand: IdentityTable
    motion: Text
    flywheels: Annotated[tuple[str, ...], validator(_names)]
    period: Span = None
    duration: Span = None
    bias: Annotated[tuple[float, ...], validator(_bias)]
    coordinates: Annotated[tuple[str, ...], validator(_names)] = ()
    winding: Annotated[tuple[int, ...] | None, context_validator(_turns)] = None
    fourier: Annotated[FourierTable | None, NOT_NULL] = None
    samples: Annotated[SamplesTable | None, NOT_NULL] = None
    runup: Annotated[RunUpFields | None, NOT_NULL] = None
    rundown: Annotated[RunUpFields | None, NOT_NULL] = None
    carrier: Annotated[CarrierTable | None, NOT_NULL] = None
    unbalance: Annotated[Unbalance, choice("averaged", "resisted")] = "resisted"
    report: Annotated[dict[str, Any], validator(_report)] = Field(default_factory=dict)


def load_programme(path: str | Path) -> Programme:
    """Read and check the programme file at `path`. Raises ProgrammeError with every problem."""
    path = Path(path)
    return read_programme(text_of(path, TABLE, ProgrammeError), path.name)


def read_programme(text: str, source: str = "programme") -> Programme:
    """Read and check a programme given as text; `source` names it in messages. Raises ProgrammeError."""
    document = document_of(text, source, ProgrammeError)
    if "type" in document and "stand" not in document:
        raise ProgrammeError([f"{source}: is a motion file; expected a programme file here: were the two swapped?"])
    problems, names = Problems(source), document.get("flywheels")
    N = len(names) if isinstance(names, list) else 0
    table = validate_table(ProgrammeTable, document, problems, flywheels=N)
    for pair in (("period", "duration"), ("fourier", "samples")):
        given = [key for key in pair if key in document]
        if len(given) != 1:
            problems.add(f"expected one of {', '.join(pair)}, found {' and '.join(given) or 'none'}")
    if table is None or problems.lines:
        raise ProgrammeError(problems.lines)
    periodic, span = table.period is not None, table.period or table.duration
    assert span is not None
    count = len(table.coordinates or FREE)
    if len(table.bias) != count:
        problems.add("bias", f"expected {count} numbers, found {len(table.bias)}")
    if periodic and table.winding is None:
        problems.add("winding", "required, but missing")
    if not periodic and any(table.winding or ()):
        problems.add("winding", "not allowed with `duration`: winding is turns per period")
    course: Fourier | Samples | None = None
    if table.samples is not None:
        course = _samples(table.samples, span, periodic, problems, "samples")
    elif not periodic:
        problems.add("fourier", "not allowed with `duration`: a finite programme has `samples`")
    else:
        course = _fourier(table.fourier, N, problems)
    tables = {key: _run_up(getattr(table, key), problems, key) for key in ("runup", "rundown")}
    carrier = None if table.carrier is None else _carrier(table.carrier, span, periodic, problems)
    if course is None or problems.lines:
        raise ProgrammeError(problems.lines)
    return Programme(
        stand=table.stand.name,
        structure=table.stand.structure,
        physics=table.stand.physics,
        motion=table.motion,
        flywheels=table.flywheels,
        periodic=periodic,
        span=span,
        bias=np.array(table.bias),
        coordinates=table.coordinates,
        winding=table.winding or (0,) * N,
        course=course,
        carrier=carrier,
        unbalance=table.unbalance,
        report=table.report,
        **tables,
    )


def _fourier(table: FourierTable | None, N: int, problems: Problems) -> Fourier | None:
    assert table is not None
    if len(table.cos) != len(table.sin):
        problems.add("fourier", "sin", f"{len(table.sin)} harmonics, but cos has {len(table.cos)}")
        return None
    return Fourier(np.array(table.mean), *(np.array(rows).reshape(-1, N) for rows in (table.cos, table.sin)))


def _samples(table: SamplesTable, span: float, periodic: bool, problems: Problems, *path: str) -> Samples | None:
    columns = {key: np.array(getattr(table, key), dtype=np.float64) for key in ("phi", "phi_dot", "phi_ddot")}
    for key, column in columns.items():
        if len(column) != len(table.t):
            problems.add(*path, key, f"{len(column)} rows, but t has {len(table.t)} numbers")
            return None
    reason = _times(np.array(table.t), span, periodic)
    if reason is not None:
        problems.add(*path, "t", reason)
        return None
    return Samples(np.array(table.t), *columns.values())


def _carrier(table: CarrierTable, span: float, periodic: bool, problems: Problems) -> PlannedCourse | None:
    columns = {key: np.array(getattr(table, key), dtype=np.float64) for key in ("q", "q_dot", "q_ddot")}
    for key, column in columns.items():
        if len(column) != len(table.t):
            problems.add("carrier", key, f"{len(column)} rows, but t has {len(table.t)} numbers")
            return None
    reason = "not allowed with `period`" if periodic else _times(np.array(table.t), span, False)
    if reason is not None:
        problems.add("carrier", "t", reason)
        return None
    return PlannedCourse(np.array(table.t), *columns.values())


def _times(t: Array, span: float, periodic: bool) -> str | None:
    """Why the times of a table are refused, or None."""
    if len(t) < 2:
        return f"{len(t)} numbers, expected at least 2"
    back = np.flatnonzero(np.diff(t) <= 0.0)
    if len(back):
        i = int(back[0]) + 1
        return f"[{i}]: {t[i]:.9g} s is not after {t[i - 1]:.9g} s"
    if periodic and (t[0] < 0.0 or t[-1] - t[0] > span * (1 - 1e-9)):
        return f"covers {t[0]:.9g} to {t[-1]:.9g} s, expected 0 to less than a period, {span:g} s: t = T is left out"
    if not periodic and (t[0] != 0.0 or abs(t[-1] - span) > 1e-9 * span):
        return f"covers {t[0]:.9g} to {t[-1]:.9g} s, expected 0 to the duration, {span:g} s"
    return None


def _run_up(table: RunUpFields | None, problems: Problems, key: str) -> RunUpTable | None:
    if table is None:
        return None
    samples = _samples(table.samples, table.duration, False, problems, key, "samples")
    return None if samples is None else RunUpTable(table.duration, samples)


def _plain(value: Any) -> Any:
    """A part of the report as JSON without exact decimals."""
    if isinstance(value, dict):
        return {key: _plain(one) for key, one in value.items()}
    if isinstance(value, list):
        return [_plain(one) for one in value]
    return value if value is None or isinstance(value, bool | int | str) else float(value)
