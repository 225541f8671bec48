"""Every error a user can cause: one line that says where, what was found, what was expected, what to do.

The command line prints `str(error)` and exits with `error.exit_status`; it never shows a traceback for these.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from importlib import import_module
from typing import Any


class MahovikError(Exception):
    """Base of all errors a user can cause. `exit_status` is the process's: 1 a check failed, 2 bad input or usage."""

    exit_status = 2

    def __str__(self) -> str:
        return printable(Exception.__str__(self))


class FileError(MahovikError):
    """A file was refused. `problems` holds one line each, all that were found, in the file's order."""

    def __init__(self, problems: Sequence[str]) -> None:
        self.problems = tuple(problems)
        super().__init__("\n".join(self.problems))


class StandError(FileError):
    """A stand file was refused."""


class RegimeError(FileError):
    """A regime file was refused."""


class MotionError(FileError):
    """A motion file was refused."""


class ProgrammeError(FileError):
    """A programme file was refused."""


class ServoError(FileError):
    """A servo file was refused."""


class CampaignError(FileError):
    """A campaign file was refused."""


class BalanceError(FileError):
    """Data for balancing were refused."""


class DataError(FileError):
    """Files of measured data were refused."""


class ForeignError(FileError):
    """A model of another program was refused: no stand, or no model."""


class StateError(MahovikError):
    """A state of `eval` cannot be evaluated: its result line holds the message in `error`."""


class RefusedError(StateError):
    """The C refused some states of a call.

    function  that was called
    index     of the first refused state
    status    of that state, a negative number; `name` is its name
    count     how many were refused
    """

    def __init__(self, message: str, function: str, index: int, status: int, name: str, count: int) -> None:
        self.function, self.index, self.status, self.name, self.count = function, index, status, name, count
        super().__init__(message)

    def __reduce__(self) -> tuple[Any, ...]:  # from a worker process
        message = Exception.__str__(self)
        return type(self), (message, self.function, self.index, self.status, self.name, self.count)


class InputError(MahovikError, ValueError):
    """An array, a name or an option given to the Python interface was refused."""


class UsageError(MahovikError):
    """A combination of options, files or names that means nothing."""


class ToolchainError(MahovikError):
    """A compiler or emulator is missing, or refused what it was given."""


class NoCompilerError(ToolchainError):
    """No C compiler is named, and none of the usual ones is there."""


class CheckError(MahovikError):
    """A check failed."""

    exit_status = 1


def count_numbers(count: int) -> str:
    """How many numbers, in words: "1 number", "2 numbers"."""
    return f"{count} number{'' if count == 1 else 's'}"


def whole_number(name: str, value: Any, least: int = 1, most: int | None = None) -> None:
    """Raise UsageError unless an argument is a whole number of at least `least` and at most `most`."""
    if not (hasattr(value, "__index__") and least <= value <= (value if most is None else most)):
        expected = f"of at least {least}" if most is None else f"from {least} to {most}"
        raise UsageError(f"{name} {value}: expected a whole number {expected}")


def above_zero(name: str, value: float) -> None:
    """Raise UsageError unless an argument is a finite number above 0."""
    if not 0.0 < value < math.inf:
        raise UsageError(f"{name} {value:g}: expected a number above 0")


def library(name: str, extra: str) -> Any:
    """A library that only some users have. Raises UsageError, with the command that installs it."""
    try:
        return import_module(name)
    except ImportError:
        raise UsageError(f'{name.partition(".")[0]} is not installed: pip install "mahovik[{extra}]"') from None


def printable(text: str) -> str:
    """The text with control characters and surrogates as `\\x1b`: what a file says must not steer a terminal."""
    return "".join(c if c.isprintable() or c in "\n\t" else ascii(c)[1:-1] for c in text)
