"""Function bodies as C text."""

from __future__ import annotations

from collections import Counter

from mahovik.core.emit.expression import Expressions
from mahovik.core.emit.layout import WIDTH, comment_lines, wrap_statement
from mahovik.core.emit.names import Names
from mahovik.core.program import statement as of
from mahovik.core.program.call import Call
from mahovik.core.program.expression import Compare, Expr, Negate, Place, Status, Variable
from mahovik.core.program.function import Function
from mahovik.core.program.statement import Copy, Declare, Do, Let, Loop, Note, Return, Set, Statement, When
from mahovik.core.program.types import Struct
from mahovik.core.program.walk import FreshNames, expressions, inside, statements, used_variables

_STEP = "    "

_SHORT = 34
"""Length, characters, up to which assignments to elements of an array are printed several on a line."""

_OFTEN = 3
"""Uses of an element of an array of structs in a loop over it, from which on it has a name there."""


class Statements:
    """Prints the bodies of one program's functions."""

    def __init__(self, names: Names, expressions: Expressions) -> None:
        self._names = names
        self._expressions = expressions
        self._constant: dict[int, bool] = {}
        self._twice: set[str] = set()
        self._fresh = FreshNames(())

    def function(self, function: Function) -> list[str]:
        """Lines of a function's body."""
        structs = [a for a in function.arguments if a.variable.pointer and isinstance(a.type, Struct)]
        self._constant = {id(a.variable): a.direction == "in" for a in structs}
        local = [s for s in statements(function.body) if isinstance(s, Let | Declare)]
        loops = [s.index for s in statements(function.body) if isinstance(s, Loop)]
        counted = Counter(variable.name for variable in (*(a.variable for a in function.arguments), *loops))
        counted.update(s.variable.name for s in local)
        self._twice = {name for name, count in counted.items() if count > 1}
        self._fresh = FreshNames(counted)
        return self._block(function.body, _STEP)

    def _block(self, body: of.Statements, indent: str) -> list[str]:
        """Lines of a block. Declarations of like variables that follow one another share a line."""
        lines: list[str] = []
        body, first_values = _arranged(body)
        position = 0
        while position < len(body):
            s = body[position]
            run = self._plain_declarations(body[position:], indent)
            pack = [] if position in first_values else self._element_run(body[position:])
            if len(run) > 1:
                lines.append(f"{indent}{self._names.type(run[0].type)} {', '.join(map(self._with_lengths, run))};")
                position += len(run)
            elif len(pack) > 1:
                lines += self._pack_assignments(pack, indent)
                position += len(pack)
            else:
                lines += self._statement(s, indent, first_values.get(position))
                position += 1
        return lines

    def _element_run(self, body: of.Statements) -> list[str]:
        """Short assignments to elements of one array that follow one another, as text."""
        element_run: list[str] = []
        first: Set | None = None
        for statement in body:
            if not isinstance(statement, Set) or statement.comment or not statement.place.path:
                break
            place = statement.place
            first = first or statement
            same = place.root is first.place.root and len(place.path) == len(first.place.path)
            text = self._assignment(statement)
            array = not isinstance(place.path[-1], str)
            if not same or not array or not self._siblings(place, first.place) or len(text) > _SHORT:
                break
            element_run.append(text)
        return element_run

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

    def _plain_declarations(self, body: of.Statements, indent: str) -> list[Variable]:
        """Variables of one type that are declared one after the other, without a word, as far as a line has room."""
        variables: list[Variable] = []
        room = WIDTH - len(indent)
        for statement in body:
            if not isinstance(statement, Declare) or statement.comment:
                break
            variable = statement.variable
            if variables and variable.type != variables[0].type:
                break
            room -= len(self._with_lengths(variable)) + 2 + (0 if variables else len(self._names.type(variable.type)))
            if room < 0:
                break
            variables.append(variable)
        return variables

    def _statement(self, s: Statement, indent: str, declared: Declare | None) -> list[str]:
        """Lines of a statement; `declared`: the variable to which it gives the first value is declared by it."""
        text = self._expressions.text
        match s:
            case Note(note):
                return comment_lines(note, indent)
            case Let(variable, value, comment):
                return self._line(f"const {self._declaration(variable)} = {text(value)};", indent, comment)
            case Declare(variable, comment):
                return self._line(f"{self._declaration(variable)};", indent, comment)
            case Set(_, value, comment) | Copy(_, value, comment) if declared is not None:
                first = f"{self._declaration(declared.variable)} = {text(value)};"
                return self._line(first, indent, declared.comment or comment)
            case Set():
                return self._line(self._assignment(s), indent, s.comment)
            case Copy(target, source, comment):
                copied = f"{self._expressions.place(target)} = {self._expressions.place(source)};"
                return self._line(copied, indent, comment)
            case Do(call, comment):
                ignored = "(void)" if call.signature.returns is not None else ""
                return self._line(f"{ignored}{self._expressions.call(call)};", indent, comment)
            case Return(value):
                return self._line(f"return {text(value)};", indent, "")
            case of.Block(body):
                if any(isinstance(inner, Let | Declare) and inner.variable.name in self._twice for inner in body):
                    return [f"{indent}{{", *self._block(body, indent + _STEP), f"{indent}}}"]
                return self._block(body, indent)
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
        head = f"for (int {i} = {text(s.start)}; {i} < {text(s.stop)}; ++{i}) {{"
        named = self._named_elements(s)
        lines = [f"{indent}{_STEP}{line}" for line in named.values()]
        lines += self._block(s.body, indent + _STEP)
        self._expressions.forget(named)
        return self._braced(head, s.comment, lines, indent)

    def _named_elements(self, s: Loop) -> dict[tuple[int, str, int], str]:
        """Declarations of pointers to the elements of arrays of structs that the body of a loop uses often."""
        uses: Counter[tuple[int, str, int]] = Counter()
        places: dict[tuple[int, str, int], Place] = {}
        for e in expressions(s.body):
            key = self._expressions.element(e)
            if key is not None and key[0] in self._constant and key[2] == id(s.index):
                assert isinstance(e, Place)
                uses[key] += 1
                places[key] = e.root.place.member(key[1])[s.index.place]
        named_elements = {}
        for key, count in uses.items():
            if count >= _OFTEN:
                place = places[key]
                assert isinstance(place.type, Struct)
                name, path = self._fresh(place.type.name), self._expressions.place(place)
                const = "const " if self._constant[key[0]] else ""
                named_elements[key] = f"{const}{self._names.type(place.type)} *{name} = &{path};"
                self._expressions.name_element(key, name)
        return named_elements

    def _braced(self, head: str, comment: str, lines: list[str], indent: str) -> list[str]:
        """A statement with its body in braces: on one line where the body is a statement and there is room."""
        if len(lines) == 1 and not comment and lines[0].count(";") == 1 and lines[0].endswith(";"):
            whole = f"{indent}{head} {lines[0].strip()} }}"
            if len(whole) <= WIDTH:
                return [whole]
        said = f"  /* {comment} */" if comment else ""
        return [*wrap_statement(head + said, indent), *lines, f"{indent}}}"]

    def _when(self, s: When, indent: str) -> list[str]:
        comment = f"  /* {s.comment} */" if s.comment else ""
        head = f"if ({self._expressions.text(s.condition)}) {{"
        if len(s.body) == 1 and isinstance(s.body[0], Return) and not s.otherwise:
            return wrap_statement(f"{head} return {self._expressions.text(s.body[0].value)}; }}{comment}", indent)
        lines = self._block(s.body, indent + _STEP)
        if not s.otherwise:
            return self._braced(head, s.comment, lines, indent)
        lines = [*wrap_statement(head + comment, indent), *lines]
        if len(s.otherwise) == 1 and isinstance(s.otherwise[0], When):
            first, *rest = self._when(s.otherwise[0], indent)
            return [*lines, f"{indent}}} else {first.lstrip()}", *rest]
        return [*lines, f"{indent}}} else {{", *self._block(s.otherwise, indent + _STEP), f"{indent}}}"]

    def _declaration(self, variable: Variable) -> str:
        return self._names.declaration(variable.name, variable.type, variable.shape)

    def _with_lengths(self, variable: Variable) -> str:
        return variable.name + self._names.lengths(variable.shape)


def _arranged(body: of.Statements) -> tuple[of.Statements, dict[int, Declare]]:
    """A block as C has it, and the declarations of variables that begin with a value, by the place of the statement.

    A last call whose status is returned, whatever it is, is returned at once.
    """
    call = _last_call(body)
    if call is not None:
        body = (*body[:-3], Return(call))
    single = [s for s in body if isinstance(s, Declare) and not s.variable.shape]
    if not single:
        return body, {}
    used = [used_variables((s,)) for s in body]
    gone, begun = set(), {}
    for s in single:
        first = next((other for other, known in zip(body, used, strict=True) if id(s.variable) in known), None)
        if first is None:  # the status of that call
            gone.add(id(s))
        elif _begins(first, s.variable):
            gone.add(id(s))
            begun[id(first)] = s
    kept = tuple(s for s in body if id(s) not in gone)
    return kept, {position: begun[id(s)] for position, s in enumerate(kept) if id(s) in begun}


def _last_call(body: of.Statements) -> Call | None:
    """The call of `status = f(..); if (status != OK) { return status; } return OK;` at the end of a block."""
    match body[-3:]:
        case Set(place, Call() as call), When(Compare(left=Place() as looked), (Return(Place() as value),), ()), last:
            same = looked.root is value.root is place.root
            return call if same and isinstance(last, Return) and _is_ok(last.value) else None
    return None


def _is_ok(value: Expr) -> bool:
    return isinstance(value, Status) and value.name == "OK"


def _begins(s: Statement, variable: Variable) -> bool:
    """Does a statement that uses a variable give it a value, made without it?"""
    match s:
        case Set(place, value, _, False) | Copy(place, value):
            whole = place.root is variable and not place.path
            return whole and not any(isinstance(e, Place) and e.root is variable for e in inside(value))
    return False
