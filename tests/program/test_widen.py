"""Many states side by side: the wide form of a function gives each state what the narrow one gives, bit for bit."""

from collections.abc import Callable, Iterable, Sequence
from typing import Any

import pytest

from mahovik.contract.status import STATUS_VALUES
from mahovik.core.program.build import Body, call
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Const, Not, Place, Select, Status, and_, equal, integer, real, unequal
from mahovik.core.program.function import Function
from mahovik.core.program.inline import Inliner
from mahovik.core.program.interpret import Interpreter
from mahovik.core.program.refusal import without_returns
from mahovik.core.program.statement import Do, Loop, Set
from mahovik.core.program.types import DOUBLE, FLOAT, Kind, NamedCount, Precision
from mahovik.core.program.validate import validate
from mahovik.core.program.wide import Wide
from mahovik.core.program.widen import RESERVED, Widener
from program.small import argument, function, program

COUNT = NamedCount("N", 9)


def status_function(name: str, arguments: Sequence[Argument], write: Callable[..., None]) -> Function:
    """A function that returns a status; `write(body, *places)` writes its body, but for the last return."""
    body = Body()
    write(body, *(a.place for a in arguments))
    body.ret(Status("OK"))
    return Function(name, f"{name}.", tuple(arguments), body.statements, returns=Kind.STATUS)


def within_function() -> Function:
    """RANGE where a value is above its limit, NOT_FINITE where it is no number."""

    def write(body: Body, values: Place, count: int, limit: Place) -> None:
        with body.loop("i", count) as i, body.when(Not(and_(values[i] >= -limit, values[i] <= limit))):
            with body.when(and_(values[i] >= real(-1e30), values[i] <= real(1e30))):
                body.ret(Status("RANGE"))
            body.ret(Status("NOT_FINITE"))

    arguments = [argument("values", shape=(0,)), argument("count", Kind.INT), argument("limit")]
    return status_function("within", arguments, write)


def kinked() -> Function:
    """y = x^2 below 1, else -x: a flat function with a condition that varies."""

    def write(body: Body, x: Place, y: Place) -> None:
        body.set(y, x * x)
        with body.when(x > real(1)):
            body.set(y, -x)

    return function("kinked", [argument("x"), argument("y", direction="out")], write, public=False)


def widened(narrow: Sequence[Function], varying: Sequence[str], precision: Precision = DOUBLE) -> tuple[Any, ...]:
    """Program of the wide form of the last of some functions, and its lanes."""
    wide = Wide(precision)
    inliner = Inliner(without_returns(tuple(narrow), precision), RESERVED)
    widener = Widener(wide, inliner.__getitem__)
    made = widener.function(inliner[narrow[-1].name], varying)
    found = program(*widener.functions, precision=precision)
    validate(found)
    return found, made, wide.lanes


def lanes(rows: Iterable[Iterable[Any]]) -> list[dict[str, list[Any]]]:
    """Rows of lanes as the wide argument of an array."""
    return [{"at": list(row)} for row in rows]


def run_wide(made: Any, function: Function, inputs: dict[str, Any], count: int) -> tuple[dict[str, Any], list[int]]:
    """Outputs by name, and the statuses of all lanes."""
    refused = {"at": [0] * count}
    _, out = Interpreter(made).run(function.name, {**inputs, "refused": refused})
    return out, [-code for code in out.pop("refused", refused)["at"]]


def summing() -> list[Function]:
    """out = sum of kinked(x[i]) times scale, after a check of x; RANGE where the sum is negative."""
    check, kink = within_function(), kinked()

    def write(body: Body, x: Place, scale: Place, flag: Place, out: Place) -> None:
        status = body.local("status", (), Kind.STATUS)
        body.set(status, call(check, x, COUNT, real(100)))
        with body.when(unequal(status, Status("OK"))):
            body.ret(status)
        total = body.local("total", (1,))
        body.set(total[0], real(0))
        with body.loop("i", COUNT) as i:
            y = body.local("y")
            body.call(kink, x[i], y)
            body.add(total[0], y * scale)
        with body.when(equal(flag, integer(1))):
            body.set(total[0], total[0] * real(3))
        with body.when(total[0] < 0):
            body.ret(Status("RANGE"))
        body.set(out[0], total[0])

    arguments = [argument("x", shape=(COUNT,)), argument("scale"), argument("flag", Kind.INT)]
    arguments.append(argument("out", shape=(1,), direction="out"))
    return [check, kink, status_function("summing", arguments, write)]


@pytest.mark.parametrize("precision", [DOUBLE, FLOAT])
@pytest.mark.parametrize("flag", [0, 1])
def test_each_lane_is_the_narrow_function(precision: Precision, flag: int) -> None:
    narrow = summing()
    made, wide, count = widened(narrow, ["x"], precision)
    rows = [[0.1 * (i + 1) + 0.07 * k for k in range(count)] for i in range(int(COUNT))]
    rows[2][1], rows[5][1], rows[3][4], rows[0][6] = float("nan"), 1e4, -1e4, 50.0
    out, statuses = run_wide(made, wide, {"x": lanes(rows), "scale": 0.5, "flag": flag}, count)
    alone = Interpreter(program(*narrow, precision=precision))
    for k in range(count):
        status, one = alone.run("summing", {"x": [row[k] for row in rows], "scale": 0.5, "flag": flag})
        assert statuses[k] == status
        if status == 0:
            assert precision.scalar(out["out"][0]["at"][k]).tobytes() == precision.scalar(one["out"][0]).tobytes()
    assert {STATUS_VALUES[name] for name in ("OK", "RANGE", "NOT_FINITE")} == set(statuses)


def test_the_loop_over_lanes_is_inside_and_small_functions_are_copied() -> None:
    _, wide, count = widened(summing(), ["x"])
    (loop,) = [s for s in wide.body if isinstance(s, Loop) and s.index.name == "i"]
    (inner,) = loop.body
    assert isinstance(inner, Loop)
    assert isinstance(inner.stop, Const)
    assert inner.stop.value is not None
    assert (inner.index.name, int(inner.stop.value)) == ("k", count)
    assert not [s for s in inner.body if isinstance(s, Do)]


def test_what_is_the_same_for_all_stays_narrow() -> None:
    _, wide, _ = widened(summing(), ["x"])
    types = {a.name: a.type for a in wide.arguments}
    assert types["scale"] is Kind.REAL
    assert types["flag"] is Kind.INT
    assert types["x"].name == "wide"
    assert types["refused"].name == "wide_word"


def test_a_call_under_a_condition_that_varies_is_refused() -> None:
    def arguments() -> list[Argument]:
        return [argument("x", shape=(COUNT,)), argument("y", shape=(COUNT,), direction="out")]

    def copy(body: Body, x: Place, y: Place) -> None:
        with body.loop("i", COUNT) as i:
            body.set(y[i], x[i])

    inner = function("inner", arguments(), copy, public=False)

    def write(body: Body, x: Place, y: Place) -> None:
        with body.when(x[0] > real(0)):
            body.call(inner, x, y)

    with pytest.raises(TypeError, match="outer: Do under a condition that varies"):
        widened([inner, function("outer", arguments(), write)], ["x"])


def test_a_status_must_be_returned_at_once() -> None:
    check = within_function()

    def write(body: Body, x: Place) -> None:
        status = body.local("status", (), Kind.STATUS)
        body.set(status, call(check, x, COUNT, real(1)))

    with pytest.raises(TypeError, match="the status of within is not returned at once"):
        without_returns((check, status_function("careless", [argument("x", shape=(COUNT,))], write)), DOUBLE)


def test_a_variable_that_both_branches_set_is_never_read_before_it_is_set() -> None:
    def write(body: Body, x: Place, y: Place) -> None:
        value = body.local("value")
        with body.when(x > real(0)):
            body.set(value, x * real(2))
        with body.otherwise():
            body.set(value, -x)
        body.set(y, value)

    made, wide, count = widened([function("f", [argument("x"), argument("y", direction="out")], write)], ["x"])
    numbers = [k - 3.5 for k in range(count)]
    _, out = Interpreter(made).run(wide.name, {"x": {"at": numbers}})
    assert list(out["y"]["at"]) == [2 * x if x > 0 else -x for x in numbers]
    (loop,) = wide.body
    first = next(s for s in loop.body if isinstance(s, Set))
    assert not isinstance(first.value, Select)


def test_what_is_read_again_is_stored_at_the_end_of_the_loop() -> None:
    """Two results for each turn: the second is made of the first, which stays a scalar until both are stored."""

    def write(body: Body, x: Place, one: Place, two: Place) -> None:
        with body.loop("i", COUNT) as i:
            body.set(one[i], x[i] * x[i])
            body.add(one[i], real(3))
            body.set(two[i], one[i] - x[i])

    results = [argument(name, shape=(COUNT,), direction="out") for name in ("one", "two")]
    narrow = function("twice", [argument("x", shape=(COUNT,)), *results], write, public=False)
    made, wide, count = widened([narrow], ["x"])
    (loop,) = wide.body
    assert isinstance(loop, Loop)
    (inner,) = loop.body
    assert isinstance(inner, Loop)
    assert [type(s).__name__ for s in inner.body] == ["Let", "Let", "Set", "Set"]
    rows = [[0.3 * i - 0.7 * k for k in range(count)] for i in range(int(COUNT))]
    _, out = Interpreter(made).run(wide.name, {"x": lanes(rows)})
    for i, row in enumerate(rows):
        assert out["one"][i]["at"] == [x * x + 3 for x in row]
        assert out["two"][i]["at"] == [x * x + 3 - x for x in row]
