"""XML files of other programs: reading them, and numbers in their attributes."""

from __future__ import annotations

import math
from pathlib import Path
from xml.etree import ElementTree as ET

from mahovik.core.stand.content import readable
from mahovik.core.stand.physical import LARGEST
from mahovik.core.stand.problems import Problems
from mahovik.core.stand.units import show
from mahovik.errors import ForeignError

ROOTS = {
    "robot": "a URDF: mahovik new",
    "mujoco": "an MJCF: mahovik new",
    "sdf": "an SDF, which has no reader here",
}
"""Kinds of files by their root element."""


def read_xml(path: Path, root: str) -> ET.Element:
    """The root element of a file. Raises ForeignError: missing, not XML, or another format."""
    try:
        found = readable(path, "an XML file")
    except ValueError as error:
        raise ForeignError([str(error)]) from None
    try:
        element = ET.fromstring(found)
    except (ET.ParseError, ValueError, LookupError) as error:  # an unknown encoding is a LookupError
        raise ForeignError([f"{path.name}: not XML: {error}"]) from None
    if element.tag != root:
        known = ROOTS.get(element.tag)
        what = f"is {known}" if known else f"expected <{root}>"
        raise ForeignError([f"{path.name}: its root element is <{element.tag}>: {what}"])
    return element


def parse_numbers(text: str, count: int) -> list[float]:
    """Exactly `count` finite numbers, separated by blanks. Raises ValueError, whose text says what was expected."""
    words = text.split()
    expected = "a number" if count == 1 else f"{count} numbers separated by blanks"
    try:
        found = [float(word) for word in words]
    except ValueError:
        raise ValueError(f"expected {expected}, found {show(text)}") from None
    if len(found) != count:
        raise ValueError(f"expected {expected}, found {show(text)}")
    if not all(map(math.isfinite, found)):
        raise ValueError(f"{show(text)} is not finite")
    if any(abs(x) > LARGEST for x in found):
        raise ValueError(f"{show(text)} is beyond the range of the emitted C, expected at most {LARGEST:g}")
    return found


class Attributes:
    """Reader of numbers in attributes; it collects the problems."""

    def __init__(self, problems: Problems) -> None:
        self._problems = problems

    def vector(self, element: ET.Element | None, key: str, default: list[float], *where: str) -> list[float]:
        """Numbers of an attribute, as many as in the default, which applies if element or attribute are missing."""
        text = None if element is None else element.get(key)
        if text is None:
            return default
        try:
            return parse_numbers(text, len(default))
        except ValueError as error:
            self._problems.add(*where, key, str(error))
            return default

    def number(self, element: ET.Element | None, key: str, default: float | None, *where: str) -> float:
        """One number; `default` None: it is required."""
        if default is None and (element is None or element.get(key) is None):
            self._problems.add(*where, key, "required, but missing")
            return 0.0
        return self.vector(element, key, [default or 0.0], *where)[0]
