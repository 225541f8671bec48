"""Expressions as C text. Parentheses are printed where C would parse another tree, and where gcc asks for them."""

from __future__ import annotations

from collections.abc import Iterable

from mahovik.core.emit.literal import real_literal, word_literal
from mahovik.core.emit.names import Names, member
from mahovik.core.program.call import Call
from mahovik.core.program.expression import (
    Binary,
    BitCast,
    Choice,
    Compare,
    Const,
    Convert,
    Expr,
    Logic,
    Missing,
    Negate,
    Not,
    Place,
    Present,
    Select,
    Status,
)
from mahovik.core.program.types import Kind, Precision, Struct
from mahovik.core.program.walk import inside

Element = tuple[int, str, int]
"""An element of an array of structs: `id` of the variable, the member that is the array, `id` of the index."""

_LEVEL = {"*": 80, "/": 80, "%": 80, "+": 70, "-": 70, "<<": 60, ">>": 60}
_NONE: Element = (0, "", 0)
_LEVEL |= {"&": 40, "^": 39, "|": 38, "&&": 30, "||": 29}
_UNARY, _PRIMARY, _COMPARE, _SELECT = 90, 100, 50, 20
_ARITHMETIC = {"+", "-", "*", "/", "%"}


class Expressions:
    """Prints the expressions of one program."""

    def __init__(self, names: Names, precision: Precision) -> None:
        self._names = names
        self._precision = precision
        self._named: dict[Element, str] = {}

    def text(self, e: Expr) -> str:
        """C text of a scalar expression."""
        return self._print(e)[0]

    def place(self, place: Place) -> str:
        """C text of a place that is read or written: `table->flywheel[s].mu_c[0]`, `*energy`."""
        root = place.root
        if root.pointer and not place.path:
            return f"*{root.name}"
        return self._path(place)

    def call_argument(self, e: Expr) -> str:
        """C text of an argument of a call: structs and scalar results by address."""
        if not isinstance(e, Place):
            return self.text(e)
        root = e.root
        if e.shape:
            return self._path(e)
        if isinstance(e.type, Struct):
            named = self._named.get(self.element(e) or _NONE) if len(e.path) == 2 else None
            return named or (root.name if root.pointer and not e.path else f"&{self._path(e)}")
        return self.text(e)

    def address(self, place: Place) -> str:
        """C text of the address of a scalar that a call writes."""
        return place.root.name if place.root.pointer else f"&{self._path(place)}"

    def element(self, e: Expr) -> Element | None:
        """The element of an array of structs, by an index that is a variable, that a place is or is in."""
        match e:
            case Place(root=root, path=(str() as array, Place(root=index, path=()), *inner)):
                if (inner[:1] and isinstance(inner[0], str)) or (isinstance(e.type, Struct) and not e.shape):
                    return id(root), array, id(index)
        return None

    def name_element(self, element: Element, pointer: str) -> None:
        """From now on places in an element begin with the name of a pointer to it."""
        self._named[element] = pointer

    def forget(self, elements: Iterable[Element]) -> None:
        """End of the names of elements."""
        for element in elements:
            del self._named[element]

    def _path(self, place: Place) -> str:
        text, path = place.root.name, place.path
        pointer = place.root.pointer
        if self._named and (named := self._named.get(self.element(place) or _NONE)):
            text, path, pointer = named, path[2:], True
        for step in path:
            if isinstance(step, str):
                text += f"->{member(step)}" if pointer else f".{member(step)}"
            else:
                text += f"[{self.text(step)}]"
            pointer = False
        return text

    def _print(self, e: Expr) -> tuple[str, int]:
        """Text of an expression, and its precedence."""
        match e:
            case Const():
                return self._constant(e)
            case Status():
                return self._names.constant(e.name), _PRIMARY
            case Place():
                return self.place(e), _PRIMARY
            case Negate() if self._narrow(e.operand):
                return f"-{self._widen(e.operand)}", _UNARY
            case Negate():
                return f"-{self._inside(e.operand, _UNARY + 1)}", _UNARY
            case Missing():
                return "NULL", _PRIMARY
            case Present(operand=Place(root=root)):
                return f"{root.name} != NULL", _COMPARE
            case Not(operand=Present(operand=Place(root=root))):
                return f"{root.name} == NULL", _COMPARE
            case Not():
                return f"!{self._inside(e.operand, _UNARY + 1)}", _UNARY
            case Binary() | Logic():
                return self._binary(e)
            case Compare():
                left, right = (self._inside(side, 61) for side in (e.left, e.right))
                return f"{left} {e.operator} {right}", _COMPARE
            case Choice():
                operands = ", ".join(self.text(x) for x in e.operands)
                return f"{self._names.function('chosen')}({operands})", _PRIMARY
            case Select():
                condition = f"({self.text(e.condition)})"
                return f"{condition} ? {self._inside(e.yes, 61)} : {self._inside(e.no, 61)}", _SELECT
            case Convert():
                return f"({self._names.type(e.kind)}){self._inside(e.operand, _UNARY)}", _UNARY
            case BitCast():
                function = self._names.function("bits_of" if e.kind is Kind.WORD else "real_of")
                return f"{function}({self.text(e.operand)})", _PRIMARY
            case Call():
                return self.call(e), _PRIMARY
        raise TypeError(f"{type(e).__name__} has no form in C")

    def _inside(self, e: Expr, least: int) -> str:
        text, level = self._print(e)
        return text if level >= least else f"({text})"

    def _constant(self, e: Const) -> tuple[str, int]:
        if e.name:
            return self._names.constant(e.name), _PRIMARY
        if e.kind is Kind.REAL:
            text = real_literal(float(e.value), self._precision)
        elif e.kind is Kind.WORD:
            text = word_literal(int(e.value))
        else:
            text = str(int(e.value))
        return text, _UNARY if text.startswith("-") else _PRIMARY

    def _binary(self, e: Binary | Logic) -> tuple[str, int]:
        level = _LEVEL[e.operator]
        left = self._side(e, e.left, level)
        if self._narrow(e.left) and (e.operator in ("<<", ">>") or self._narrow(e.right)):
            left = self._widen(e.left)
        right = self._side(e, e.right, level + 1)
        calls = any(isinstance(part, Choice) for part in inside(e.right))
        if e.operator in ("&", "|") and isinstance(e.right, Compare) and calls:
            right = f"(int){right}"  # clang warns of a comparison of what a function gives
        return f"{left} {e.operator} {right}", level

    def _narrow(self, e: Expr) -> bool:
        """Would C compute this word with fewer bits? A small literal is an `unsigned int`."""
        match e:
            case Const():
                return e.kind is Kind.WORD and self._precision.width > 32 and int(e.value) < 1 << 32
            case Select():
                return self._narrow(e.yes) and self._narrow(e.no)
        return False

    def _widen(self, e: Expr) -> str:
        return f"({self._names.type(Kind.WORD)}){self._inside(e, _UNARY)}"

    def _side(self, parent: Binary | Logic, e: Expr, least: int) -> str:
        """An operand; unlike operators other than + - * / get parentheses, as gcc's -Wparentheses wants."""
        text, level = self._print(e)
        mixed = isinstance(e, Binary | Logic | Compare) and parent.operator not in _ARITHMETIC
        same = isinstance(e, Binary | Logic) and e.operator == parent.operator
        if isinstance(e, Compare) and isinstance(parent, Logic):
            mixed = False
        return f"({text})" if level < least or (mixed and not same) else text

    def call(self, e: Call) -> str:
        """A call with its arguments."""
        arguments = []
        for parameter, value in zip(e.signature.arguments, e.arguments, strict=True):
            scalar_result = parameter.variable.pointer and not isinstance(parameter.type, Struct)
            if scalar_result:
                assert isinstance(value, Place)
                arguments.append(self.address(value))
            else:
                arguments.append(self.call_argument(value))
        return f"{self._names.function(e.signature.name)}({', '.join(arguments)})"
