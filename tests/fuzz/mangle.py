"""Examples of files, spoiled: by bytes, and by values that nobody would write where another stands."""

from __future__ import annotations

import json
import re
from collections.abc import Sequence
from typing import Any

from hypothesis import strategies as st

DEEP = 100_000
"""Brackets one inside another: more than any stack holds."""

NUMBERS = (
    "0", "-0.0", "-1", "1", "3", "1e308", "-1e308", "1e309", "1e-400", "5e-324", "1e999999999999999999", "1e-999999999",
    "1000000000", "2147483648", "-9223372036854775809", "9" * 400, "9" * 5000,
    "1" + "0" * 20000, "0.1" + "0" * 5000 + "1",
)  # fmt: skip
"""Numbers that are tried in TOML and in JSON."""

_BOTH = (
    "true", "false", '""', '"nan"', '"x"', '" "', '"\\u0000"', '"\\u202e"', '"\\u001b[31m"', f'"{"y" * 100_000}"',
    '"é"', '"../../../../etc/passwd"', '"/dev/null"', '"."', "[]", "[[]]", "[1]", '["1 mm"]', "[1, 2, 3]", "[0, 0, 0]",
    "[1e308, 1e308, 1e308]", "[0, 0, 1e-320]", "[true, false, true]", "[[1], 2, [3, [4]]]", "{}",
    "[" * 200 + "]" * 200, "[" * DEEP, "[" + "0," * 100_000 + "0]",
)  # fmt: skip

TOML_VALUES = (
    *NUMBERS, *_BOTH, "nan", "inf", "-inf", "0x" + "f" * 5000, "0o7", "0b" + "1" * 20000, "1_000",
    "1979-05-27T07:32:00Z", "07:32:00", "1979-05-27", "'''x'''", '"""\n"""', "{ a = 1 }", '{ value = 1, unit = "mm" }',
    "{ value = [1, 2, 3], unit = 'mm' }",
    '{ value = 1, unit = "mm", more = 2 }', "{ value = { value = { value = 1, unit = 'm' }, unit = 'm' }, unit = 'm' }",
    f'"1 kg{" " * 100_000}x"', "{" + "a." * 50_000 + "a = 1}", "{a={" * 500 + "}" * 1000, "{a=" * DEEP, "[{}, {}]", "",
)  # fmt: skip

JSON_VALUES = (
    *NUMBERS, *_BOTH, "null", "NaN", "Infinity", "-Infinity", '{"a": 1}', '{"a": 1, "a": 2}', '{"":{"":{"":{}}}}',
    '{"a":' * 500 + "1" + "}" * 500, '{"a":' * DEEP, '"\\ud800"', '"\\udfff\\ud800"', "[null]", "",
)  # fmt: skip

_UNITS = (
    "kg", "g", "mm", "m", "s", "rad", "deg", "rpm", "N", "Nm", "Hz", "kilo", "degC", "dB", "percent", "%", "µ",
    "Ω", "°", "turn", "²", "³", "·", "*", "/", "**", "^", "(", ")", "-", ".", " ", "1", "2", "9", "0",
    "99999999", "1e9", "pi", "oz", "in", "lambda", "None",
)  # fmt: skip

quantities = st.builds(
    lambda number, unit: json.dumps(f"{number} {unit}", ensure_ascii=False),
    st.sampled_from(NUMBERS),
    st.lists(st.sampled_from(_UNITS), min_size=1, max_size=6).map("".join),
)
"""Strings of a number and what may be a unit."""

texts = st.text(max_size=30).map(json.dumps)

_VALUE = re.compile(r"(?<== ).+$|(?<=[\[ ,])[-+\d.eE]+(?=[\] ,])", re.MULTILINE)
_KEY = re.compile(r"^[\w.]+(?= =)|(?<=^\[)[\w.]+(?=\])|(?<=^\[\[)\w+(?=\]\])", re.MULTILINE)


@st.composite
def spoiled_toml(draw: st.DrawFn, examples: Sequence[str]) -> str:
    """A TOML file with some values replaced, some keys renamed, some lines gone or twice."""
    text = draw(st.sampled_from(list(examples)))
    for _ in range(draw(st.integers(1, 3))):
        what = draw(st.sampled_from(("value", "value", "value", "key", "line", "lines")))
        lines = text.split("\n")
        if what in ("value", "key"):
            places = list((_VALUE if what == "value" else _KEY).finditer(text))
            if places:
                place = draw(st.sampled_from(places))
                new = (
                    draw(st.one_of(st.sampled_from(TOML_VALUES), quantities, texts)) if what == "value" else draw(_keys)
                )
                text = text[: place.start()] + new + text[place.end() :]
        elif what == "line":
            del lines[draw(st.integers(0, len(lines) - 1))]
            text = "\n".join(lines)
        else:
            first, last = sorted(draw(st.tuples(*[st.integers(0, len(lines))] * 2)))
            text = "\n".join(lines[:last] + lines[first:])
    return text


_keys = st.sampled_from(
    ("mass", "inertia", "name", "flywheel", "a.b", '""', "schema", "x" * 1000, "a." * 50_000 + "b", '"\\u0000"', "é",
     "terms")
)  # fmt: skip


@st.composite
def spoiled_json(draw: st.DrawFn, examples: Sequence[Any]) -> str:
    """A JSON text in which some values, anywhere in it, are others, and some keys too."""
    text = json.dumps(draw(st.sampled_from(list(examples))))
    for _ in range(draw(st.integers(1, 3))):
        places = list(re.finditer(r'"(?:[^"\\]|\\.)*"|-?\d[\d.eE+-]*|true|false|null|\[[^\[\]]*\]|\{[^{}]*\}', text))
        if not places:
            break
        place = draw(st.sampled_from(places))
        new = draw(st.one_of(st.sampled_from(JSON_VALUES), texts, quantities))
        text = text[: place.start()] + new + text[place.end() :]
    return text


PIECES = (b"\0" * 300, b"\xff" * 9, b"\r", b"\n", b"\xef\xbb\xbf", b"[" * 9999)


@st.composite
def spoiled_bytes(draw: st.DrawFn, examples: Sequence[bytes], longest: int = 1 << 16) -> bytes:
    """Damage an example file up to four times: flip, remove, insert or repeat bytes, or replace all of them."""
    data = draw(st.sampled_from(list(examples)))
    for _ in range(draw(st.integers(1, 4))):
        first, last = sorted(draw(st.tuples(*[st.integers(0, len(data))] * 2)))
        match draw(st.integers(0, 5)):
            case 0:
                data = data[:first] + data[last:]
            case 1:
                data = data[:last] + data[first:]
            case 2:
                data = data[:first] + draw(st.binary(max_size=16)) + data[first:]
            case 3 if first < len(data):
                data = data[:first] + bytes([data[first] ^ 1 << draw(st.integers(0, 7))]) + data[first + 1 :]
            case 4:
                data = data[:first] + draw(st.sampled_from(PIECES))
            case _:
                data = draw(st.binary(max_size=200)) if draw(st.integers(0, 9)) == 0 else data[:first]
    return data[:longest]


CELLS = (
    "nan", "inf", "-1", "phi_dot [", "phi_dot", "torque [Nm", "M [N mm]", "1e309", "1e-400", "", " ", "x", "9" * 5000,
    "1_0", "0x10", "t", "X", "X [", "X [N", "X [m**9**9]", '"',
)  # fmt: skip


@st.composite
def spoiled_csv(draw: st.DrawFn, examples: Sequence[bytes], cells: Sequence[str]) -> bytes:
    """A table with some cells replaced."""
    rows = [line.split(",") for line in draw(st.sampled_from(list(examples))).decode().splitlines()]
    for _ in range(draw(st.integers(1, 2))):
        row = draw(st.sampled_from(rows))
        row[draw(st.integers(0, len(row) - 1))] = draw(st.sampled_from(list(cells)))
    return "\n".join(",".join(row) for row in rows).encode()


_XML_VALUES = (*NUMBERS, "", "nan", "inf -inf 0", "0 0 0", "1 2", "1 2 3 4", "x" * 10_000, "fixed", "continuous",
               "floating", "base_link", "wheel2", "hinge", "&#x202e;", "\u202e", "é", "1e200 1e200 1e200",
               "1e-320 0 0")  # fmt: skip
_XML_VALUE = re.compile(r'(?<==")[^"]*(?=")')
_XML_ELEMENT = re.compile(r"<(\w+)[^>]*/>|<(\w+)[^>]*>.*?</\2>", re.DOTALL)


@st.composite
def spoiled_xml(draw: st.DrawFn, text: str) -> str:
    """An XML text in which some attributes have other values, some elements are gone, twice or elsewhere."""
    for _ in range(draw(st.integers(1, 3))):
        of_values = draw(st.booleans())
        places = list((_XML_VALUE if of_values else _XML_ELEMENT).finditer(text))
        if places:
            place = draw(st.sampled_from(places))
            whole = ("", place[0] * 2, "<x/>", place[0][: len(place[0]) // 2])
            new = draw(st.sampled_from(_XML_VALUES if of_values else whole))
            text = text[: place.start()] + new + text[place.end() :]
    return text
