"""Function bodies as C text."""

from __future__ import annotations

from mahovik.core.emit.expression import Expressions
from mahovik.core.emit.layout import WIDTH, comment_lines, wrap_statement
from mahovik.core.emit.names import Names
from mahovik.core.program.expression import Negate, Place, Variable
from mahovik.core.program.statement import (
    Block,
    Copy,
    Declare,
    Do,
    Let,
    Loop,
    Note,
    Return,
    Set,
    Statement,
    When,
)

_STEP = "    "

_SHORT = 34
"""Length, characters, up to which assignments to elements of an array are printed several on a line."""


class Statements:
    """Prints the bodies of one program's functions."""

    def __init__(self, names: Names, expressions: Expressions) -> None:
        self._names = names
        self._expressions = expressions

    def block(self, body: tuple[Statement, ...], indent: str) -> list[str]:
        """Lines of a block. Declarations of like scalars that follow one another share a line."""
        lines: list[str] = []
        position = 0
        while position < len(body):
            run = self._plain_declarations(body, position)
            if len(run) > 1:
                names = ", ".join(v.name for v in run)
                lines.append(f"{indent}{self._names.type(run[0].type)} {names};")
                position += len(run)
                continue
            pack = self._element_run(body, position)
            if len(pack) > 1:
                lines += self._pack_assignments(pack, indent)
                position += len(pack)
                continue
            if self._can_initialise(body, position):
                lines += self._initialisation(body[position], body[position + 1], indent)
                position += 2
                continue
            lines += self._statement(body[position], indent)
            position += 1
        return lines

    def _element_run(self, body: tuple[Statement, ...], start: int) -> list[str]:
        """Short assignments to elements of one array that follow one another, as text."""
        found: list[str] = []
        first: Set | None = None
        for statement in body[start:]:
            if not isinstance(statement, Set) or statement.comment or not statement.place.path:
                break
            place = statement.place
            if first is None:
                first = statement
            same = place.root is first.place.root and len(place.path) == len(first.place.path)
            text = self._assignment(statement)
            array = not isinstance(place.path[-1], str)
            if not same or not array or not self._siblings(place, first.place) or len(text) > _SHORT:
                break
            found.append(text)
        return found

    def _siblings(self, a: Place, b: Place) -> bool:
        """Are both elements of the same array?"""
        return self._expressions.place(a).rpartition("[")[0] == self._expressions.place(b).rpartition("[")[0]

    def _pack_assignments(self, texts: list[str], indent: str) -> list[str]:
        """Up to three assignments a line, in columns."""
        width = max(len(t) for t in texts)
        count = max(1, min(3, (WIDTH - len(indent) + 2) // (width + 2)))
        rows = [texts[i : i + count] for i in range(0, len(texts), count)]
        return [indent + "  ".join(f"{t:<{width}}" for t in row).rstrip() for row in rows]

    def _assignment(self, s: Set) -> str:
        """`a = b;`, `a += b;`, and `a -= b;` for a + (-b), which is the same number."""
        text, target = self._expressions.text, self._expressions.place(s.place)
        if s.add and isinstance(s.value, Negate):
            return f"{target} -= {text(s.value.operand)};"
        return f"{target} {'+=' if s.add else '='} {text(s.value)};"

    def _can_initialise(self, body: tuple[Statement, ...], position: int) -> bool:
        """A scalar is declared, and the next statement gives it its first value."""
        first, second = body[position], body[position + 1] if position + 1 < len(body) else None
        if not isinstance(first, Declare) or not isinstance(second, Set) or first.variable.shape:
            return False
        return second.place.root is first.variable and not second.place.path and not second.add

    def _initialisation(self, first: Statement, second: Statement, indent: str) -> list[str]:
        assert isinstance(first, Declare) and isinstance(second, Set)
        value = self._expressions.text(second.value)
        return self._line(
            f"{self._local_declaration(first.variable)} = {value};", indent, first.comment or second.comment
        )

    def _plain_declarations(self, body: tuple[Statement, ...], start: int) -> list[Variable]:
        found: list[Variable] = []
        for statement in body[start:]:
            if not isinstance(statement, Declare) or statement.comment or statement.variable.shape:
                break
            if found and statement.variable.type != found[0].type:
                break
            found.append(statement.variable)
        return found

    def _statement(self, s: Statement, indent: str) -> list[str]:
        text = self._expressions.text
        match s:
            case Note(note):
                return comment_lines(note, indent)
            case Let(variable, value, comment):
                return self._line(
                    f"const {self._names.type(variable.type)} {variable.name} = {text(value)};", indent, comment
                )
            case Declare(variable, comment):
                return self._line(f"{self._local_declaration(variable)};", indent, comment)
            case Set():
                return self._line(self._assignment(s), indent, s.comment)
            case Copy(target, source, comment):
                return self._line(
                    f"{self._expressions.place(target)} = {self._expressions.place(source)};", indent, comment
                )
            case Do(call, comment):
                ignored = "(void)" if call.signature.returns is not None else ""
                return self._line(f"{ignored}{self._expressions.call(call)};", indent, comment)
            case Return(value):
                return self._line(f"return {text(value)};", indent, "")
            case Block(body):
                return [f"{indent}{{", *self.block(body, indent + _STEP), f"{indent}}}"]
            case Loop():
                return self._loop(s, indent)
            case When():
                return self._when(s, indent)
        raise TypeError(f"{type(s).__name__} has no form in C")

    def _line(self, code: str, indent: str, comment: str) -> list[str]:
        lines = wrap_statement(code, indent)
        if not comment:
            return lines
        if len(lines) == 1 and len(lines[0]) + len(comment) + 8 <= WIDTH:
            return [f"{lines[0]}  /* {comment} */"]
        return [*comment_lines(comment, indent), *lines]

    def _loop(self, s: Loop, indent: str) -> list[str]:
        i, text = s.index.name, self._expressions.text
        comment = f"  /* {s.comment} */" if s.comment else ""
        head = f"for (int {i} = {text(s.start)}; {i} < {text(s.stop)}; ++{i}) {{"
        return [f"{indent}{head}{comment}", *self.block(s.body, indent + _STEP), f"{indent}}}"]

    def _when(self, s: When, indent: str) -> list[str]:
        comment = f"  /* {s.comment} */" if s.comment else ""
        head = f"if ({self._expressions.text(s.condition)}) {{"
        if len(s.body) == 1 and isinstance(s.body[0], Return) and not s.otherwise:
            return wrap_statement(f"{head} return {self._expressions.text(s.body[0].value)}; }}{comment}", indent)
        lines = [*wrap_statement(head + comment, indent), *self.block(s.body, indent + _STEP)]
        if s.otherwise:
            lines += [f"{indent}}} else {{", *self.block(s.otherwise, indent + _STEP)]
        return [*lines, f"{indent}}}"]

    def _local_declaration(self, variable: Variable) -> str:
        return self._names.declaration(variable.name, variable.type, variable.shape)
