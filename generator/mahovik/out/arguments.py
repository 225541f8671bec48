"""Arguments of commands: their types, and what they are read to, once, with messages that name the argument.

A type is `Annotated` with what stands for its value in the help of the command line.
"""

from __future__ import annotations

import contextlib
import json
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial, wraps
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, TypeVar, Union, cast

from mahovik.errors import FileError, UsageError, library
from mahovik.out.notices import OnProgress, hearing
from mahovik.out.result import SUFFIXES
from mahovik.signatures import HIDDEN, Function, Rules, check_arguments

if TYPE_CHECKING:
    from mahovik.core.motion.programme import Programme
    from mahovik.core.motion.regime import Regime
    from mahovik.core.motion.required import RequiredMotion, Slew
    from mahovik.core.motion.servo import Servo
    from mahovik.core.stand.model import Stand
    from mahovik.core.stand.units import Dimension

Keys = Mapping[str, Any]
Number = float | str
"""A number in SI, or a text with its unit."""

StandGiven = Annotated[Union[Keys, str, Path, "Stand"], "STAND.toml"]
"""A stand, its file, or a mapping with the keys of one."""
FileGiven = Annotated[Keys | str | Path, "FILE"]
"""A file's path, or a mapping with its keys."""
FilePath = Annotated[str | Path, "FILE"]
Folder = Annotated[str | Path, "DIR"]
Names = Annotated[str | Sequence[str], "NAME,NAME"]
Text = Annotated[str, "TEXT"]
Seconds = Annotated[Number, "TIME"]
Speed = Annotated[Number, "SPEED"]
Vector = Annotated[str | Sequence[float], "X,Y,Z"]
Range = tuple[Number, Number]
Band = Annotated[Range | str, "LOW..HIGHHz"]
Turning = Annotated[
    Number | Mapping[str, Number | Range] | Sequence[Number | Range], "NAME=SPEED|LOW..HIGH|[FACTOR*]NAME"
]
"""Speeds of flywheels of which one may be swept, and others geared to it."""
Phases = Annotated[Number | Mapping[str, Number] | Sequence[Number], "NAME=ANGLE"]
"""One for all flywheels, by their names, or one for each; on the command line `NAME=VALUE`, as often as needed."""
Progressing = Annotated[OnProgress | None, HIDDEN]
"""What hears how far a command is; the command line shows it as a line, and offers no option for it."""


def command(needs: Rules | None = None, excludes: Rules | None = None) -> Callable[[Function], Function]:
    """Make a function a command: its arguments are checked before it runs, its warnings are messages of its result."""

    def of(function: Function) -> Function:
        @wraps(function)
        def checked(*args: Any, **values: Any) -> Any:
            check_arguments(function, args, values, needs or {}, excludes or {})
            with hearing() as warnings:
                result = function(*args, **values)
            return replace(result, messages=[*map("warning: {}".format, dict.fromkeys(warnings)), *result.messages])

        return cast("Function", checked)

    return of


def output_format(name: str, path: str | Path, read: Sequence[str | Path], formats: Sequence[str] = SUFFIXES) -> str:
    """The format of a file that an argument says is to be written. Raises UsageError if it cannot, or is in `read`."""
    from mahovik.writing import format_of, probe

    path = Path(path)
    if (suffix := format_of(path, formats, name)) in (".svg", ".png"):
        library("matplotlib", "report")
    if path.exists() and any(path.samefile(source) for source in read if Path(source).exists()):
        raise UsageError(f"{name} {path}: is read by this command; expected another name")
    probe(path)
    return suffix


Made = TypeVar("Made")


def reading(kind: str, source: Any, read: Callable[..., Made], *more: Any) -> Made:
    """What a reader makes of a file, or of several; a file of another kind is refused by name."""
    with expecting(kind, *(source if isinstance(source, list) else [source])):
        return read(source, *more)


def _from_source(kind: str, source: Any, load: Callable[..., Made], read: Callable[..., Made], *more: Any) -> Made:
    """What a file holds, or a mapping with its keys; an object of this package as it is. Raises UsageError."""
    if isinstance(source, str | Path):
        return reading(kind, Path(source), load, *more)
    if not isinstance(source, Mapping) and not type(source).__module__.startswith("mahovik"):
        raise UsageError(f"{kind}: expected a path or a mapping, found {type(source).__name__}")
    made: Made = read(text_of_keys(source), *more) if isinstance(source, Mapping) else source
    return made


def regime_of(regime: Regime | Keys | str | Path, stand: Stand, until: float) -> Regime:
    """The regime of a run of `until` s. Raises RegimeError."""
    from mahovik.core.motion.regime import load, loads_regime

    return _from_source("regime", regime, load, partial(loads_regime, is_json=True), stand, until)


def motion_of(
    motion: RequiredMotion | Keys | str | Path, stand: Stand, programme: Programme | None = None
) -> RequiredMotion:
    """The required motion of the carrier; of a slew, with the course that `programme` keeps. Raises MotionError."""
    from mahovik.core.motion.motion_file import load_motion, read_motion

    load, read = (partial(one, programme=programme) for one in (load_motion, read_motion))
    return _from_source("motion", motion, load, read, stand)


def required_of(motion: RequiredMotion | Slew | Keys | str | Path, stand: Stand) -> RequiredMotion | Slew:
    """What `plan` is to find a programme for: a motion, or a slew. Raises MotionError."""
    from mahovik.core.motion.motion_file import load_motion_or_slew, read_motion_or_slew

    return _from_source("motion", motion, load_motion_or_slew, read_motion_or_slew, stand)


def programme_of(programme: Programme | Keys | str | Path) -> Programme:
    """The programme of the flywheels; of the result of `plan` its own. Raises ProgrammeError, UsageError."""
    from mahovik.core.motion.programme import load_programme, read_programme
    from mahovik.out.result import Result

    if isinstance(programme, Result):
        if programme["programme"] is None:
            raise UsageError(f"{programme.title}: {programme['status']}: {'; '.join(programme.messages)}")
        programme = programme["programme"]
    return _from_source("programme", programme, load_programme, read_programme)


def servo_of(servo: Servo | str | Path, stand: Stand) -> Servo:
    """The servos of the flywheels. Raises ServoError."""
    from mahovik.core.motion.servo import load_servo

    return reading("servo", servo, load_servo, stand) if isinstance(servo, str | Path) else servo


def file_name(source: Any, otherwise: str) -> str:
    """The name of a file in messages; words where no file was given."""
    return Path(source).name if isinstance(source, str | Path) else otherwise


def text_of_keys(keys: Keys, schema: bool = True) -> str:
    """A mapping as the text of its file in JSON; the number of the schema need not be given. Raises UsageError."""
    from mahovik.core.stand.numbers import exact

    try:
        return json.dumps(({"schema": 1} if schema else {}) | exact(keys), default=float)
    except (TypeError, ValueError) as error:
        raise UsageError(f"{', '.join(map(str, keys))}: expected what JSON can have: {error}") from None


def quantity(name: str, value: Number, dimension: Dimension, low: float = -math.inf, high: float = math.inf) -> float:
    """A number in SI of an argument `name`, from `low` to `high`. Raises UsageError."""
    from mahovik.core.stand.numbers import in_si
    from mahovik.core.stand.units import QuantityError

    try:
        result = in_si(value, dimension)
    except QuantityError as error:
        raise UsageError(f"{name}: {error}") from None
    if not (math.isfinite(result) and low <= result <= high):
        bounds = f"{low:g} to {high:g} {dimension.si}".rstrip() if math.isfinite(high) else "a finite number"
        raise UsageError(f"{name} {value if isinstance(value, str) else f'{value:g}'}: out of range, expected {bounds}")
    return result


def vector(name: str, value: str | Sequence[float], expected: str) -> Any:
    """An array of three numbers of an argument `name`, or of a text of three. Raises UsageError."""
    import numpy as np

    try:
        result = np.array(value.replace(",", " ").split() if isinstance(value, str) else value, dtype=np.float64)
    except ValueError:
        result = np.zeros(0)
    if result.shape != (3,) or not np.isfinite(result).all():
        raise UsageError(f"{name} {value}: expected three finite numbers, {expected}")
    return result


def time(name: str, value: Number) -> float:
    """A time in s of an argument `name`, which the caller still has to bound. Raises UsageError."""
    from mahovik.core.stand.units import TIME

    return quantity(name, value, TIME) if isinstance(value, str) else value


def time_limit(name: str, value: Number | None) -> float | None:
    """How long a search or a run may take, s; None: as long as it needs. Raises UsageError."""
    if value is None:
        return None
    result = time(name, value)
    if not 0.0 < result < math.inf:
        raise UsageError(f"{name} {result:g}: expected a time above 0, in s")
    return result


# ---- files of another kind than an argument takes


@contextlib.contextmanager
def expecting(kind: str, *sources: Any) -> Iterator[None]:
    """Where the body refuses one of the sources that is a file of another kind, say which it is, in one line.

    Else a reader lists every key that it does not know. Sources that are no paths are left alone.
    """
    try:
        yield
    except (FileError, UsageError) as error:
        from mahovik.core.stand.files import FORMS, KINDS, words_of_file

        for source in sources:
            known = (None, KINDS[kind], *FORMS.get(kind, ()))
            if isinstance(source, str | Path) and (other := words_of_file(Path(source))) not in known:
                line = f"{source}: is {other}, expected {KINDS[kind]}"
                raise (type(error)([line]) if isinstance(error, FileError) else UsageError(line)) from None
        raise
