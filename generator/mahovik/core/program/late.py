"""Stores at the end of a loop over lanes: a result that is read again stays a scalar until then.

A compiler may not move a load across a store that could meet it. With the stores of a long stretch at its end, numbers
of the table are operands of the vector operations that use them, and none waits in a register. Operations stay as
they are.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from mahovik.core.program.expression import Const, Expr, Place, Variable
from mahovik.core.program.statement import Let, Note, Set, Statement
from mahovik.core.program.walk import inside, own, rebuilt, with_own

Step = str | int
Key = tuple[Step, ...]
"""A place in words: its root's `id`, members, numbers of constant indices, and of others the `id` of a variable."""


def late(body: Sequence[Statement], lane: Variable, name: Callable[[str], str]) -> tuple[Statement, ...]:
    """The body of a loop over `lane` with stores of what it reads again at its end; `name`: makes a new name."""
    if not all(isinstance(s, Let | Set | Note) or not own(s) for s in body):
        return tuple(body)
    scalars = _scalars(body, lane)
    values: dict[Key, Variable] = {}

    def leaf(place: Place) -> Expr:
        value = values.get(_key(place) or ())
        return place if value is None else value.place

    found: list[Statement] = []
    for s in body:
        key = _key(s.place) if isinstance(s, Set) else None
        if isinstance(s, Set) and key in scalars:
            new = rebuilt(s.value, leaf)
            if s.add:
                new = values[key].place + new
            values[key] = Variable(name(_name(s.place)), s.place.kind)
            found.append(Let(values[key], new, s.comment))
        else:
            found.append(with_own(s, lambda e: rebuilt(e, leaf)))
    stores = (Set(place, values[key].place) for key, place in scalars.items() if key in values)
    return (*found, *stores)


def _scalars(body: Sequence[Statement], lane: Variable) -> dict[Key, Place]:
    """Elements of arrays of lanes that a body sets first and reads again, and that no other place may meet."""
    places: dict[Key, Place] = {}
    set_first: set[Key] = set()
    read_again: set[Key] = set()
    unclear: set[int] = set()  # roots of elements whose index is computed

    def key_of(place: Place) -> Key | None:
        key = _key(place) if lane in _indices(place) else None
        if key is not None:
            places.setdefault(key, place)
        elif lane in _indices(place):
            unclear.add(id(place.root))
        return key

    for s in body:
        target = s.place if isinstance(s, Set) else None
        for x in (x for e in own(s) for x in inside(e)):
            if isinstance(x, Place) and x is not target and (key := key_of(x)) is not None:
                read_again.add(key)
        if isinstance(s, Set) and (key := key_of(s.place)) is not None:
            if s.add:
                read_again.add(key)
            elif key not in read_again:
                set_first.add(key)
    return {
        key: place
        for key, place in places.items()
        if key in set_first
        and key in read_again
        and id(place.root) not in unclear
        and not any(_may_meet(key, other) for other in places)
    }


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
