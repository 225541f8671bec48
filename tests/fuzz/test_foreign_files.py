"""URDF and MJCF files; the stand file of what is taken."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fuzz.mangle import NUMBERS, spoiled_bytes
from fuzz.reading import READERS, fuzzed, read_or_refuse
from mahovik.out.foreign.merge import ImportedStand, make_stand
from mahovik.out.foreign.mjcf import read_mjcf
from mahovik.out.foreign.urdf import read_urdf
from mahovik.out.foreign.write import stand_file

pytestmark = READERS

MODELS = Path(__file__).parents[1] / "foreign" / "models"
EXAMPLES = {kind: (MODELS / f"sat.{kind}").read_text() for kind in ("urdf", "xml")}
VALUES = (*NUMBERS, "", "nan", "inf -inf 0", "0 0 0", "1 2", "1 2 3 4", "x" * 10_000, "fixed", "continuous", "floating",
          "base_link", "wheel2", "hinge", "&#x202e;", "\u202e", "é", "1e200 1e200 1e200", "1e-320 0 0")  # fmt: skip

_VALUE = re.compile(r'(?<==")[^"]*(?=")')
_ELEMENT = re.compile(r"<(\w+)[^>]*/>|<(\w+)[^>]*>.*?</\2>", re.DOTALL)


@st.composite
def spoiled_xml(draw: st.DrawFn, text: str) -> str:
    """Some attributes have other values, some elements are gone, twice or elsewhere."""
    for _ in range(draw(st.integers(1, 3))):
        of_values = draw(st.booleans())
        places = list((_VALUE if of_values else _ELEMENT).finditer(text))
        if places:
            place = draw(st.sampled_from(places))
            whole = ("", place[0] * 2, "<x/>", place[0][: len(place[0]) // 2])
            text = text[: place.start()] + draw(st.sampled_from(VALUES if of_values else whole)) + text[place.end() :]
    return text


def into_a_stand(path: Path) -> None:
    """Every file gives a stand, or is refused."""

    def whole() -> ImportedStand:
        found = make_stand(read_urdf(path) if path.suffix == ".urdf" else read_mjcf(path), "x", path.name)
        stand_file(found, path.name, "x")
        return found

    found = read_or_refuse(whole)
    assert found is None or all("\n" not in note for note in found.notes)


@fuzzed(300)
@given(text=spoiled_xml(EXAMPLES["urdf"]))
def test_urdf(text: str, tmp_path_factory: pytest.TempPathFactory) -> None:
    file = tmp_path_factory.getbasetemp() / "m.urdf"
    file.write_text(text)
    into_a_stand(file)


@fuzzed(100)
@given(data=spoiled_bytes([EXAMPLES["urdf"].encode()]))
def test_bytes(data: bytes, tmp_path_factory: pytest.TempPathFactory) -> None:
    file = tmp_path_factory.getbasetemp() / "m.urdf"
    file.write_bytes(data)
    into_a_stand(file)


@fuzzed(150)
@given(text=spoiled_xml(EXAMPLES["xml"]))
def test_mjcf(text: str, tmp_path_factory: pytest.TempPathFactory) -> None:
    file = tmp_path_factory.getbasetemp() / "m.xml"
    file.write_text(text)
    into_a_stand(file)
