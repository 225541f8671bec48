"""Programme file (JSON) -> Programme. Every problem of the file is found before any is reported."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from mahovik.core.motion import document
from mahovik.core.motion.document import Section
from mahovik.core.motion.programme.course import Array, Fourier, Samples
from mahovik.core.motion.programme.model import Programme, RunUpTable
from mahovik.core.stand.content import TABLE
from mahovik.core.stand.problems import Problems
from mahovik.core.stand.shapes import vector
from mahovik.core.stand.units import PLAIN, TIME, QuantityError
from mahovik.errors import ProgrammeError

KEYS = (
    "schema", "stand", "motion", "flywheels", "period", "duration", "bias", "winding", "fourier", "samples", "runup",
    "rundown", "report",
)  # fmt: skip
STAND_KEYS = ("name", "structure", "physics")
SAMPLE_KEYS = ("t", "phi", "phi_dot", "phi_ddot")
FOURIER_KEYS = ("mean", "cos", "sin")


def load_programme(path: str | Path) -> Programme:
    """Read and check the programme file at `path`. Raises ProgrammeError with every problem."""
    path = Path(path)
    try:
        text = document.text_of(path, TABLE)
    except ValueError as error:
        raise ProgrammeError([str(error)]) from None
    return read_programme(text, path.name)


def read_programme(text: str, source: str = "programme") -> Programme:
    """Read and check a programme given as text; `source` names it in messages. Raises ProgrammeError."""
    try:
        found = document.whole(text, source)
    except ValueError as error:
        raise ProgrammeError([str(error)]) from None
    if "type" in found and "stand" not in found:
        raise ProgrammeError([f"{source}: is a motion file; expected a programme file here: were the two swapped?"])
    problems = Problems(source)
    top = Section(problems, found)
    top.only(KEYS)
    names = _names(top)
    N = len(names)
    identity = _identity(top)
    motion = top.text("motion", "") if top.has("motion") else ""
    periodic, span = _span(top)
    bias = top.numbers("bias", top.given["bias"], 6, PLAIN) if top.has("bias") else None
    winding = _winding(top, N, periodic)
    course = _course(top, N, periodic, span)
    tables = {key: _table(top, key, N) for key in ("runup", "rundown")}
    report = top.section("report")
    if problems.lines or span is None or bias is None or course is None or report is None:
        raise ProgrammeError(problems.lines)
    return Programme(
        stand=identity["name"],
        structure=identity["structure"],
        physics=identity["physics"],
        motion=motion,
        flywheels=names,
        periodic=periodic,
        span=span,
        bias=np.array(bias),
        winding=winding,
        course=course,
        runup=tables["runup"],
        rundown=tables["rundown"],
        report=_plain(report.given),
    )


def _names(top: Section) -> tuple[str, ...]:
    names = top.rows("flywheels") if top.has("flywheels") else []
    if "flywheels" in top and not names:
        top.refuse("flywheels", "expected at least one name")
    if not all(isinstance(name, str) for name in names):
        top.refuse("flywheels", "expected names")
        return ("",) * len(names)
    return tuple(names)


def _identity(top: Section) -> dict[str, str]:
    section = top.section("stand") if top.has("stand") else None
    if section is None:
        return dict.fromkeys(STAND_KEYS, "")
    section.only(STAND_KEYS)
    return {key: section.text(key, "") if section.has(key) else "" for key in STAND_KEYS}


def _span(top: Section) -> tuple[bool, float | None]:
    given = [key for key in ("period", "duration") if key in top]
    if len(given) != 1:
        top.problems.add(f"expected one of period, duration, found {' and '.join(given) or 'none'}")
        return True, None
    return given == ["period"], top.above_zero(given[0], TIME)


def _winding(top: Section, N: int, periodic: bool) -> tuple[int, ...]:
    if not periodic and "winding" not in top:
        return (0,) * N
    raw = top.rows("winding") if top.has("winding") else [0] * N
    if len(raw) != N:
        top.refuse("winding", f"expected {N} whole numbers, one a flywheel, found {len(raw)}")
        return (0,) * N
    turns = tuple(top.integer(f"winding[{i}]", each) or 0 for i, each in enumerate(raw))
    if not periodic and any(turns):
        top.refuse("winding", "goes with `period`: winding is turns a period")
    return turns


def _course(top: Section, N: int, periodic: bool, span: float | None) -> Fourier | Samples | None:
    given = [key for key in ("fourier", "samples") if key in top]
    if len(given) != 1:
        top.problems.add(f"expected one of fourier, samples, found {' and '.join(given) or 'none'}")
        return None
    section = top.section(given[0])
    if section is None:
        return None
    if given == ["samples"]:
        return _samples(section, N, span, periodic)
    if not periodic:
        top.refuse("fourier", "goes with `period`; a finite programme has `samples`")
        return None
    section.only(FOURIER_KEYS)
    if not section.has(*FOURIER_KEYS):
        return None
    mean = section.numbers("mean", section.given["mean"], N, PLAIN)
    cos, sin = (_matrix(section, key, N) for key in ("cos", "sin"))
    if mean is None or cos is None or sin is None:
        return None
    if len(cos) != len(sin):
        section.refuse("sin", f"{len(sin)} harmonics, but cos has {len(cos)}")
        return None
    return Fourier(np.array(mean), cos, sin)


def _matrix(section: Section, key: str, N: int) -> Array | None:
    """Rows of N numbers."""
    found = []
    for i, row in enumerate(section.rows(key)):
        try:
            found.append(vector(row, (N,), PLAIN))
        except QuantityError as error:
            section.refuse(f"{key}[{i}]", str(error))
            return None
    return np.array(found, dtype=np.float64).reshape(-1, N) if isinstance(section.given[key], list) else None


def _samples(section: Section, N: int, span: float | None, periodic: bool) -> Samples | None:
    section.only(SAMPLE_KEYS)
    if not section.has(*SAMPLE_KEYS):
        return None
    times = section.rows("t")
    t = section.numbers("t", times, len(times), TIME)
    columns = [_matrix(section, key, N) for key in SAMPLE_KEYS[1:]]
    for key, column in zip(SAMPLE_KEYS[1:], columns, strict=True):
        if column is not None and len(column) != len(times):
            section.refuse(key, f"{len(column)} rows, but t has {len(times)} numbers")
            return None
    phi, phi_dot, phi_ddot = columns
    if t is None or span is None or phi is None or phi_dot is None or phi_ddot is None:
        return None
    reason = _times(np.array(t), span, periodic)
    if reason is not None:
        section.refuse("t", reason)
        return None
    return Samples(np.array(t), phi, phi_dot, phi_ddot)


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


def _table(top: Section, key: str, N: int) -> RunUpTable | None:
    if key not in top:
        return None
    section = top.section(key)
    if section is None:
        return None
    section.only(("duration", "samples"))
    if not section.has("duration", "samples"):
        return None
    duration, inner = section.above_zero("duration", TIME), section.section("samples")
    if duration is None or inner is None:
        return None
    samples = _samples(inner, N, duration, periodic=False)
    return None if samples is None else RunUpTable(duration, samples)


def _plain(value: Any) -> Any:
    """A part of the report as JSON without exact decimals."""
    if isinstance(value, dict):
        return {key: _plain(each) for key, each in value.items()}
    if isinstance(value, list):
        return [_plain(each) for each in value]
    return value if value is None or isinstance(value, bool | int | str) else float(value)
