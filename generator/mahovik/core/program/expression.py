"""Expressions of a program. The tree *is* the order of operations: printer and interpreter keep it as it is.

Python operators build trees (`a*b + c`), so that lowering code reads like the formula; of arrays they build vectors
(program/vector). Equality of integers is `equal(a, b)`: `==` stays Python's own.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Iterator
from fractions import Fraction
from sys import float_info
from typing import Any, ClassVar, TypeAlias, cast

from mahovik.core.program.types import Field, Kind, NamedCount, NamedNumber, ProgramError, Struct
from mahovik.core.stand.fields import C_KEYWORDS, CPP_KEYWORDS

Number: TypeAlias = int | float | Fraction
Operand: TypeAlias = "Expr | int | float | Fraction | NamedCount"


def _operators(
    symbol: str, operate: Callable[[Any, Any], Any]
) -> tuple[Callable[[Expr, Any], Expr], Callable[[Expr, Any], Expr]]:
    """The methods that a Python operator calls on its left operand, and on its right one."""

    def operate_first(self: Expr, other: Any) -> Any:
        if not (_is_array(self) or _is_array(other)):
            return binary(symbol, self, other) if isinstance(other, OPERANDS) else NotImplemented
        return operate(_vector(self), _vector(other))

    def operate_second(self: Expr, other: Any) -> Any:
        if not _is_array(self):
            return binary(symbol, other, self) if isinstance(other, OPERANDS) else NotImplemented
        return operate(other, _vector(self))

    return operate_first, operate_second


def _is_array(value: Any) -> bool:
    return isinstance(value, Place) and bool(value.shape)


def _vector(value: Any) -> Any:
    """An array as a vector or matrix; anything else as it is."""
    return Place.vector_of(value) if _is_array(value) else value


def _comparison(symbol: str) -> Callable[[Expr, Operand], Expr]:
    return lambda self, other: compare(symbol, self, other)


class Expr:
    """A scalar expression of one kind. Subclasses are immutable."""

    __slots__ = ("kind",)
    kind: Kind

    __add__, __radd__ = _operators("+", operator.add)
    __sub__, __rsub__ = _operators("-", operator.sub)
    __mul__, __rmul__ = _operators("*", operator.mul)
    __truediv__, __rtruediv__ = _operators("/", operator.truediv)
    __mod__, _ = _operators("%", operator.mod)
    __and__, _ = _operators("&", operator.and_)
    __or__, _ = _operators("|", operator.or_)
    __xor__, _ = _operators("^", operator.xor)
    __lshift__, _ = _operators("<<", operator.lshift)
    __rshift__, _ = _operators(">>", operator.rshift)
    __lt__, __le__ = _comparison("<"), _comparison("<=")
    __gt__, __ge__ = _comparison(">"), _comparison(">=")

    def __neg__(self) -> Expr:
        return cast(Expr, -_vector(self)) if _is_array(self) else Negate(self)

    def __matmul__(self, other: Any) -> Any:
        return operator.matmul(_vector(self), _vector(other)) if _is_array(self) else NotImplemented

    @property
    def operands(self) -> tuple[Expr, ...]:
        """The expressions that it is made of; of a place its indices."""
        return ()

    def with_operands(self, part: Callable[[Expr], Expr]) -> Expr:
        """The same node with `part` of each operand; places, literals and statuses as they are."""
        return self

    def __bool__(self) -> bool:
        raise ProgramError(
            "an expression has no truth value in Python: expected `if`, `and`, `or`, `not` and single comparisons"
        )


TAKEN = C_KEYWORDS | CPP_KEYWORDS | {"NULL"}
"""Names that no variable has: those of arguments stand in a header that C++ may include."""

OPERANDS = (Expr, int, float, Fraction, NamedCount)

LARGEST = {Kind.REAL: float_info.max, Kind.INT: 2**31 - 1, Kind.WORD: 2**64 - 1}
"""Largest literals, by kind."""

ARITHMETIC = {Kind.REAL: "+-*/", Kind.INT: "+-*/%&|^", Kind.WORD: "+-*&|^<<>>", Kind.BOOL: "&|", Kind.STATUS: ""}
"""Operators, by the kind of their operands. % and bits are of ints not below 0, words are modulo their width."""


class Const(Expr):
    """A literal. Reals are rounded once to the program's element type; `name` makes it a named constant."""

    __slots__ = ("name", "value")

    def __init__(self, value: Number, kind: Kind, name: str = "") -> None:
        self.value = value
        self.kind = kind
        self.name = name


class Status(Expr):
    """A status of contract/status.py by name, such as OK or NOT_FINITE."""

    __slots__ = ("name",)

    def __init__(self, name: str) -> None:
        self.name = name
        self.kind = Kind.STATUS


class Place(Expr):
    """A variable, or a part of one: a root name and a path of member names and indices.

    Members are attributes (`stand.flywheel[s].mu_c[0]`). Only a scalar place can be read as an expression.
    """

    __slots__ = ("path", "root", "shape", "type")

    vector_of: ClassVar[Callable[[Any], Any]]
    """Vectors of arrays and places; program/vector, which imports this module, defines them."""

    def __init__(
        self, root: Variable, path: tuple[str | Expr, ...], type_: Kind | Struct, shape: tuple[Any, ...]
    ) -> None:
        self.root = root
        self.path = path
        self.type = type_
        self.shape = shape
        if isinstance(type_, Kind):
            self.kind = type_

    @property
    def operands(self) -> tuple[Expr, ...]:
        return tuple([step for step in self.path if isinstance(step, Expr)]) if self.path else ()

    @property
    def is_scalar(self) -> bool:
        return not self.shape and isinstance(self.type, Kind)

    def __getattr__(self, name: str) -> Place:
        if name.startswith("_") or name in Place.__slots__ or name == "kind":
            raise AttributeError(name)
        if self.shape:
            return cast(Place, getattr(_vector(self), name))
        return self.member(name)

    def member(self, name: str) -> Place:
        """The member `name` of a struct."""
        if self.shape or not isinstance(self.type, Struct):
            raise ProgramError(f"{self!r} is not a struct: it has no member {name}")
        field: Field | None = self.type.field(name)
        if field is None:
            raise ProgramError(f"struct {self.type.name} has no member {name}")
        return Place(self.root, (*self.path, name), field.type, field.shape)

    def __getitem__(self, index: Any) -> Place:
        """An element; of a slice a vector, of `[:, j]` a column; of a struct `[:]` is the whole."""
        if not self.shape and isinstance(self.type, Struct) and index == slice(None):
            return self
        if isinstance(index, slice):
            return cast(Place, Place.vector_of([self[i] for i in numbers_of(index, len(self))]))
        if isinstance(index, tuple):
            first, *rest = index
            if not isinstance(first, slice):
                return self[first][rest[0]]
            return cast(Place, Place.vector_of([self[i][rest[0]] for i in numbers_of(first, len(self))]))
        length = len(self)
        if isinstance(index, int | NamedCount) and not 0 <= int(index) < length:
            raise ProgramError(f"{self!r}[{int(index)}] is outside 0..{length - 1}")
        return Place(self.root, (*self.path, as_expr(index, Kind.INT)), self.type, self.shape[1:])

    def __len__(self) -> int:
        if not self.shape:
            raise ProgramError(f"{self!r} is not an array")
        return int(self.shape[0])

    def __iter__(self) -> Iterator[Place]:
        return (self[i] for i in range(len(self)))

    def __repr__(self) -> str:
        text = self.root.name
        for step in self.path:
            text += f".{step}" if isinstance(step, str) else "[]"
        return text


def numbers_of(part: slice, length: int) -> range:
    """The indices of a slice. Raises ProgramError where it begins or ends outside, which Python cuts off silently."""
    for bound in (part.start, part.stop):
        if bound is not None and not -length <= int(bound) <= length:
            raise ProgramError(f"a slice to {int(bound)} of {length} elements: expected at most {length}")
    return range(length)[part]


def paired(a: Any, b: Any) -> Iterator[tuple[Any, Any]]:
    """The elements of two arrays or vectors side by side. Raises ProgramError where one has more."""
    if len(a) != len(b):
        raise ProgramError(f"lengths differ: {len(a)} and {len(b)} elements")
    return zip(a, b, strict=True)


class Variable:
    """A named variable or argument.

    `pointer`: the emitted C reaches it through a pointer (structs, scalar results). `written`: it may be written after
    its declaration, perhaps through its address; inputs, temporaries and indices of loops are not.
    """

    __slots__ = ("name", "pointer", "shape", "type", "written")

    def __init__(
        self,
        name: str,
        type_: Kind | Struct,
        shape: tuple[Any, ...] = (),
        pointer: bool = False,
        written: bool = False,
    ) -> None:
        if name in TAKEN:
            raise ProgramError(f"{name} is a word of C, expected another name")
        self.name = name
        self.type = type_
        self.shape = shape
        self.pointer = pointer
        self.written = written

    @property
    def place(self) -> Place:
        return Place(self, (), self.type, self.shape)


class Unary(Expr):
    """An expression of one operand, of its kind if no other is given."""

    __slots__ = ("operand",)

    def __init__(self, operand: Expr, kind: Kind | None = None) -> None:
        self.operand = operand
        self.kind = kind or kind_of(operand)

    @property
    def operands(self) -> tuple[Expr, ...]:
        return (self.operand,)

    def with_operands(self, part: Callable[[Expr], Expr]) -> Expr:
        return type(self)(part(self.operand), self.kind)


class Negate(Unary):
    """-a"""

    __slots__ = ()


class Not(Unary):
    """!a"""

    __slots__ = ()


class Convert(Unary):
    """A change of kind by value: int to real, word to int and back. Never real to int, which C may leave undefined."""

    __slots__ = ()

    def __init__(self, operand: Expr, kind: Kind) -> None:
        if kind_of(operand) is Kind.REAL:
            raise ProgramError("real found, expected int or word: a real is converted by its bits only")
        super().__init__(operand, kind)


class BitCast(Unary):
    """The same bits as another kind: real to word, or word to real."""

    __slots__ = ()

    def __init__(self, operand: Expr, kind: Kind) -> None:
        if {kind_of(operand), kind} != {Kind.REAL, Kind.WORD}:
            raise ProgramError("bits are cast between real and word")
        super().__init__(operand, kind)


class Present(Unary):
    """Is an argument there whose address may be null? The operand is its place."""

    __slots__ = ()

    def __init__(self, operand: Expr, kind: Kind = Kind.BOOL) -> None:
        super().__init__(operand, kind)


class Missing(Expr):
    """Stands for an argument that a call leaves out."""

    __slots__ = ()


class Pair(Expr):
    """An operator between two operands; what it gives is a truth value."""

    __slots__ = ("left", "operator", "right")

    def __init__(self, operator: str, left: Expr, right: Expr) -> None:
        self.operator = operator
        self.left = left
        self.right = right
        self.kind = Kind.BOOL

    @property
    def operands(self) -> tuple[Expr, ...]:
        return (self.left, self.right)

    def with_operands(self, part: Callable[[Expr], Expr]) -> Expr:
        return type(self)(self.operator, part(self.left), part(self.right))


class Binary(Pair):
    """a op b, see ARITHMETIC."""

    __slots__ = ()

    def __init__(self, operator: str, left: Expr, right: Expr) -> None:
        super().__init__(operator, left, right)
        self.kind = left.kind

    def with_operands(self, part: Callable[[Expr], Expr]) -> Expr:
        return binary(self.operator, part(self.left), part(self.right))


class Compare(Pair):
    """a < b and the like; `==` and `!=` for integers only."""

    __slots__ = ()


class Logic(Pair):
    """a && b, a || b."""

    __slots__ = ()


class Select(Expr):
    """condition ? a : b"""

    __slots__ = ("condition", "no", "yes")

    def __init__(self, condition: Expr, yes: Expr, no: Expr) -> None:
        self.condition = condition
        self.yes = yes
        self.no = no
        self.kind = yes.kind

    @property
    def operands(self) -> tuple[Expr, ...]:
        return (self.condition, self.yes, self.no)

    def with_operands(self, part: Callable[[Expr], Expr]) -> Expr:
        return type(self)(part(self.condition), part(self.yes), part(self.no))


class Choice(Select):
    """condition ? a : b of reals, where both are computed: C takes it from their bits, without a branch."""

    __slots__ = ()


def kind_of(value: Expr) -> Kind:
    """Kind of a scalar. Raises ProgramError for an array or a struct."""
    if isinstance(value, Place) and not value.is_scalar:
        raise ProgramError(f"{value!r} is {'an array' if value.shape else 'a struct'}, expected a number")
    return value.kind


def _is_choice_of_literals(value: Expr) -> bool:
    """Is it `1 if test else 0`? C makes a real of either."""
    return isinstance(value, Select) and None not in (literal(value.yes), literal(value.no))


def as_expr(value: Operand, kind: Kind) -> Expr:
    """`value` as a scalar of `kind`; a Python number becomes a literal. Raises ProgramError where it is none."""
    if isinstance(value, Expr):
        if kind_of(value) is not kind and not (kind is Kind.REAL and _is_choice_of_literals(value)):
            raise ProgramError(f"kinds differ: {value.kind.value} found, {kind.value} expected")
        return value
    if isinstance(value, NamedCount):
        return Const(value.value, kind, value.name)
    if not isinstance(value, int | float | Fraction if kind is Kind.REAL else int):
        raise ProgramError(f"{value!r} is no {kind.value}")
    if not abs(value) <= LARGEST.get(kind, 1):
        raise ProgramError(f"{value!r} is no number that {kind.value} holds")
    return Const(value, kind, value.name if isinstance(value, NamedNumber) else "")


def to_write(place: Place) -> Place:
    """The place, as it is. Raises ProgramError where nothing may be written there."""
    if not place.root.written:
        raise ProgramError(f"{place!r} is an input, a temporary or an index: expected a result or a declared local")
    return place


def _pair(left: Operand, right: Operand) -> tuple[Expr, Expr]:
    """Both as expressions of one kind: a literal takes the kind of the other."""
    kind = kind_of(left) if isinstance(left, Expr) else kind_of(right) if isinstance(right, Expr) else Kind.REAL
    return as_expr(left, kind), as_expr(right, kind)


def binary(operator: str, left: Operand, right: Operand) -> Expr:
    """left op right; the shift count of << and >> is a word. Integers plus 0 or times 1 are what they are."""
    a, b = _pair(left, right)
    if operator not in ARITHMETIC[a.kind]:
        raise ProgramError(f"{operator} of {a.kind.value}: expected one of {ARITHMETIC[a.kind] or 'no operators'}")
    if a.kind is not Kind.INT or operator not in "+-*":
        return Binary(operator, a, b)
    m, n = literal(a), literal(b)
    if m is not None and n is not None:
        return integer(m + n if operator == "+" else m - n if operator == "-" else m * n)
    neutral = 1 if operator == "*" else 0
    if n == neutral or (operator == "*" and m == 0):
        return a
    if (m == neutral and operator != "-") or (operator == "*" and n == 0):
        return b
    return Binary(operator, a, b)


def literal(e: Expr) -> int | None:
    """Value of a literal integer, or None. A named constant is none: it stands for what has that name."""
    return int(e.value) if isinstance(e, Const) and e.kind is Kind.INT and not e.name else None


def compare(operator: str, left: Operand, right: Operand) -> Expr:
    """left op right as a truth value."""
    a, b = _pair(left, right)
    if a.kind is Kind.REAL and operator in ("==", "!="):
        raise ProgramError("reals are not compared for equality")
    return Compare(operator, a, b)


def equal(left: Operand, right: Operand) -> Expr:
    """left == right, for integers and statuses."""
    return compare("==", left, right)


def unequal(left: Operand, right: Operand) -> Expr:
    """left != right, for integers and statuses."""
    return compare("!=", left, right)


def condition(e: Expr) -> Expr:
    """A truth value, as it is. Raises TypeError where `e` is a number: C would take it, and NaN as true."""
    if not isinstance(e, Expr) or kind_of(e) is not Kind.BOOL:
        raise ProgramError("a condition is a comparison, not a number")
    return e


def and_(left: Expr, right: Expr) -> Expr:
    """left && right"""
    return Logic("&&", condition(left), condition(right))


def or_(left: Expr, right: Expr) -> Expr:
    """left || right"""
    return Logic("||", condition(left), condition(right))


def select(test: Expr, yes: Operand, no: Operand) -> Expr:
    """test ? yes : no"""
    a, b = _pair(yes, no)
    return Select(condition(test), a, b)


def real(value: Number) -> Expr:
    """A real literal."""
    return as_expr(value, Kind.REAL)


def word(value: int) -> Expr:
    """An unsigned literal of the element type's width."""
    return Const(value, Kind.WORD)


def integer(value: int | NamedCount) -> Expr:
    """An int literal."""
    return as_expr(value, Kind.INT)


def magnitude(value: Expr) -> Expr:
    """|a| of a real, without libm."""
    return Select(Compare("<", as_expr(value, Kind.REAL), Const(0, Kind.REAL)), Negate(value), value)
