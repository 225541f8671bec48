"""The stream of `eval`: order, ids, error lines, strict JSON."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Any

import numpy as np
import pytest

from mahovik.contract.functions import wants_of_carrier
from mahovik.core.stand import State, load, rest_state
from mahovik.proof import reference
from mahovik.proof.verify.backends import NumpyBackend
from mahovik.proof.verify.json_text import encode
from mahovik.proof.verify.states import evaluate_lines
from mahovik.stands import path

AUV = load(path("auv6"))


class Answers:
    """A backend that gives what it was made with."""

    name = "answers"

    def __init__(self, **values: Any) -> None:
        self._values = values

    def evaluate(self, state: State, want: Sequence[str]) -> dict[str, Any]:
        return self._values


def run(*lines: bytes) -> list[tuple[dict[str, Any], bool]]:
    found = list(evaluate_lines(AUV, NumpyBackend(AUV), [line + b"\n" for line in lines]))
    return [(json.loads(line, parse_constant=pytest.fail), good) for line, good in found]


def test_results_come_in_order_and_repeat_the_id() -> None:
    found = run(
        b'{"id": "b", "want": ["forward"]}',
        b"",
        b'{"id": {"n": [1, null]}, "want": ["frward"]}',
        b"   \t",
        b"nonsense",
        b'{"id": 7, "want": ["momentum", "torque"]}',
    )
    assert [line["id"] for line, _ in found] == ["b", {"n": [1, None]}, None, 7]
    assert [good for _, good in found] == [True, False, False, True]
    assert set(found[0][0]) == {"id", "V_dot"}
    assert set(found[1][0]) == set(found[2][0]) == {"id", "error"}
    assert set(found[3][0]) == {"id", "Z", "Z0", "energy", "center_of_mass", "tau"}


def test_a_byte_order_mark_carriage_returns_and_foreign_bytes() -> None:
    found = run(b'\xef\xbb\xbf{"id": 1, "want": ["forward"]}\r', b'{"id": "\xff", "want": ["forward"]}')
    assert found[0][1]
    assert found[1][0] == {"id": None, "error": "not UTF-8: byte 0xff"}


def test_every_want_is_strict_json_with_the_bits_of_the_reference() -> None:
    state = rest_state(AUV)
    for want in wants_of_carrier(held=False):
        ((line, good),) = run(json.dumps({"id": want, "want": [want]}).encode())
        assert good
        expected = reference.evaluate(AUV, state, [want])
        assert set(line) == {"id", *expected}
        for name, value in expected.items():
            if name != "points":
                assert np.array_equal(line[name], value)


def test_floats_have_17_digits_and_stay_floats() -> None:
    assert encode(0.1) == "0.10000000000000001"
    assert [encode(x) for x in (1.0, -0.0, 1e22, 5e-324)] == ["1.0", "-0.0", "1e+22", "4.9406564584124654e-324"]
    rng = np.random.default_rng(2)
    for x in rng.normal(size=200) * 10.0 ** rng.integers(-300, 300, 200):
        assert float(encode(x)) == x
    assert encode({"rank": 6, "status": "OK", "a": np.zeros((2, 1))}) == (
        '{"rank": 6, "status": "OK", "a": [[0.0], [0.0]]}'
    )


@pytest.mark.parametrize("bad", [float("nan"), float("inf"), np.array([0.0, np.inf])])
def test_a_result_that_is_not_finite_is_an_error_line(bad: Any) -> None:
    ((line, good),) = evaluate_lines(AUV, Answers(V_dot=bad), [b'{"id": 1, "want": ["forward"]}'])
    assert not good
    assert json.loads(line) == {"id": 1, "error": "V_dot: not finite at this state"}


def test_an_id_nested_deep_is_repeated_or_refused_but_never_a_crash() -> None:
    for depth in (10, 300, 900, 50_000):
        given = b"[" * depth + b"]" * depth
        ((line, _),) = evaluate_lines(AUV, Answers(energy=1.0), [b'{"id": ' + given + b', "want": ["momentum"]}'])
        assert line.startswith('{"id": [') or '"error"' in line
