"""Lines of states: what is read, every refusal of the contract, and the stream of answers."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from typing import Any

import numpy as np
import pytest

from mahovik.core.stand import State, load
from mahovik.core.stand.random import EXTREMES, extreme_state
from mahovik.errors import StateError
from mahovik.proof.verify.backends import NumpyBackend
from mahovik.proof.verify.states import Request, encode, evaluate_lines, read_line, state_line
from mahovik.stands import path

AUV = load(path("auv6"))
N = len(AUV.flywheels)


def read(real: str = "double", **keys: Any) -> Request:
    return read_line(AUV, json.dumps({"want": ["forward"], **keys}), real)


def refusal(line: str, real: str = "double") -> str:
    with pytest.raises(StateError) as caught:
        read_line(AUV, line, real)
    return str(caught.value)


def test_missing_inputs_are_zero_and_the_attitude_is_not_given() -> None:
    request = read()
    assert request.id is None
    assert request.want == ("forward",)
    assert request.state.phi == request.state.tau == (0.0,) * N
    assert request.state.V == request.state.V_dot == (0.0,) * 6
    assert request.state.angles is None
    assert request.state.quaternion is None
    assert dict(request.state.wrench) == {}


@pytest.mark.parametrize("kind", EXTREMES)
def test_a_state_reads_back_bit_for_bit(kind: str) -> None:
    rng = np.random.default_rng(3)
    for number in range(20):
        state = extreme_state(AUV, rng, kind)
        again = read_line(AUV, state_line(Request(number, state, ("matrices",))))
        assert again.id == number
        assert (again.state.V, again.state.phi, again.state.quaternion) == (state.V, state.phi, state.quaternion)
        assert again.state.angles == state.angles
        assert {k: v for k, v in again.state.wrench.items() if any(v)} == dict(state.wrench)


def test_a_quaternion_near_unit_length_is_normalised() -> None:
    request = read(quaternion=[1.0005, 0.0, 0.01, 0.0])
    assert request.state.quaternion is not None
    assert math.hypot(*request.state.quaternion) == pytest.approx(1.0, abs=4e-16)
    assert request.state.quaternion[2] == pytest.approx(0.01 / math.hypot(1.0005, 0.01), rel=1e-15)


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ({"phi_dott": [0] * N}, 'unknown key "phi_dott", did you mean "phi_dot"?'),
        ({"want": ["foward"]}, 'want: unknown "foward", did you mean "forward"?'),
        ({"want": []}, "want: empty"),
        ({"want": "forward"}, 'want: expected a list of names, found "forward"'),
        ({"want": [1]}, "want: expected names, found 1"),
        ({"want": ["forward", "coupled"]}, "both give V_dot"),
        ({"want": ["inverse", "momentum", "coupled"]}, "both give phi_ddot"),
        ({"wrench": {"w9": [0] * 6}}, 'wrench: unknown "w9", did you mean "w1"?'),
        ({"wrench": {"w1": [0] * 5}}, "wrench, w1: expected 6 numbers, found 5"),
        ({"wrench": [0] * 6}, "wrench: expected an object of bodies"),
        ({"phi": [0] * (N + 1)}, f"phi: expected {N} numbers, found {N + 1}"),
        ({"phi": 0}, f"phi: expected a list of {N} numbers, found 0"),
        ({"V": [0, 0, True, 0, 0, 0]}, "V[2]: expected a number, found true"),
        ({"V": [0, 0, "1", 0, 0, 0]}, 'V[2]: expected a number, found "1": states are in SI, without units'),
        ({"V": None}, "V: expected a list of 6 numbers, found null"),
        ({"V": [0, 0, [[[1]]], 0, 0, 0]}, "V[2]: expected a number, found [[[1]]]"),
        ({"position": [10**400, 0, 0]}, "is not finite as a double"),
        ({"quaternion": [1, 0, 0, 0.1]}, "quaternion: length 1.00498756, expected 1 within 0.001"),
        ({"quaternion": [0, 0, 0, 0]}, "quaternion: length 0, expected 1"),
        ({"quaternion": [1, 0, 0, 0], "angles": [0, 0, 0]}, "angles, quaternion: both given"),
        ({"quaternion": [1, 0, 0, 0], "want": ["generalized"]}, "`generalized` needs `angles`"),
    ],
)
def test_refusals(keys: dict[str, Any], words: str) -> None:
    assert words in refusal(json.dumps({"want": ["forward"], **keys}))


@pytest.mark.parametrize(
    ("key", "index", "limit"),
    [
        ("position", 2, 1e6),
        ("V", 0, 1e4),
        ("V", 5, 1e5),
        ("phi", 1, 1e7),
        ("phi_dot", 1, 1e5),
        ("phi_ddot", 1, 1e9),
        ("V_dot", 3, 1e9),
        ("tau", 1, 1e9),
        ("angles", 1, 1e7),
    ],
)
def test_ranges_end_at_their_limit(key: str, index: int, limit: float) -> None:
    count = {"position": 3, "angles": 3, "V": 6, "V_dot": 6}.get(key, N)
    for sign in (1, -1):
        numbers = [0.0] * count
        numbers[index] = sign * limit
        assert getattr(read("double", **{key: numbers}).state, key)[index] == sign * limit
        numbers[index] = sign * math.nextafter(limit, math.inf)
        assert f"{key}[{index}]: " in refusal(json.dumps({"want": ["forward"], key: numbers}))


@pytest.mark.parametrize("number", ["NaN", "Infinity", "-Infinity", "1e999"])
def test_numbers_that_are_not_finite(number: str) -> None:
    line = f'{{"want": ["forward"], "V": [0, 0, 0, 0, {number}, 0]}}'
    assert refusal(line).startswith("V[4]: ")
    assert refusal(line).endswith("is not finite")


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("{", "not JSON"),
        ("nope", "not JSON"),
        ("[1]", "expected an object, found [1]"),
        ("3", "expected an object, found 3"),
        ('{"want": ["forward"]} x', "not JSON"),
        ('{"want": ["forward"], "V": [0,0,0,0,0,0], "V": [1,0,0,0,0,0]}', 'key "V" appears twice'),
        (
            '{"want": ["forward"], "wrench": {"w1": [0,0,0,0,0,0], "w1": [0,0,0,0,0,0]}}',
            'wrench: key "w1" appears twice',
        ),
        ("[" * 100_000, "nested too deeply"),
        ('{"a":' * 100_000, "nested too deeply"),
        ('{"want": ["forward"], "V": [' + "9" * 5000 + ", 0, 0, 0, 0, 0]}", "V[0]"),
        ('{"id": NaN, "want": ["forward"]}', "id: cannot be repeated"),
    ],
)
def test_lines_that_are_no_states(line: str, words: str) -> None:
    assert words in refusal(line)


# ---- answers ----


class Answers:
    """A backend that gives what it was made with."""

    name = "answers"

    def __init__(self, **values: Any) -> None:
        self._values = values

    def evaluate(self, state: State, want: Sequence[str]) -> dict[str, Any]:
        return self._values


def answers(*lines: bytes) -> list[tuple[dict[str, Any], bool]]:
    parsed = list(evaluate_lines(AUV, NumpyBackend(AUV), [line + b"\n" for line in lines]))
    return [(json.loads(line, parse_constant=pytest.fail), good) for line, good in parsed]


def test_results_come_in_order_and_repeat_the_id() -> None:
    lines = answers(
        b'{"id": "b", "want": ["forward"]}',
        b"",
        b'{"id": {"n": [1, null]}, "want": ["frward"]}',
        b"   \t",
        b"nonsense",
        b'{"id": 7, "want": ["momentum", "torque"]}',
    )
    assert [line["id"] for line, _ in lines] == ["b", {"n": [1, None]}, None, 7]
    assert [good for _, good in lines] == [True, False, False, True]
    assert set(lines[0][0]) == {"id", "V_dot"}
    assert set(lines[1][0]) == set(lines[2][0]) == {"id", "error"}
    assert set(lines[3][0]) == {"id", "Z", "Z0", "energy", "center_of_mass", "center_of_mass_velocity", "tau"}


def test_a_byte_order_mark_carriage_returns_and_foreign_bytes() -> None:
    lines = answers(b'\xef\xbb\xbf{"id": 1, "want": ["forward"]}\r', b'{"id": "\xff", "want": ["forward"]}')
    assert lines[0][1]
    assert lines[1][0] == {"id": None, "error": "not UTF-8: byte 0xff"}


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
