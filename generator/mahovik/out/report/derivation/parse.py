"""Text as notation, written as docs/model.md has it:

K_s = L_s Theta_s L_s^T         names with sub- and superscripts; {..} where one has more than letters and digits
K* V*, mu', dot(phi)_s          star and primes behind a name, rates with dot(..) and ddot(..)
<a>  [C]  (x + y)               cross-product matrix, brackets, parentheses
{E, 0; <O>, E}                  a matrix by rows
sum_s I_s                       a sum over s
x / y  ,  1/2                   a slash in a line; a fraction of two numbers
"text"                          words; only spaces: a gap
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from mahovik.out.report.derivation.notation import (
    BigSum,
    Dots,
    Fence,
    Fraction,
    FunctionName,
    Grid,
    Letter,
    Node,
    Number,
    Operator,
    Script,
    Words,
    Zero,
    row,
)

_TOKEN = re.compile(r'\s*("[^"]*"|[A-Za-z]+|\d+|[-+=,;·×/()\[\]<>{}_^*\']|\S)')
_FENCES = {"(": ")", "[": "]", "<": ">"}


class NotationError(ValueError):
    """Text that is no notation."""


def parse(text: str) -> Node:
    """The tree of a text. Raises NotationError."""
    return _Parser(text).whole()


class _Parser:
    """Recursive descent over tokens."""

    def __init__(self, text: str) -> None:
        self._text = text
        self._tokens = _TOKEN.findall(text)
        self._at = 0

    def whole(self) -> Node:
        """Everything."""
        found = row(*self._items(()))
        if self._at < len(self._tokens):
            raise self._error("unexpected")
        return found

    def _items(self, ends: tuple[str, ...]) -> Iterator[Node]:
        while self._at < len(self._tokens) and self._peek() not in ends:
            yield self._parse_scripts()

    def _peek(self) -> str:
        return str(self._tokens[self._at]) if self._at < len(self._tokens) else ""

    def _take(self, wanted: str = "") -> str:
        token = self._peek()
        if not token or (wanted and token != wanted):
            raise self._error(f"expected {wanted or 'more'}, found")
        self._at += 1
        return token

    def _error(self, what: str) -> NotationError:
        return NotationError(f"{what} {self._peek()!r} in {self._text!r}")

    def _parse_scripts(self) -> Node:
        base = self._atom()
        sub: Node | None = None
        sup: list[Node] = []
        while (mark := self._peek()) in ("_", "^", "*", "'") and mark:
            self._take()
            if mark == "_":
                sub = self._script()
            elif mark == "^":
                sup.append(self._script())
            else:
                sup.append(Operator({"*": "∗", "'": "′"}[mark]))
        if isinstance(base, Letter) and base.name == "sum":
            return BigSum(sub if sub is not None else row())
        return base if sub is None and not sup else Script(base, sub, row(*sup) if sup else None)

    def _script(self) -> Node:
        """A braced script, or one token."""
        if self._peek() != "{":
            return self._atom()
        self._take("{")
        found = row(*self._items(("}",)))
        self._take("}")
        return found

    def _atom(self) -> Node:
        token = self._take()
        if token[0] == '"':
            return Words(token[1:-1])
        if token in ("dot", "ddot"):
            self._take("(")
            body = row(*self._items((")",)))
            self._take(")")
            return Dots(body, len(token) - 2)
        if token in ("cos", "sin"):
            return FunctionName(token)
        if token.isalpha():
            return Letter(token)
        if token.isdigit():
            return self._number(token)
        if token in _FENCES:
            body = row(*self._items((_FENCES[token],)))
            self._take(_FENCES[token])
            return Fence(token, body)
        if token == "{":
            return self._grid()
        if token in "+-=≈,·×/":
            return Operator("−" if token == "-" else token)
        self._at -= 1
        raise self._error("unexpected")

    def _number(self, digits: str) -> Node:
        following = self._tokens[self._at : self._at + 2]
        if len(following) == 2 and following[0] == "/" and following[1].isdigit():
            self._at += 2
            return Fraction(Number(digits), Number(following[1]))
        return Number(digits)

    def _grid(self) -> Node:
        rows: list[tuple[Node, ...]] = []
        cells: list[Node] = []
        while True:
            cell = row(*self._items((",", ";", "}")))
            cells.append(Zero() if cell == Number("0") else cell)
            end = self._take()
            if end in ";}":
                rows.append(tuple(cells))
                cells = []
            if end == "}":
                return Grid(tuple(rows))
