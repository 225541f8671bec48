"""Dead locals and calls go, what lives stays."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator, Sequence

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Expr, Place, select
from mahovik.core.program.function import Function
from mahovik.core.program.interpret import Interpreter
from mahovik.core.program.prune import prune
from mahovik.core.program.statement import Declare, Let, Loop, Statement, When
from mahovik.core.program.types import Kind
from mahovik.core.program.validate import validate
from program.small import argument, function, program

R, I = Kind.REAL, Kind.INT


def names(body: Sequence[Statement]) -> Iterator[str]:
    """Names of the locals of a body, in order."""
    for s in body:
        match s:
            case Let(variable) | Declare(variable):
                yield variable.name
            case Loop() | When():
                yield from names(s.body)
                yield from names(getattr(s, "otherwise", ()))


def cut(write: Callable[..., None], arguments: Sequence[Argument] | None = None, public: bool = True) -> Function:
    """A pruned function of (x, out[2]), or of other arguments."""
    arguments = arguments or (argument("x"), argument("out", R, (2,), "out"))
    return prune(function("f", arguments, write, public=public))


FILL = function("fill", [argument("x"), argument("a", R, (2,), "out")], lambda body, x, a: body.set(a[0], x))


class Writer:
    """Writes random function bodies with much that is dead."""

    def __init__(self, seed: int) -> None:
        self.rng = random.Random(seed)
        self.count = 0

    def write(self, body: Body, x: Place, out: Place) -> None:
        """The body of f(x[3], out[4])."""
        self.out = out
        self._block(body, [*x], [], 2)
        body.set(out[3], x[0])

    def _block(self, body: Body, readable: list[Place], arrays: list[Place], depth: int) -> None:
        readable, arrays = list(readable), list(arrays)
        for _ in range(self.rng.randint(2, 6)):
            self.count += 1
            pick = self.rng.random()
            if pick < 0.25:
                readable.append(body.let(f"v{self.count}", self._tree(readable)))
            elif pick < 0.4:
                new = body.local(f"a{self.count}", (2,))
                body.set(new[0], self._tree(readable))
                body.set(new[1], self._tree(readable))
                arrays.append(new)
                readable += [*new] if self.rng.random() < 0.5 else []
            elif pick < 0.55 and arrays:
                body.call(FILL, self._tree(readable), self.rng.choice(arrays))
            elif pick < 0.65 and arrays:
                body.add(self.rng.choice(arrays)[self.rng.randrange(2)], self._tree(readable))
            elif pick < 0.75:
                body.set(self.out[self.rng.randrange(3)], self._tree(readable))
            elif pick < 0.85 and depth:
                with body.loop(f"i{self.count}", 2) as i:
                    inner = [*readable, *(a[i] for a in arrays if any(p.root is a.root for p in readable))]
                    self._block(body, inner, arrays, depth - 1)
            elif depth:
                with body.when(self._tree(readable) < 0):
                    self._block(body, readable, arrays, depth - 1)
                with body.otherwise():
                    self._block(body, readable, arrays, depth - 1)

    def _tree(self, readable: list[Place]) -> Expr:
        a, b, c = (self.rng.choice(readable) for _ in range(3))
        return self.rng.choice([a + b * c, a - b, select(a < b, b, c), -a])


@given(st.integers(0, 2**32 - 1))
def test_pruning_changes_no_bit(seed: int) -> None:
    writer = Writer(seed)
    full = function("f", [argument("x", R, (3,)), argument("out", R, (4,), "out")], writer.write)
    short = prune(full)
    validate(program(FILL, short))
    assert prune(short).body == short.body
    x = np.random.default_rng(seed).normal(size=3)
    results = [Interpreter(program(FILL, f)).run("f", {"x": x}) for f in (full, short)]
    assert results[0] == results[1]
    assert all(np.isfinite(results[0][1]["out"]))


@pytest.mark.parametrize("added", [False, True])
def test_a_dead_variable_that_a_living_call_writes_is_kept(added: bool) -> None:
    """The call needs somewhere to write its other result."""
    both = function(
        "both",
        [argument("x"), argument("p", R, (), "out"), argument("q", R, (), "out")],
        lambda body, x, p, q: (body.set(p, x), body.set(q, x)),
    )

    def write(body: Body, x: Place, out: Place) -> None:
        p, q = body.local("p"), body.local("q")
        body.call(both, x, p, q)
        if added:
            body.add(q, x)
        body.set(out[0], p)

    found = cut(write)
    validate(program(both, found))
    assert list(names(found.body)) == ["p", "q"]
