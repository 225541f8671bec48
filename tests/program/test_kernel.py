"""Kernels: what their text becomes in the program, and what it may not hold."""

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any, cast

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


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("while x > 0:\n        pass", "no statement of a kernel: while x > 0:"),
        ("if x > 0:\n        y = 2 * x\n    return y", "return y: .* name 'y' is not defined"),
        ("return x ** 2", "no kernel computes this, .*: unsupported operand"),
        ("print(x)", "name 'print' is not defined"),
        ("return abs(x=x)", "_abs\\(\\) got an unexpected keyword argument"),
        ("return x + 1e400", "inf is no number that real holds"),
        ("return x + n", "kinds differ: int found, real expected"),
        ("y: float = x\n    y += 'a'", "'a' is no real"),
        ("y = 2 * x\n    y = y * y", "y has a value already: what changes is declared"),
        ("y: str = x", "y: str found, expected float or int or Status"),
        ("y: float = a", "y: float found, expected Reals or Ints"),
        ("y: int = x", "kinds differ: real found, int expected"),
        ("a[0] = 1.0", "is an input, a temporary or an index: expected a result or a declared local"),
        ("n += 1", "is an input, a temporary or an index"),
        ("y = 2 * x\n    y += 1.0", "is an input, a temporary or an index"),
        ("return a[2]", "a\\[2\\] is outside 0..1"),
        ("y: Reals = a + Vector([x, x, x])", "lengths differ: 2 and 3 elements"),
        ("y = cross(a, a)", "a\\[2\\] is outside 0..1"),
        ("y = (a + a)[2]", "2 numbers have no number \\[2\\]"),
        ("if a + a:\n        return 1.0", "a condition is a comparison, not a vector"),
        ("return 1.0 if x else 0.0", "a condition is a comparison, not a number"),
        ("return 1.0 if x > 0 and not x else 0.0", "a condition is a comparison, not a number"),
        ("return x and 1", "a condition is a comparison, not a number"),
        ("return x or 2.0", "a condition is a comparison, not a number"),
        ("return 1.0 if x > 0 and 1 else 0.0", "a condition is a comparison, not a number"),
        ("y = x > 0 or a[0:1]", "a condition is a comparison, not a number"),
        ("cross\n    return x", "cross: nothing takes this value, expected a call"),
        ("x + 1\n    return x", "x \\+ 1: nothing takes this value, expected a call"),
        ("'words'\n    return x", "'words': nothing takes this value, expected a call"),
        ("y: Reals = a[0:3]", "a slice to 3 of 2 elements: expected at most 2"),
        ("return a[-3:][0]", "a slice to -3 of 2 elements: expected at most 2"),
        ("return (a + a)[1:9][0]", "a slice to 9 of 2 elements: expected at most 2"),
        ("return Vector([x, x, x, x]).square[0:5][0][0]", "a slice to 5 of 2 elements: expected at most 2"),
        ("double = x * 2", "double is a word of C, expected another name"),
        ("float_: float = x", "float is a word of C, expected another name"),
        ("for register in range(n):\n        pass", "register is a word of C, expected another name"),
        ("NULL = x * 2", "NULL is a word of C, expected another name"),
        ("return 1.0 if 0 < x < 1 else 0.0", "a chain of comparisons"),
        ("return 1.0 if n in (1, 2) else 0.0", "is known when the program runs"),
        ("return 1.0 if a + a == a - a else 0.0", "is known when the program runs"),
        ("return (y := x)", "expected a statement of its own"),
        ("for i in range(x):\n        pass", "kinds differ: real found, int expected"),
        ("for i in range(0, 3, 2):\n        pass", "a loop counts by 1"),
        ("return a", "a is an array, expected a number"),
        ("return n", "kinds differ: int found, real expected"),
        ("y = x", "returns nothing, expected float"),
        ("if x > 0:\n        return 1.0", "returns nothing, expected float"),
        ("return x\n    y = x", "y = x: no state comes here"),
        ("if x > 0:\n        return x\n    else:\n        return x\n    y = 2 * x", "y = 2 \\* x: no state comes here"),
    ],
)
def test_a_wrong_text_is_an_error_with_its_line(text: str, message: str, tmp_path: Path) -> None:
    signature = 'a: Reals = argument("", 2), x: float = argument(), n: int = argument()'
    refuses(tmp_path, f'def wrong({signature}) -> float:\n    """Wrong."""\n    {text}\n', message)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("def wrong(x: float = 1.0) -> float:", "x: expected argument\\(...\\)"),
        ("def wrong(x: float = argument(), double: float = argument()) -> float:", "double is a word of C, expected"),
        ("def wrong(x: str = argument()) -> float:", "x: str found, expected one of float, int"),
        ("def wrong(x: float = argument()) -> str:", "what it returns: str found, expected one of None, float"),
        ("def wrong(x: float = argument()) -> float:\n    pass", "expected a docstring"),
        ("def wrong(x: float = argument()) -> None:", "says that it returns None, expected no return"),
    ],
)
def test_a_wrong_signature_is_an_error_with_its_line(text: str, message: str, tmp_path: Path) -> None:
    refuses(tmp_path, f'{text}\n    """Wrong."""\n    return x\n', message)


def refuses(folder: Path, text: str, message: str) -> None:
    """Expects the error of a kernel in a file of its own."""
    file = folder / "wrong.py"
    file.write_text(text, encoding="utf-8")
    scope = {"Reals": Reals, "argument": argument, "cross": cross, "Vector": Vector}
    exec(compile(text, str(file), "exec"), scope)
    with pytest.raises(KernelError, match=f"wrong.py:[0-9]+: .*{message}"):
        kernel()(cast(Callable[..., Any], scope["wrong"]))


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
