"""Motion file (JSON) -> RequiredMotion. Every problem of the file is found before any is reported."""

from __future__ import annotations

from pathlib import Path
from typing import Any, cast

import numpy as np

from mahovik.core.motion import document
from mahovik.core.motion.document import Section
from mahovik.core.motion.required import limits, reach, samples
from mahovik.core.motion.required.course import Array, Harmonics, Sampled
from mahovik.core.motion.required.model import RequiredMotion, Winding
from mahovik.core.stand.content import TABLE
from mahovik.core.stand.model import Stand
from mahovik.core.stand.problems import Problems
from mahovik.core.stand.units import ANGLE, LENGTH, TIME, Dimension, QuantityError, factor, number, show
from mahovik.errors import MotionError
from mahovik.nearest import meant

KEYS = (
    "schema", "name", "type", "period", "duration", "units", "mean", "free_mean", "harmonics", "samples", "winding",
    "runup", "bounds", "objective", "note",
)  # fmt: skip
WINDINGS = ("any", "spin", "rock")
HIGHEST = 1000
"""Harmonic that a file may hold."""


def load_motion(path: str | Path, stand: Stand) -> RequiredMotion:
    """Read and check the motion file at `path` for `stand`. Raises MotionError with every problem."""
    path = Path(path)
    try:
        text = document.text_of(path, TABLE)
    except ValueError as error:
        raise MotionError([str(error)]) from None
    return read_motion(text, stand, path.name)


def read_motion(text: str, stand: Stand, source: str = "motion") -> RequiredMotion:
    """Read and check a motion given as text; `source` names it in messages. Raises MotionError."""
    try:
        found = document.whole(text, source)
    except ValueError as error:
        raise MotionError([str(error)]) from None
    if "stand" in found and "flywheels" in found:
        raise MotionError([f"{source}: is a programme file; expected a motion file here: were the two swapped?"])
    problems = Problems(source)
    top = Section(problems, found)
    top.only(KEYS)
    name = top.text("name", Path(source).stem.removesuffix(".motion"))
    top.text("note", "")
    kind = top.given.get("type", "periodic") if top.has("type") else "periodic"
    if kind not in ("periodic", "finite"):
        top.refuse("type", f'expected "periodic" or "finite", found {show(kind)}')
        kind = "finite" if "duration" in top else "periodic"
    periodic = kind == "periodic"
    span = _span(top, periodic)
    units = _units(top)
    mean = _six(top, "mean", top.given.get("mean", [0] * 6), units)
    course = _course(top, periodic, span, units)
    N = len(stand.flywheels)
    motion_bounds = limits.bounds(top, N, periodic)
    objective = limits.objective(top, stand)
    free_mean = _free_mean(top)
    winding = _winding(top, N, periodic)
    runup = None
    if "runup" in top:
        if periodic:
            runup = top.above_zero("runup", TIME)
        else:
            top.refuse("runup", "goes with a periodic motion; a finite one starts from rest itself")
    if span is not None and winding is not None:
        limits.contradictions(top, motion_bounds, winding, span if periodic else None)
    if problems.lines or span is None or mean is None or course is None or winding is None:
        raise MotionError(problems.lines)
    motion = RequiredMotion(
        name, periodic, span, mean, course, free_mean, winding, motion_bounds, objective, runup
    )  # fmt: skip
    reach.check(motion, stand, problems)
    if problems.lines:
        raise MotionError(problems.lines)
    return motion


def _span(top: Section, periodic: bool) -> float | None:
    """Period or duration, s."""
    own, other = ("period", "duration") if periodic else ("duration", "period")
    if other in top:
        kind = "periodic" if periodic else "finite"
        top.refuse(other, f'goes not with type "{kind}", which has `{own}`')
    if not top.has(own):
        return None
    span = top.above_zero(own, TIME)
    if span is not None and not 1e-6 <= span <= 1e6:
        top.refuse(own, f"{span:g} s is out of range, expected 1e-06 to 1e+06 s")
        return None
    return span


def _units(top: Section) -> tuple[str | None, str | None]:
    """Units of the linear and the angular numbers; None: SI, or each its own."""
    section = top.section("units")
    if section is None:
        return None, None
    section.only(("linear", "angular"))
    found: list[str | None] = []
    for key, dimension in (("linear", LENGTH), ("angular", ANGLE)):
        raw = section.given.get(key)
        try:
            if raw is not None and not isinstance(raw, str):
                raise QuantityError(
                    f"expected a unit such as {show('mm' if key == 'linear' else 'mrad')}, found {show(raw)}"
                )
            if raw is not None:
                factor(raw, dimension)
            found.append(raw)
        except QuantityError as error:
            section.refuse(key, str(error))
            found.append(None)
    return found[0], found[1]


def _six(top: Section, where: str, raw: Any, units: tuple[str | None, str | None]) -> Array | None:
    """Six coordinates, m and rad."""
    if not isinstance(raw, list) or len(raw) != 6:
        top.refuse(where, f"expected 6 numbers, found {len(raw) if isinstance(raw, list) else show(raw)}")
        return None
    values = []
    for i, each in enumerate(raw):
        dimension: Dimension = LENGTH if i < 3 else ANGLE
        try:
            values.append(number(each, dimension, units[i // 3]))
        except QuantityError as error:
            top.refuse(where, f"[{i}]: {error}")
    return np.array(values) if len(values) == 6 else None


def _course(
    top: Section, periodic: bool, span: float | None, units: tuple[str | None, str | None]
) -> Harmonics | Sampled | None:
    given = [key for key in ("harmonics", "samples") if key in top]
    if len(given) != 1:
        top.problems.add(f"expected one of harmonics, samples, found {' and '.join(given) or 'none'}")
        return None
    if given == ["samples"]:
        return _samples(top, periodic, span, units)
    if not periodic:
        top.refuse("harmonics", 'goes not with type "finite", which has `samples`')
        return None
    return _harmonics(top, span, units)


def _harmonics(top: Section, span: float | None, units: tuple[str | None, str | None]) -> Harmonics | None:
    ks: list[int] = []
    cos, sin = [], []
    good = isinstance(top.given["harmonics"], list)
    for i, raw in enumerate(top.rows("harmonics")):
        where = f"harmonics[{i}]"
        if not isinstance(raw, dict):
            top.refuse(where, f"expected an object, found {show(raw)}")
            good = False
            continue
        section = Section(top.problems, raw, (where,))
        section.only(("k", "cos", "sin"))
        k = section.integer("k", raw["k"]) if section.has("k") else None
        if k is not None and not 1 <= k <= HIGHEST:
            section.refuse("k", f"expected 1 to {HIGHEST}, found {k}" + ("; a constant is `mean`" if k == 0 else ""))
            k = None
        if k in ks:
            section.refuse("k", f"{k} is there twice")
        pair = [_six(section, key, raw.get(key, [0] * 6), units) for key in ("cos", "sin")]
        if k is None or pair[0] is None or pair[1] is None:
            good = False
            continue
        ks.append(k)
        cos.append(pair[0])
        sin.append(pair[1])
    if not good or span is None:
        return None
    return Harmonics(span, tuple(ks), np.array(cos).reshape(-1, 6), np.array(sin).reshape(-1, 6))


def _samples(top: Section, periodic: bool, span: float | None, units: tuple[str | None, str | None]) -> Sampled | None:
    section = top.section("samples")
    if section is None:
        return None
    section.only(("t", "q"))
    if not section.has("t", "q"):
        return None
    times, rows = section.rows("t"), section.rows("q")
    t = section.numbers("t", times, len(times), TIME)
    q = [_six(section, f"q[{i}]", row, units) for i, row in enumerate(rows)]
    if len(times) != len(rows):
        section.refuse("q", f"{len(rows)} rows, but t has {len(times)} numbers")
        return None
    if t is None or span is None or any(row is None for row in q):
        return None
    found = Sampled(span, periodic, np.array(t), np.array(q).reshape(-1, 6))
    reason = samples.problem(found)
    if reason is not None:
        section.refuse(*reason)
        return None
    return found


def _free_mean(top: Section) -> tuple[bool, ...]:
    raw = top.given.get("free_mean", [True] * 6)
    if not isinstance(raw, list) or len(raw) != 6 or not all(isinstance(each, bool) for each in raw):
        top.refuse("free_mean", f"expected 6 of true, false, found {show(raw)}")
        return (True,) * 6
    return tuple(raw)


def _winding(top: Section, N: int, periodic: bool) -> Winding | None:
    raw = top.given.get("winding", "any")
    if "winding" in top and not periodic:
        top.refuse("winding", 'goes not with type "finite": winding is turns a period')
        return "any"
    if isinstance(raw, str):
        if raw in WINDINGS:
            return cast("Winding", raw)
        top.refuse("winding", f"unknown {show(raw)}{meant(raw, WINDINGS)}")
        return None
    if not isinstance(raw, list) or len(raw) != N:
        found = f"{len(raw)} numbers" if isinstance(raw, list) else show(raw)
        top.refuse("winding", f'expected {N} whole numbers (one a flywheel), "any", "spin" or "rock", found {found}')
        return None
    turns = [top.integer(f"winding[{i}]", each) for i, each in enumerate(raw)]
    return tuple(n for n in turns if n is not None) if None not in turns else None
