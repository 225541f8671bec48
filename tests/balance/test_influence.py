"""Properties of corrections, corrections that can be made, and refused input."""

from __future__ import annotations

import itertools
import json
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import mahovik
from cli.run import run
from mahovik.errors import BalanceError
from mahovik.use.balance.polar import read_polar, write_polar

RUNS = {"A": ["170@112", "53@78"], "B": [["235@94", "185@115"], ["58@68", "77@104"]], "U": ["1.15@0", "1.15@0"]}


def text(value: complex) -> str:
    return f"{abs(value)!r}@{float(np.degrees(np.angle(value)))!r}"


def case(seed: int, M: int, N: int) -> dict[str, object]:
    rng = np.random.default_rng(seed)
    alpha = rng.normal(size=(M, N)) + 1j * rng.normal(size=(M, N))
    A = rng.normal(size=M) + 1j * rng.normal(size=M)
    return {"A": [text(x) for x in A.tolist()], "ALPHA": [[text(x) for x in row] for row in alpha.tolist()]}


@settings(max_examples=15, deadline=None)
@given(st.integers(0, 10**6), st.integers(1, 4), st.integers(0, 4))
def test_least_squares_is_orthogonal_and_min_max_is_not_beaten(seed: int, N: int, more: int) -> None:
    given_case = case(seed, N + more, N)
    least, best = (mahovik.balance(given_case, method=each) for each in ("least-squares", "min-max"))
    assert np.abs(least.problem.alpha.conj().T @ least.residual).max() < 1e-9
    assert np.abs(best.residual).max() <= np.abs(least.residual).max() + 1e-7
    rng = np.random.default_rng(seed)
    for size in (1e-3, 1e-2, 0.1):
        near = best.w + size * (rng.normal(size=(50, N)) + 1j * rng.normal(size=(50, N)))
        others = np.abs(best.problem.A + near @ best.problem.alpha.T).max(axis=1)
        assert best.solution.bound is not None
        assert others.min() >= best.solution.bound - 1e-9


def test_trial_weights_that_stay_on() -> None:
    """The same rotor, measured both ways."""
    alpha, A, U = np.array([[1 + 2j, 0.5], [0.2j, 2 - 1j]]), np.array([1j, 2.0]), np.array([1.0, -2j])
    off, on = A[:, None] + alpha * U, A[:, None] + np.cumsum(alpha * U, axis=1)
    found = []
    for B, keep in ((off, False), (on, True)):
        rows = [[text(x) for x in row] for row in B.tolist()]
        given_case = {"A": [text(x) for x in A.tolist()], "B": rows, "U": [text(x) for x in U.tolist()]}
        found.append(mahovik.balance({**given_case, "keep_trial": keep}).w)
    assert np.allclose(found[0], -np.linalg.solve(alpha, A)) and np.allclose(found[0], found[1])


def test_pieces_are_the_best_of_all() -> None:
    """Against every choice of one weight or none in each of two planes."""
    pieces = {"holes": 8, "amounts": [1, 2], "forbidden": [[200, 230]], "most": 1}
    found = mahovik.balance({**RUNS, "pieces": pieces})
    assert found.made is not None and found.made.proven
    allowed = [0j, *(a * np.exp(1j * np.radians(45 * i)) for i in range(8) for a in (1, 2) if i != 5)]
    A, alpha = found.problem.A, found.problem.alpha
    sizes = [np.abs(A + alpha @ np.array(each)).max() for each in itertools.product(allowed, repeat=2)]
    assert min(sizes) * (1 - 1e-9) <= np.abs(found.made.left).max() <= min(sizes) / np.cos(np.pi / 36) * (1 + 1e-5)


def test_holes_are_opposite_and_screws_split() -> None:
    weight = mahovik.balance({**RUNS, "pieces": {"positions": [0, 120, 240], "amounts": [3], "split": True}})
    hole = mahovik.balance(
        {**RUNS, "pieces": {"positions": [180, 300, 60], "amounts": [3], "split": True, "remove": True}}
    )
    assert weight.made is not None and hole.made is not None
    assert np.allclose(weight.made.w, weight.w, atol=1e-3) and np.allclose(hole.made.w, weight.w, atol=1e-3)


@given(st.floats(0, 1e6), st.floats(-720, 720))
def test_polar_texts(amplitude: float, degrees: float) -> None:
    value = read_polar(f"{amplitude!r}@{degrees!r}")
    assert value is not None
    back = read_polar(write_polar(value))
    assert back is not None and abs(back - value) <= 2e-3 * abs(value)


REFUSED = (
    ({**RUNS, "A": ["170@112", "53"]}, 'A[1]: expected "amplitude@degrees"'),
    ({**RUNS, "A": ["170@112", "nan@3"]}, "A[1]"),
    ({**RUNS, "A": ["170@112"]}, "B: 2 rows, but A has 1 sensor"),
    ({**RUNS, "U": ["1@0"]}, "U: 1 trial weight, but B has 2 columns"),
    ({**RUNS, "U": ["1@0", "0@0"]}, "U[1]: a trial weight of 0"),
    ({**RUNS, "B": [["1@0", "2@0"], ["1@0"]]}, "B[1]: 1 plane, but the first row has 2"),
    ({**RUNS, "ALPHA": [["1@0"]]}, "ALPHA: given beside trial runs"),
    ({"A": ["1@0", "1@0"], "ALPHA": [["1@0", "2@0"], ["2@0", "4@0"]]}, "not independent: 0 and 1"),
    ({"A": ["1@0"], "ALPHA": [["1@0", "2@0"]]}, "2 planes, but only 1 sensor"),
    ({**RUNS, "keep": True}, "keep: unknown key"),
    ({**RUNS, "keep_trial": 1}, "keep_trial: expected true or false"),
    ({**RUNS, "most": [1]}, "most: 1 number, but there are 2 planes"),
    ({**RUNS, "most": 2, "pieces": [None, {"holes": 4, "amounts": [1]}]}, 'most: not allowed with "pieces"'),
    ({**RUNS, "pieces": {"holes": 4, "amounts": []}}, "pieces.amounts"),
    ({**RUNS, "pieces": {"holes": 4, "amounts": [1], "forbidden": [[0, 359]]}}, "pieces.forbidden: leaves no position"),
    ({"A": ["1@0"]}, "B: expected a list of rows"),
)


@pytest.mark.parametrize(("raw", "words"), REFUSED)
def test_refused(raw: dict[str, object], words: str) -> None:
    with pytest.raises(BalanceError) as error:
        mahovik.balance(raw)
    assert words in str(error.value)


def test_command(tmp_path: Path) -> None:
    (tmp_path / "a.json").write_text(json.dumps(RUNS), encoding="utf-8")
    done = run("balance", "--influence", str(tmp_path / "a.json"), "--json", "-o", str(tmp_path / "b.json"))
    assert done.exit_code == 0
    assert json.loads(done.stdout)["w"] == ["1.979@236.2", "1.071@121.8"]
    assert json.loads((tmp_path / "b.json").read_text(encoding="utf-8")) == json.loads(done.stdout)
    (tmp_path / "c.json").write_text("{", encoding="utf-8")
    for name in ("c.json", "missing.json"):
        refused = run("balance", "--influence", str(tmp_path / name), "-o", str(tmp_path / "d.json"))
        assert refused.exit_code == 2 and refused.stderr.startswith("error: ") and not (tmp_path / "d.json").exists()


def test_a_file_is_read_strictly(tmp_path: Path) -> None:
    """A repeated key and a missing file in a line; decimal numbers of limits and pieces are read."""
    file = tmp_path / "a.json"
    file.write_text(json.dumps(RUNS)[:-1] + ', "U": ["2@0", "2@0"]}', encoding="utf-8")
    with pytest.raises(BalanceError, match=r'a\.json: not JSON: key "U" appears twice'):
        mahovik.balance(file)
    with pytest.raises(BalanceError, match=r"gone\.json: no such file"):
        mahovik.balance(tmp_path / "gone.json")
    for more in ({"most": [0.5, 2.5]}, {"pieces": {"holes": 4, "first": 0.5, "amounts": [0.5, 1.5]}}):
        file.write_text(json.dumps({**RUNS, **more}), encoding="utf-8")
        assert np.array_equal(mahovik.balance(file).w, mahovik.balance({**RUNS, **more}).w)
