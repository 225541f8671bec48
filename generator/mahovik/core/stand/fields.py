"""Types of the keys in a stand file's tables, also in those of laws: numbers, vectors, matrices, names, texts.

Lists of quantities are spelt as docs/stand-file.md allows. A field holds its value in SI already.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping, Sequence
from decimal import Decimal
from typing import Annotated, Any, TypeVar, cast

from mahovik.contract.quantities import BOUNDS
from mahovik.core.stand import units
from mahovik.core.stand.columns import hypot
from mahovik.core.stand.tables import Blocks, QuantityValidator, Table
from mahovik.core.stand.units import (
    PLAIN,
    Dimension,
    QuantityError,
    last_digit,
    number,
    show,
    split_value_unit,
)
from mahovik.nearest import suggestion

T = TypeVar("T")
Vec3 = tuple[float, float, float]
Vec6 = tuple[float, float, float, float, float, float]
Mat3 = tuple[Vec3, Vec3, Vec3]
Mat6 = tuple[Vec6, Vec6, Vec6, Vec6, Vec6, Vec6]

ZERO3: Vec3 = (0.0, 0.0, 0.0)
ZERO6: Mat6 = ((0.0,) * 6,) * 6

ADDED_MASS: Blocks = (
    (Dimension("an added mass", "kg"), Dimension("an added first moment", "kg m")),
    (Dimension("an added first moment", "kg m"), Dimension("an added inertia", "kg m^2")),
)
LINEAR: Blocks = (
    (Dimension("a linear damping", "N s/m"), Dimension("a linear damping", "N s/rad")),
    (Dimension("a linear damping", "N s"), Dimension("a linear damping", "N m s/rad")),
)
QUADRATIC: Blocks = (
    (Dimension("a quadratic damping", "N s^2/m^2"), Dimension("a quadratic damping", "N s^2/rad^2")),
    (Dimension("a quadratic damping", "N s^2/m"), Dimension("a quadratic damping", "N m s^2/rad^2")),
)


# -- lists of quantities ----------------------------------------------------------------------------------------------


def vector(raw: Any, lengths: tuple[int, ...], dimension: Dimension, unit: str | None = None) -> tuple[float, ...]:
    """A list of as many numbers as one of `lengths` says. Raises QuantityError."""
    if isinstance(raw, dict):
        value, unit = split_value_unit(raw, unit)
        return vector(value, lengths, dimension, unit)
    wanted = " or ".join(str(n) for n in lengths)
    if not isinstance(raw, list):
        raise QuantityError(f"expected {wanted} numbers, found {show(raw)}")
    if len(raw) not in lengths:
        raise QuantityError(f"expected {wanted} numbers, found {len(raw)}")
    return tuple(_element(item, dimension, unit, f"[{i}]") for i, item in enumerate(raw))


def vec3(raw: Any, dimension: Dimension) -> Vec3:
    """Three numbers."""
    return cast(Vec3, vector(raw, (3,), dimension))


def direction(raw: Any) -> Vec3:
    """A direction of any length but zero, without unit."""
    result = vec3(raw, PLAIN)
    if not any(result):
        raise QuantityError("[0, 0, 0] has no direction")
    return result


def symmetric3(raw: Any, dimension: Dimension, unit: str | None = None) -> Mat3:
    """A symmetric 3x3, or the three numbers of its diagonal. Raises QuantityError."""
    if isinstance(raw, dict):
        value, unit = split_value_unit(raw, unit)
        return symmetric3(value, dimension, unit)
    if not isinstance(raw, list) or len(raw) != 3:
        shape = f"{len(raw)} items" if isinstance(raw, list) else show(raw)
        raise QuantityError(f"expected three rows of three numbers, or a diagonal of three, found {shape}")
    if not any(isinstance(item, list) for item in raw):
        return cast(Mat3, _diagonal(vector(raw, (3,), dimension, unit)))
    rows = tuple(numbers_of_row(row, 3, (dimension,) * 3, unit, i) for i, row in enumerate(raw))
    with_unit = raw if unit is None else {"value": raw, "unit": unit}
    return cast(Mat3, _symmetric(rows, with_unit, ((dimension,) * 2,) * 2))


def matrix6(raw: Any, blocks: Blocks, *, symmetric: bool = False) -> Mat6 | None:
    """A 6x6, or the six numbers of its diagonal; None where all are zero. Raises QuantityError.

    The four blocks differ in unit, so one unit for all is refused; an element may have its own.
    """
    if isinstance(raw, dict):
        raise QuantityError("a 6x6 mixes units (metres and radians), so one unit cannot be for all: write SI numbers")
    if not isinstance(raw, list) or len(raw) != 6:
        shape = f"{len(raw)} items" if isinstance(raw, list) else show(raw)
        raise QuantityError(f"expected six rows of six numbers, or a diagonal of six, found {shape}")
    if not any(isinstance(item, list) for item in raw):
        numbers = tuple(_element(raw[i], blocks[i // 3][i // 3], None, f"[{i}]") for i in range(6))
        rows = _diagonal(numbers)
    else:
        rows = _rows_of(raw, blocks)
        if symmetric:
            rows = _symmetric(rows, raw, blocks, SHARE)
    return cast(Mat6, rows) if any(any(row) for row in rows) else None


def _element(raw: Any, dimension: Dimension, unit: str | None, where: str) -> float:
    try:
        return number(raw, dimension, unit)
    except QuantityError as error:
        raise QuantityError(f"{where}: {error}") from None


def numbers_of_row(
    raw: Any, length: int, dimensions: tuple[Dimension, ...], unit: str | None, i: int
) -> tuple[float, ...]:
    """Row `i` of a list of rows, each number of a dimension of its own. Raises QuantityError."""
    if isinstance(raw, dict) and len(set(dimensions)) == 1:
        try:
            raw, unit = split_value_unit(raw, unit)
        except QuantityError as error:
            raise QuantityError(f"[{i}]: {error}") from None
    if not isinstance(raw, list) or len(raw) != length:
        shape = f"{len(raw)}" if isinstance(raw, list) else show(raw)
        raise QuantityError(f"[{i}]: expected {length} numbers, found {shape}")
    return tuple(_element(raw[j], dimensions[j], unit, f"[{i}][{j}]") for j in range(length))


def _diagonal(numbers: tuple[float, ...]) -> tuple[tuple[float, ...], ...]:
    return tuple(tuple(x if i == j else 0.0 for j in range(len(numbers))) for i, x in enumerate(numbers))


SHARE = 1e-3
"""Part of sqrt(M_ii M_jj) by which two elements of an added mass may differ: panel codes do not make them equal."""


def asymmetries(raw: Any, blocks: Blocks, share: float = 0.0) -> list[tuple[str, str, bool]]:
    """Pairs of elements of a matrix that differ, as written: "[2][5] = 10.774 kg m"; and whether as rounded.

    As rounded they differ by at most one unit of the last printed digit, or by `share` of the diagonal.
    """
    rows = _rows_of(raw, blocks)
    items = [[list_item(list_item(raw, i), j) for j in range(len(rows))] for i in range(len(rows))]

    def show(i: int, j: int) -> str:
        si = blocks[i // 3][j // 3].si
        return f"[{i}][{j}] = {echo(items[i][j], rows[i][j], si) or as_written(items[i][j], si)}"

    def is_rounded(i: int, j: int) -> bool:
        apart, dimension = abs(rows[i][j] - rows[j][i]), blocks[i // 3][j // 3]
        digit = min(last_digit(items[i][j], dimension), last_digit(items[j][i], dimension))
        if rows[i][j] and rows[j][i] and apart <= digit * (1.0 + 1e-6):
            return True
        return apart <= share * math.sqrt(max(rows[i][i], 0.0) * max(rows[j][j], 0.0))

    pairs = [(j, i) for i in range(len(rows)) for j in range(i) if rows[j][i] != rows[i][j]]
    return [(show(j, i), show(i, j), is_rounded(j, i)) for j, i in pairs]


def _rows_of(raw: Any, blocks: Blocks) -> tuple[tuple[float, ...], ...]:
    """The numbers of a valid matrix that is given by its rows, in SI."""
    value, unit = split_value_unit(raw, None) if isinstance(raw, dict) else (raw, None)
    dimensions = [tuple(blocks[i // 3][j // 3] for j in range(len(value))) for i in range(len(value))]
    return tuple(numbers_of_row(row, len(value), dimensions[i], unit, i) for i, row in enumerate(value))


def _symmetric(
    rows: tuple[tuple[float, ...], ...], raw: Any, blocks: Blocks, share: float = 0.0
) -> tuple[tuple[float, ...], ...]:
    """The rows, with the mean of two elements that differ as rounded. Raises QuantityError of others."""
    if all(rows[j][i] == row[j] for i, row in enumerate(rows) for j in range(i)):
        return rows
    for above, below, is_rounded in asymmetries(raw, blocks, share):
        if not is_rounded:
            raise QuantityError(f"not symmetric, {above} but {below}")
    return tuple(tuple(0.5 * (x + rows[j][i]) for j, x in enumerate(row)) for i, row in enumerate(rows))


# -- names: they become C identifiers, in a header that C++ may include ----------------------------------------------

FREQUENCY = Dimension("a frequency", "Hz")
_LONGEST = 10**9

_IDENTIFIER = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")

# C99, then C11 and C23
_C = """
auto break case char const continue default do double else enum extern float for goto if inline int long
register restrict return short signed sizeof static struct switch typedef union unsigned void volatile while
_Bool _Complex _Imaginary
_Alignas _Alignof _Atomic _BitInt _Decimal128 _Decimal32 _Decimal64 _Generic _Noreturn _Static_assert
_Thread_local alignas alignof bool constexpr false nullptr static_assert thread_local true typeof typeof_unqual
"""
_CPP = """
alignas alignof and and_eq asm bitand bitor bool catch char16_t char32_t char8_t class co_await co_return
co_yield compl concept const_cast consteval constexpr constinit decltype delete dynamic_cast explicit export
false friend mutable namespace new noexcept not not_eq nullptr operator or or_eq private protected public
reinterpret_cast requires static_assert static_cast template this thread_local throw true try typeid typename
using virtual wchar_t xor xor_eq
"""
_HEADERS = """
assert complex ctype errno fenv float inttypes iso646 limits locale math setjmp signal stdarg stdbool stddef stdint
stdio stdlib string tgmath time wchar wctype windows
"""
C_HEADERS = frozenset(_HEADERS.split())
"""Standard headers and that of Windows: a stand of such a name would have a header that hides one of them."""

C_KEYWORDS = frozenset(_C.split())
CPP_KEYWORDS = frozenset(_CPP.split())


def name_problem(name: str) -> str | None:
    """Why `name` cannot be a name in generated C, or None."""
    if not _IDENTIFIER.fullmatch(name):
        return f"{show(name)} is not a C identifier (letters, digits, _; no digit first)"
    if name in C_KEYWORDS:
        return f"{show(name)} is a C keyword"
    if name in CPP_KEYWORDS:
        return f"{show(name)} is a C++ keyword"
    return None


def stand_name_problem(name: str) -> str | None:
    """Why `name` cannot be the name of a stand, hence of its files, or None."""
    if name in C_HEADERS:
        return f"{show(name)} is the name of a standard header of C: {name}.h would hide it"
    if name.lower() == "mahovik":
        return f"{show(name)} begins the names that are the same for every stand, mahovik_encoder.h"
    if name.startswith("_"):
        return f"{show(name)} begins with _: all names of the C would, and C reserves such names; begin with a letter"
    return name_problem(name)


# -- what a key takes ------------------------------------------------------------------------------------------------


def validator(read: Callable[[Any], T], dimension: Dimension | Blocks | None = None, **more: Any) -> QuantityValidator:
    """A validator that reads a raw value by `read`, which raises QuantityError; `more`: see QuantityValidator."""

    return QuantityValidator(lambda raw, context: read(raw), dimension, **more)


def require_bounds(
    value: float,
    unit: str,
    least: float | None = None,
    above: float | None = None,
    most: float | None = None,
    raw: Any = None,
) -> float:
    """`value` itself, in `unit`. Raises QuantityError if it is out of bounds, with `raw`, the number in the file."""
    shown = echo(raw, value, unit) or f"{repr(value).removesuffix('.0')} {unit}".rstrip()
    if above is not None and most is not None and not above < value <= most:
        raise QuantityError(f"{shown}: expected above {above:g}, at most {most:g}")
    if above is not None and value <= above:
        raise QuantityError(f"{shown} is not above {above:g}")
    if least is not None and value < least:
        raise QuantityError(f"{shown} is negative" if least == 0 else f"{shown} is below {least:g}")
    if most is not None and value > most:
        raise QuantityError(f"{shown} is above {most:g}")
    return value


def scalar(
    dimension: Dimension, *, least: float | None = None, above: float | None = None, most: float | None = None
) -> QuantityValidator:
    """A validator of a number within bounds."""

    def read(raw: Any) -> float:
        return require_bounds(number(raw, dimension), dimension.si, least, above, most, raw)

    return validator(read, dimension, least=least, above=above, most=most)


def vector3(dimension: Dimension) -> QuantityValidator:
    """A validator of three numbers."""
    return validator(lambda raw: vec3(raw, dimension), dimension)


def matrix(blocks: Blocks, *, symmetric: bool = False) -> QuantityValidator:
    """A validator of a 6x6; None where it is zero."""
    return validator(lambda raw: matrix6(raw, blocks, symmetric=symmetric), blocks)


def integer(raw: Any) -> int:
    """A whole number. Raises QuantityError."""
    if isinstance(raw, bool) or not isinstance(raw, int):
        raise QuantityError(f"expected a whole number, found {show(raw)}")
    return raw


def text(raw: Any) -> str:
    """A string. Raises QuantityError."""
    if not isinstance(raw, str):
        raise QuantityError(f"expected a string, found {show(raw)}")
    return raw


def letter(letters: tuple[str, ...]) -> QuantityValidator:
    """A validator of one of some letters, which is read as its place among them."""

    def read(raw: Any) -> int:
        if text(raw) not in letters:
            raise QuantityError(f"expected one of {' '.join(letters)}, found {show(raw)}")
        return letters.index(raw)

    return validator(read, write=letters.__getitem__, words=tuple((char, i) for i, char in enumerate(letters)))


def one_word(words: Mapping[str, Any], expected: str = "") -> QuantityValidator:
    """A validator of words by what each means; `expected`: how messages tell of them."""

    def read(raw: Any) -> Any:
        if not isinstance(raw, str) or raw not in words:
            raise QuantityError(f"expected {expected or ' or '.join(map(show, words))}, found {show(raw)}")
        return words[raw]

    return validator(read, words=tuple(words.items()))


def flag(raw: Any) -> bool:
    """true or false. Raises QuantityError."""
    if not isinstance(raw, bool):
        raise QuantityError(f"expected true or false, found {show(raw)}")
    return raw


def choice(*names: str) -> QuantityValidator:
    """A validator of one of some names."""

    def read(raw: Any) -> str:
        if text(raw) not in names:
            raise QuantityError(f"unknown {show(raw)}{suggestion(raw, names)}")
        return str(raw)

    return validator(read, words=tuple((name, name) for name in names))


def short_integer(raw: Any) -> int:
    """A whole number of at most nine digits. Raises QuantityError."""
    if abs(integer(raw)) >= _LONGEST:
        raise QuantityError(f"expected a whole number, found {show(raw)}")
    return int(raw)


def whole_number(least: int, most: int) -> QuantityValidator:
    """A validator of a whole number within bounds."""

    def read(raw: Any) -> int:
        value = short_integer(raw)
        if not least <= value <= most:
            raise QuantityError(f"{value}: expected {least} to {most}")
        return value

    return validator(read, least=least, most=most)


def angular_speed(raw: Any) -> float:
    """A frequency (with unit) or an angular speed above 0, in rad/s. Raises QuantityError."""
    try:
        value = number(raw, units.SPEED) if isinstance(raw, str | dict) else math.nan
    except QuantityError:
        value = math.nan
    if math.isnan(value):
        value = 2 * math.pi * number(raw, FREQUENCY)
        if isinstance(raw, int | Decimal):
            raise QuantityError('expected a frequency with its unit, such as "40 Hz"')
    return require_bounds(value, "rad/s", above=0.0, raw=raw)


def any_list(raw: Any) -> list[Any]:
    """A list of anything. Raises QuantityError."""
    if not isinstance(raw, list):
        raise QuantityError(f"expected a list, found {show(raw)}")
    return raw


def rows(raw: Any, read: Callable[[Any], T]) -> tuple[T, ...]:
    """A list of rows, each read by `read`. Raises QuantityError for the first that cannot be read."""
    values = []
    for i, row in enumerate(any_list(raw)):
        try:
            values.append(read(row))
        except QuantityError as error:
            element = str(error)
            raise QuantityError(f"[{i}]{'' if element.startswith('[') else ': '}{element}") from None
    return tuple(values)


def positions(raw: Any, known: Sequence[str]) -> tuple[int, ...]:
    """Places in `known` of the names of a list, in the list's order. Raises QuantityError."""
    places: list[int] = []
    for name in any_list(raw):
        if name not in known:
            raise QuantityError(f"unknown {show(name)}{suggestion(str(name), known)}")
        if known.index(name) in places:
            raise QuantityError(f"{show(name)} appears twice")
        places.append(known.index(name))
    return tuple(places)


def _name(problem_of: Callable[[str], str | None]) -> QuantityValidator:
    def read(raw: Any) -> str:
        if (problem := problem_of(text(raw))) is not None:
            raise QuantityError(problem)
        return str(raw)

    return validator(read, shape="name")


Name = Annotated[str, _name(name_problem)]
StandName = Annotated[str, _name(stand_name_problem)]
Text = Annotated[str, validator(text)]
Flag = Annotated[bool, validator(flag)]
Length3 = Annotated[Vec3, vector3(units.LENGTH)]
Angle3 = Annotated[Vec3, vector3(units.ANGLE)]
Direction = Annotated[Vec3, validator(direction, shape="direction")]
Mass = Annotated[float, scalar(units.MASS, least=0.0)]
_WEIGHT = BOUNDS["MAX_WEIGHT"].value
Weight = Annotated[float, scalar(units.PLAIN, least=1.0 / _WEIGHT, most=_WEIGHT)]
Inertia3 = Annotated[Mat3, validator(lambda raw: symmetric3(raw, units.INERTIA), units.INERTIA)]
AddedMass = Annotated[Mat6 | None, matrix(ADDED_MASS, symmetric=True)]


class Mounted(Table):
    """Base of tables of what is mounted on the carrier or an instrument.

    mount  the carrier, or the name of an instrument
    """

    mount: Text = "carrier"


_PARALLEL = 1e-9  # sine of the smallest angle between two directions that still says where the second one points


def parallel(a: Vec3, b: Vec3) -> bool:
    """Is the second direction along the first, or opposite, so that it has no part across it?"""
    (ax, ay, az), (bx, by, bz) = unit(a), unit(b)
    return bool(hypot(ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx) < _PARALLEL)


def unit(a: Vec3) -> Vec3:
    """The direction with length one."""
    largest = max(abs(x) for x in a)  # first, so that squares neither overflow nor vanish
    scaled = [x / largest for x in a]
    length = hypot(*scaled)
    return (scaled[0] / length, scaled[1] / length, scaled[2] / length)


# -- numbers as a reader wrote them: "1.5 g mm", alone or within a list ------------------------------------------------

WHOLE_TURN = 2.0 * math.pi * (1.0 + 1e-6)
"""rad, with room for rounding."""


def text_with_unit(raw: Any) -> str | None:
    """The text of a number or a list that has a unit in the file: "1.5 g mm", "[1, 2, 3 mm]"; None without a unit."""
    if isinstance(raw, dict) and set(raw) == {"value", "unit"} and isinstance(raw["value"], int | Decimal | list):
        return f"{_text(raw['value'])} {raw['unit']}"
    if isinstance(raw, list):
        return _text(raw) if any(map(text_with_unit, raw)) else None
    return " ".join(raw.split()) if isinstance(raw, str) else None


def as_written(raw: Any, unit: str) -> str:
    """The text of a number or a list as it is in the file, in `unit`, SI, where it has no unit there."""
    return text_with_unit(raw) or f"{_text(raw)} {unit}"


def echo(raw: Any, value: float, unit: str) -> str | None:
    """The text of a number that has a unit in the file, and SI: "1.5 g mm (1.5e-06 kg m)"; None without a unit."""
    as_typed = text_with_unit(raw)
    return None if as_typed is None else f"{as_typed} ({value:.6g} {unit})"


def list_item(raw: Any, index: int) -> Any:
    """An item of a list as it would stand alone: with the unit of the whole list, where that has one."""
    if isinstance(raw, dict):
        return {"value": raw["value"][index], "unit": raw["unit"]}
    return raw[index]


def _text(raw: Any) -> str:
    return f"[{', '.join(text_with_unit(item) or _text(item) for item in raw)}]" if isinstance(raw, list) else str(raw)


def beyond_a_turn(name: str, raw: Any) -> list[str]:
    """A warning, in a list, of an angle or a list of them without unit, in rad, that is beyond a whole turn."""
    values = raw if isinstance(raw, list) else [raw]
    if text_with_unit(raw) is not None or not any(abs(x) > WHOLE_TURN for x in values):
        return []
    return [f"{name}: {as_written(raw, 'rad')} is beyond a whole turn: degrees without their unit?"]
