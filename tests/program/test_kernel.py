"""Kernels: what their text becomes in the program, and what it may not hold."""

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mahovik import stands
from mahovik.contract.status import STATUS_VALUES
from mahovik.core.lower.layout import Layout
from mahovik.core.lower.program import lower_layout
from mahovik.core.program.expression import Binary, Place, Status
from mahovik.core.program.function import Function
from mahovik.core.program.interpret import Interpreter
from mahovik.core.program.kernel import RANGE, KernelError, Reals, Result, argument, inline, ints, kernel, let, reals
from mahovik.core.program.statement import Declare, Let, Loop, Note, Set
from mahovik.core.program.types import DOUBLE, Field, Kind, NamedCount, Struct
from mahovik.core.program.vector import Vector, cross, dot
from mahovik.core.stand import load, structure
from program.small import program

N = NamedCount("N", 3)
PAIR = Struct("pair", "two numbers", (Field("left", Kind.REAL), Field("right", Kind.REAL)))
numbers = st.lists(st.floats(-1e6, 1e6), min_size=3, max_size=3)


@inline
def larger(a: float, b: float) -> float:
    """The larger of two."""
    return a if a > b else b


@inline
def count(reached: Result, by: int) -> None:
    """Raises a variable of the caller."""
    reached.value = reached.value + by


@kernel()
def largest(a: Reals = argument("numbers", N), most: Result = argument(direction="out")) -> None:
    """The largest magnitude."""
    # from the first
    best: float = 0.0  # so far
    for i in range(N):
        best = larger(best, abs(a[i]))
    most.value = best


@kernel("sorted", statuses=("OK", "RANGE"), public=True)
def in_order(a: Reals = argument("numbers", N, unit="m"), rank: Reals = argument("", N, direction="out")) -> Status:
    """How many numbers are smaller than each.

    Refuses numbers beyond 1e5.
    """
    smaller = ints(N)
    for i in range(N):
        if not (a[i] <= 1e5 and a[i] >= -1e5):
            return RANGE
        smaller[i] = 0
        for j in range(N):
            smaller[i] += 1 if a[j] < a[i] or (j < i and j != i and not a[i] < a[j]) else 0
        doubled: int = 0
        count(doubled, smaller[i])
        rank[i] = float(doubled)
    return Status("OK")


@kernel()
def weighted(pair: Any = argument(struct=PAIR), a: Reals = argument("", N)) -> float:
    """Repeats what stands in a Python loop, takes the branch that Python knows, calls a function."""
    most = reals()
    largest(a, most)
    for k in (0, 1, 2):
        let(f"part{k}", a[k] * pair.left)
    total: float = 0.0
    for value in a:
        if int(N) == 3:
            total += value * pair.left
        else:
            total -= value
    total -= pair.right
    return total / (1 + most) if most > 0 else total


@kernel()
def moved(
    C: Reals = argument("", 9), J: Reals = argument("", 6), V: Reals = argument("", 6), K: Reals = argument("", 6, 6),
    absent: Any = None, out: Reals = argument("", 6, direction="out"), last: Reals = argument("", 3, direction="out"),
) -> Status:  # fmt: skip
    """A call that is checked, vectors, and what is not there."""
    v, omega = V[0:3], V[3:6]
    copied: Reals = v
    in_order(copied, last)
    if absent is not None:
        return RANGE
    turned: Reals = C.T @ v  # in E1
    rate = v + cross(omega, turned)
    out[0:3] = J @ omega - rate
    out[3:6] = C.square @ C.T @ omega - Vector([1, 0, 0]) * omega[0]
    out[3:6] += K[0:3, 1]
    last -= Vector([0, 1, 0])
    let("total", dot(V, V))
    return Status("OK")


def run(function: Function, **inputs: Any) -> tuple[Any, dict[str, Any]]:
    return Interpreter(program(largest, in_order, weighted, moved, structs=(PAIR,))).run(function.name, inputs)


@given(numbers)
def test_a_kernel_computes_what_its_text_says(a: list[float]) -> None:
    assert run(largest, a=a)[1] == {"most": max(map(abs, a))}
    status, results = run(in_order, a=a)
    rank = results["rank"]
    if max(map(abs, a)) > 1e5:
        assert status == STATUS_VALUES["RANGE"]
    else:
        assert sorted(rank) == [0, 1, 2] and np.all(np.diff(np.array(a)[np.argsort(rank)]) >= 0)
    total = 2 * a[0] + 2 * a[1] + 2 * a[2] - 1
    value, _ = run(weighted, pair={"left": 2.0, "right": 1.0}, a=a)
    assert value == (total / (1 + max(map(abs, a))) if any(a) else total)


@given(st.lists(numbers, min_size=19, max_size=19))
def test_vectors_are_computed_element_by_element(drawn: list[list[float]]) -> None:
    flat = np.array(drawn).ravel() * 1e-3
    C, J, V, K = flat[:9], flat[9:15], flat[15:21], flat[21:57]
    status, results = run(moved, C=C, J=J, V=V, K=K.reshape(6, 6))
    assert status == STATUS_VALUES["OK"]
    v, omega, A, S = V[:3], V[3:], C.reshape(3, 3), J[[0, 3, 4, 3, 1, 5, 4, 5, 2]].reshape(3, 3)
    rate = v + np.cross(omega, A.T @ v)
    first = A @ A.T @ omega - [omega[0], 0, 0] + K.reshape(6, 6)[:3, 1]
    np.testing.assert_allclose(results["out"], [*(S @ omega - rate), *first], rtol=1e-10, atol=1e-3)
    assert list(np.add(results["last"], [0, 1, 0])) == list(np.argsort(np.argsort(v, kind="stable")))


def test_sums_of_vectors_begin_with_what_is_added_and_leave_out_zeros() -> None:
    names = [s.variable.name for s in moved.body if isinstance(s, Let)]
    assert names == ["rate1", "rate2", "rate3", "total"] and [a.name for a in moved.arguments][-2:] == ["out", "last"]
    sets = [s for s in moved.body if isinstance(s, Set)]
    assert len(sets) == 3 + 1 + 3 + 3 + 3 + 3 + 1  # one of `last`
    rate = next(s.value for s in moved.body if isinstance(s, Let))
    assert isinstance(rate, Binary) and rate.operator == "-" and isinstance(rate.left, Binary)  # (v + a b) - c d
    assert rate.left.operator == "+" and isinstance(rate.left.left, Place)
    with pytest.raises(TypeError, match="7 numbers are no square matrix"):
        _ = Vector([0] * 7).square


def test_comments_names_and_contract_go_into_the_program() -> None:
    note, best, first, loop, result = largest.body
    assert isinstance(note, Note) and note.text == "from the first"
    assert isinstance(best, Declare) and best.comment == "so far" and best.variable.name == "best"
    assert isinstance(first, Set) and isinstance(loop, Loop) and isinstance(result, Set)
    assert in_order.name == "sorted" and in_order.purpose == "How many numbers are smaller than each."
    assert in_order.notes == ("Refuses numbers beyond 1e5.",) and in_order.statuses == ("OK", "RANGE")
    assert in_order.public and in_order.arguments[0].unit == "m" and in_order.arguments[1].direction == "out"
    names = [s.variable.name for s in weighted.body if isinstance(s, Let)]
    assert names == ["part0", "part1", "part2"] and sum(isinstance(s, Set) for s in weighted.body) == 5


def unknown_statement(a: float = argument()) -> float:
    """A loop that may not end."""
    while a > 0:
        pass
    return a


def name_of_another_block(a: float = argument()) -> float:
    """A name that ends with its block."""
    if a > 0:
        b = 2 * a
    return b


def kinds_that_differ(a: float = argument(), n: int = argument()) -> float:
    """A real and an int."""
    return a + n


def second_value(a: float = argument()) -> float:
    """A name that is not declared to change."""
    b = 2 * a
    b = b * b
    return b + 1


def no_argument(a: float = 1.0) -> float:
    """A number as the default value."""
    return a


def nothing(a: float = argument()) -> None:
    """A value of a function that returns none."""
    return 5  # type: ignore[return-value]


def another_kind(a: float = argument()) -> float:
    """An int for a real."""
    n: int = 1
    return n


def number_as_branch(a: float = argument()) -> float:
    """A real where a truth value belongs."""
    return 1.0 if a else 0.0


def number_as_operand(a: float = argument()) -> float:
    """Reals where truth values belong."""
    if a > 0 and not a:
        return 1.0
    return 0.0


def text_added(a: float = argument()) -> float:
    """A text where a number belongs."""
    b: float = a
    b += "a"  # type: ignore[operator]
    return b


def printed(a: float = argument()) -> float:
    """A function of Python that acts while the text is compiled."""
    print(a)
    return a


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (nothing, "the signature says that it returns None"),
        (another_kind, "the signature says that it returns float"),
        (number_as_branch, "a condition is a comparison, not a number"),
        (number_as_operand, "a condition is a comparison, not a number"),
        (text_added, "'a' is no real"),
        (printed, "name 'print' is not defined"),
        (unknown_statement, "no statement of a kernel: while a > 0:"),
        (name_of_another_block, "return b: name 'b' is not defined"),
        (kinds_that_differ, "return a \\+ n: kinds differ: real and int"),
        (second_value, "b has a value already: what changes is declared"),
        (no_argument, "a: expected argument\\(...\\)"),
    ],
)
def test_a_wrong_text_is_an_error_with_its_line(text: Callable[..., Any], message: str) -> None:
    with pytest.raises(KernelError, match=f"test_kernel.py:[0-9]+: .*{message}"):
        kernel()(text)


def test_an_inline_kernel_is_no_function_of_python() -> None:
    with pytest.raises(TypeError, match="in the text of a kernel"):
        larger(1.0, 2.0)


def test_threads_compile_kernels_side_by_side() -> None:
    """Each into its own function: two stands lowered at once are those lowered one after the other."""
    layouts = [Layout(structure(load(stands.path(name))), DOUBLE) for name in ("demo3", "shaker2")]

    def texts(layout: Layout) -> list[str]:
        return [repr(statement) for function in lower_layout(layout).functions for statement in function.body]

    alone = [len(texts(layout)) for layout in layouts]
    with ThreadPoolExecutor(4) as pool:
        assert list(map(len, pool.map(texts, layouts * 4))) == alone * 4
