"""Stores at the end of a loop over lanes: a result that is read again stays a scalar until then.

A compiler may not move a load across a store that could meet it. With the stores of a long stretch at its end, numbers
of the table are operands of the vector operations that use them, and none waits in a register. Operations stay as
they are.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace

from mahovik.core.program.expression import Const, Expr, Place, Variable
from mahovik.core.program.rewrite import rebuilt
from mahovik.core.program.statement import Let, Note, Set, Statement
from mahovik.core.program.walk import inside, own

Step = str | int
Key = tuple[Step, ...]
"""A place in words: its root's `id`, members, numbers of constant indices, and of others the `id` of a variable."""


@dataclass(eq=False)
class _Element:
    """An element of an array: whether it is set before it is read, and its value on the way."""

    place: Place
    set_first: bool = False
    read_again: bool = False
    value: Variable | None = None


@dataclass(eq=False)
class _Elements:
    """The elements that a loop's body uses."""

    elements: dict[Key, _Element] = field(default_factory=dict)
    unclear: set[int] = field(default_factory=set)

    def element(self, place: Place) -> _Element | None:
        """An element whose index is clear."""
        key = _key(place)
        if key is None:
            self.unclear.add(id(place.root))
            return None
        return self.elements.setdefault(key, _Element(place))

    def scalars(self) -> dict[Key, _Element]:
        """Elements that are set first and read again, and that no other place may meet."""
        return {
            key: one
            for key, one in self.elements.items()
            if one.set_first
            and one.read_again
            and id(one.place.root) not in self.unclear
            and not any(_may_meet(key, other) for other in self.elements)
        }


def late(body: Sequence[Statement], lane: Variable, name: Callable[[str], str]) -> tuple[Statement, ...]:
    """The body of a loop over `lane` with stores of what it reads again at its end; `name`: makes a new name."""
    if not all(isinstance(s, Let | Set | Note) or not own(s) for s in body):
        return tuple(body)
    found = _elements(body, lane).scalars()
    return (
        *_scalars(body, found, name),
        *(Set(e.place, e.value.place) for e in found.values() if e.value is not None),
    )


def _elements(body: Sequence[Statement], lane: Variable) -> _Elements:
    """Elements of arrays of lanes that a body uses, in its order."""
    known = _Elements()
    for s in body:
        target = s.place if isinstance(s, Set) else None
        for place in _places(s, target):
            if lane in _indices(place):
                found = known.element(place)
                if found is not None:
                    found.read_again = True
        if target is not None and lane in _indices(target):
            found = known.element(target)
            if found is not None:
                assert isinstance(s, Set)
                found.set_first |= not found.read_again and not s.add
                found.read_again |= s.add
    return known


def _places(s: Statement, target: Place | None) -> Iterator[Place]:
    """Places that a statement reads, or has as an index."""
    for e in own(s):
        for x in inside(e):
            if isinstance(x, Place) and x is not target:
                yield x


def _scalars(body: Sequence[Statement], found: dict[Key, _Element], name: Callable[[str], str]) -> Iterator[Statement]:
    """The statements with scalars in place of such elements."""

    def leaf(place: Place) -> Expr:
        element = found.get(_key(place) or ())
        return place if element is None or element.value is None else element.value.place

    for s in body:
        match s:
            case Let(_, value):
                yield replace(s, value=rebuilt(value, leaf))
            case Set(place, value):
                new = rebuilt(value, leaf)
                element = found.get(_key(place) or ())
                if element is None:
                    yield replace(s, value=new)
                    continue
                if s.add:
                    assert element.value is not None
                    new = element.value.place + new
                element.value = Variable(name(_name(place)), place.kind)
                yield Let(element.value, new, s.comment)
            case _:
                yield s


def _indices(place: Place) -> list[Variable]:
    """Variables that index a place."""
    return [step.root for step in place.path if isinstance(step, Place)]


def _key(place: Place) -> Key | None:
    """A place in words; None where an index is computed."""
    steps: list[Step] = [id(place.root)]
    for step in place.path:
        match step:
            case str():
                steps.append(step)
            case Const() if not step.name:
                steps.append(int(step.value))
            case Place(root=root, path=()):
                steps.append(f"[{id(root)}]")
            case _:
                return None
    return tuple(steps)


def _may_meet(one: Key, other: Key) -> bool:
    """Can two different places be the same number? Not where a member or a constant index differs."""
    if one == other or one[0] != other[0]:
        return False
    return not any(a != b and _is_fixed(a) and _is_fixed(b) for a, b in zip(one, other, strict=False))


def _is_fixed(step: Step) -> bool:
    return isinstance(step, int) or not step.startswith("[")


def _name(place: Place) -> str:
    """A name for the value of one lane."""
    steps = (str(int(step.value)) if isinstance(step, Const) else step for step in place.path)
    return "_".join(("lane", place.root.name, *(step for step in steps if isinstance(step, str) and step != "at")))
