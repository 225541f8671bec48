"""Lines of `eval`, a start of `simulate`, a program's answers to `verify --with`: any JSON, and what is none."""

from __future__ import annotations

import io
import json
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fuzz.mangle import spoiled_bytes, spoiled_json
from fuzz.reading import READERS, fuzzed, read_or_refuse, soon
from mahovik.core.stand import load
from mahovik.core.stand.state import rest_state
from mahovik.proof.verify.backends import Backend, NumpyBackend
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.foreign import read_results
from mahovik.proof.verify.states import Request, evaluate_lines
from mahovik.stands import path
from mahovik.use.simulate.case import load_start

pytestmark = READERS

AUV6 = load(path("auv6"))
N = len(AUV6.flywheels)
STATES: list[dict[str, Any]] = [
    {"id": 7, "V": [1, 2, 3, 0.1, 0.2, 0.3], "phi": [0.5] * N, "phi_dot": [100.0] * N, "want": ["forward", "torque"]},
    {"id": "a", "angles": [0.1, 0.2, 0.3], "phi_ddot": [1.0] * N, "want": ["generalized", "measure", "inverse"]},
    {"quaternion": [1, 0, 0, 0], "tau": [0.01] * N, "want": ["coupled"]},
    {"id": None, "position": [1, 2, 3], "wrench": {"carrier": [1, 2, 3, 4, 5, 6]}, "want": ["wrench", "momentum"]},
    {"id": [1, {"a": 2}], "V_dot": [1, 2, 3, 4, 5, 6], "phi_dot": [1e5] * N, "want": ["mounts", "matrices", "forward"]},
]
LINES = st.one_of(
    spoiled_json(STATES).map(lambda text: text.encode("utf-8", "surrogatepass")),
    spoiled_bytes([json.dumps(state).encode() for state in STATES]),
)


@pytest.fixture(scope="module", params=["c", "numpy"])
def backend(request: pytest.FixtureRequest) -> Backend:
    return CBackend(AUV6) if request.param == "c" else NumpyBackend(AUV6)


def strict(line: str) -> Any:
    """Strict JSON has no NaN."""

    def constant(name: str) -> None:
        raise AssertionError(f"{name} in {line[:200]}")

    return json.loads(line, parse_constant=constant)


@fuzzed(150)
@given(data=st.lists(LINES, min_size=1, max_size=3).map(b"\n".join))
def test_eval_answers_each_line(data: bytes, backend: Backend) -> None:
    lines = [line for line in io.BytesIO(data) if line.strip()]
    with soon(60):
        answers = list(evaluate_lines(AUV6, backend, iter(lines)))
    blank = sum(not line.removeprefix(b"\xef\xbb\xbf").strip() for line in lines[:1])
    assert len(answers) == len(lines) - blank
    for answer, good in answers:
        assert "\n" not in answer
        found = strict(answer)
        assert good == ("error" not in found)
        assert next(iter(found)) == "id"


@pytest.mark.parametrize("reader", ["start of simulate", "answers of a program"])
@fuzzed(100)
@given(data=LINES)
def test_readers_of_states(reader: str, data: bytes, tmp_path_factory: pytest.TempPathFactory) -> None:
    if reader == "start of simulate":
        file = tmp_path_factory.getbasetemp() / "start.json"
        file.write_bytes(data)
        read_or_refuse(lambda: load_start(file, AUV6))
    else:
        read_or_refuse(lambda: read_results([data], [Request(7, rest_state(AUV6), ("forward",))]))
