"""Properties of corrections, split ones, and refused input."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import mahovik
from balance.published import solved
from cli.run import run
from mahovik.errors import BalanceError, UsageError
from mahovik.use.balance.influence import read_influence, read_polar, write_polar

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
    runs = case(seed, N + more, N)
    (problem,), _ = read_influence(runs)
    least, best = (solved(runs, method) for method in ("least-squares", "min-max"))
    assert np.abs(problem.alpha.conj().T @ least.left).max() < 1e-9
    assert np.abs(best.left).max() <= np.abs(least.left).max() + 1e-7
    rng = np.random.default_rng(seed)
    for size in (1e-3, 1e-2, 0.1):
        near = best.w + size * (rng.normal(size=(50, N)) + 1j * rng.normal(size=(50, N)))
        nearby = np.abs(problem.A + near @ problem.alpha.T).max(axis=1)
        assert best.bound is not None
        assert nearby.min() >= best.bound - 1e-9


def test_trial_weights_that_stay_on() -> None:
    """A rotor whose trial weights stay on gets the weights of the same rotor whose trial weights are removed."""
    alpha, A, U = np.array([[1 + 2j, 0.5], [0.2j, 2 - 1j]]), np.array([1j, 2.0]), np.array([1.0, -2j])
    off, on = A[:, None] + alpha * U, A[:, None] + np.cumsum(alpha * U, axis=1)
    weights = []
    for B, keep in ((off, False), (on, True)):
        rows = [[text(x) for x in row] for row in B.tolist()]
        runs = {"A": [text(x) for x in A.tolist()], "B": rows, "U": [text(x) for x in U.tolist()]}
        weights.append(solved({**runs, "keep_trial": keep}).w)
    assert np.allclose(weights[0], -np.linalg.solve(alpha, A)) and np.allclose(weights[0], weights[1])


def test_a_split_correction_is_what_it_was() -> None:
    """At the two places beside it, none of them further than a division; at a place itself it is whole."""
    result = mahovik.balance(influence=RUNS, places=7)
    for whole, split in zip(result["w"], result["split"], strict=True):
        w, parts = read_polar(whole) or 0j, [read_polar(part) or 0j for part in split.split(" + ")]
        assert sum(parts) == pytest.approx(w, abs=1e-2)
        off = [abs(np.degrees(np.angle(part / w))) for part in parts]
        assert sum(off) == pytest.approx(360 / 7, abs=0.2)
    assert mahovik.balance(influence={"A": ["1@180"], "ALPHA": [["1@0"]]}, places="0,90")["split"].tolist() == ["1@0"]
    with pytest.raises(UsageError, match="places: none within half a turn on both sides of 180 degrees"):
        mahovik.balance(influence={"A": ["1@0"], "ALPHA": [["1@0"]]}, places="0,90")


NO_PHASE = (
    {"A": 10, "B": [7, 12, 18], "U": ["50@0", "50@120", "50@240"]},
    {"A": [10], "B": [[7, 12, 18]], "U": ["50@0", "50@120", "50@240"]},
    {"A": ["10"], "B": [["7", "12", "18"]], "U": ["50@0", "50@120", "50@240"]},
)


@pytest.mark.parametrize("runs", NO_PHASE)
def test_four_runs_without_phase(runs: dict[str, object]) -> None:
    """|w| = 10 x 50 / sqrt((49 + 144 + 324 - 300) / 3) = 58.8 g; the angle by the parts of the influence, by hand."""
    result = mahovik.balance(influence=runs)
    (w,) = result["corrections"].tolist()
    assert abs(w) == pytest.approx(10 * 50 / np.sqrt((49 + 144 + 324 - 300) / 3))
    x = (49 - 100 - 217 / 3) / 20
    y = -((144 - 100 - 217 / 3) / 20 + x / 2) / (np.sqrt(3) / 2)
    assert np.degrees(np.angle(w)) == pytest.approx(180.0 - np.degrees(np.arctan2(y, x)))
    assert result["w"].tolist() == ["58.79@40.1"] and not {"left", "also"} & {*result}


def test_amplitudes_that_contradict_one_another_fail() -> None:
    """No rotor goes from 10 to 100, 10, 10 with a weight at three places; |b| of the nearest is off by 43."""
    bad = mahovik.balance(influence={"A": 10, "B": [100, 10, 10], "U": ["50@0", "50@120", "50@240"]})
    assert not bad.ok and bad["after"] == bad["misfit"] == pytest.approx(43.16, abs=0.01)
    (words,) = bad.messages
    assert "up to 43.16, 43.2 % of the largest" in words and "repeat the runs" in words
    fair = mahovik.balance(influence=NO_PHASE[0])
    assert fair.ok and fair["after"] > fair["misfit"] == pytest.approx(0.4995, abs=1e-4)


def test_what_noise_leaves_is_what_is_said_to_be_left() -> None:
    """200 rotors with noise are balanced without phase: few vibrate more than is said, and fewer twice as much."""
    rng = np.random.default_rng(1)
    U, beyond, off = 4.0 * np.exp(2j * np.pi * np.arange(3) / 3), [], []
    for _ in range(200):
        alpha = rng.uniform(0.5, 2.5) * np.exp(2j * np.pi * rng.uniform())
        A, *B = np.abs(np.concatenate([[10.0], 10.0 + alpha * U]) + 0.1 * rng.normal(size=4)).tolist()
        result = mahovik.balance(influence={"A": [A], "B": [B], "U": [text(u) for u in U.tolist()]})
        w = result["corrections"][0]
        beyond.append(abs(10.0 + alpha * w) / result["after"])
        off.append(abs(w + 10.0 / alpha) / (2**0.5 * result["standard_error"][0]))
    assert 0.2 < np.mean(np.array(beyond) > 1.0) < 0.5 and 0.08 < np.mean(np.array(beyond) > 2.0) < 0.25
    assert 0.5 < np.median(off) < 1.2


def test_one_plane_with_phase() -> None:
    """7@160 became 5@70 with 100 g at 0: w = -7@160 / ((5@70 - 7@160) / 100), 81.37 g."""
    result = mahovik.balance(influence={"A": ["7@160"], "B": [["5@70"]], "U": ["100@0"]})
    assert abs(result["corrections"][0]) == pytest.approx(81.3733, abs=1e-4)
    assert np.degrees(np.angle(result["corrections"][0])) % 360 == pytest.approx(324.462, abs=1e-3)


@settings(deadline=None)
@given(st.floats(0.01, 10.0), st.floats(0.0, 6.28), st.integers(0, 3))
def test_amplitudes_alone_tell_the_weight_or_two(size: float, at: float, kind: int) -> None:
    """The true weight is among the answers, and no other is where trial weights are at three places."""
    U = np.array([[50, 50j], [50, -30], [50, 40 * np.exp(2j), 30 * np.exp(4j)], [50, -50, 20j]][kind], dtype=complex)
    alpha = size * np.exp(1j * at) / 50
    b = np.abs(1.0 + alpha * U)
    result = mahovik.balance(influence={"A": [1.0], "B": [b.tolist()], "U": [text(u) for u in U.tolist()]})
    answers = [result[key][0] for key in ("w", "also") if key in result]
    assert len(answers) == 1 or kind < 2
    errors = [abs(read_polar(polar) + 1.0 / alpha) * abs(alpha) for polar in answers]
    assert min(errors) < 3e-3 if max(b) < 1e3 else True


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
    ({**RUNS, "keep": True}, 'unknown key "keep"'),
    ({**RUNS, "keep_trial": 1}, "keep_trial"),
    ({"A": ["1@0"]}, "B: expected a list of rows"),
    ({"A": ["1@0", 2], "B": [["1@0"], ["1@0"]], "U": ["1@0"]}, "A[1]"),
    ({"A": [1], "B": [1], "U": ["1@0"]}, "weights at two different places"),
    ({"A": [1], "B": [9, 0.1], "U": ["1@0", "1@180"]}, "no influence fits"),
    ({"A": [1, 2], "B": [[1], [2]], "U": ["1@0"]}, "one sensor, one plane"),
    ({"A": [1], "ALPHA": [["1@0"]]}, "without phase it needs trial runs"),
)


@pytest.mark.parametrize(("raw", "words"), REFUSED)
def test_refused(raw: dict[str, object], words: str) -> None:
    with pytest.raises(BalanceError) as error:
        mahovik.balance(influence=raw)
    assert words in str(error.value)


def test_command(tmp_path: Path) -> None:
    (tmp_path / "a.json").write_text(json.dumps(RUNS), encoding="utf-8")
    done = run("balance", "--influence", str(tmp_path / "a.json"), "--json", "-o", str(tmp_path / "b.json"))
    assert done.exit_code == 0
    assert json.loads(done.stdout)["w"] == ["1.979@236.2", "1.071@121.8"]
    for places, split in (("24", "1.482@240 + 0.5108@225"), ("200,300,0,100", "1.186@300 + 1.804@200")):
        done_split = run("balance", "--influence", str(tmp_path / "a.json"), "--json", "--places", places)
        assert json.loads(done_split.stdout)["split"][0] == split
    assert json.loads((tmp_path / "b.json").read_text(encoding="utf-8")) == json.loads(done.stdout)
    (tmp_path / "c.json").write_text("{", encoding="utf-8")
    for name in ("c.json", "missing.json"):
        refused = run("balance", "--influence", str(tmp_path / name), "-o", str(tmp_path / "d.json"))
        assert refused.exit_code == 2 and refused.stderr.startswith("error: ") and not (tmp_path / "d.json").exists()


def test_a_file_is_read_strictly(tmp_path: Path) -> None:
    """A repeated key and a missing file are refused in a line."""
    file = tmp_path / "a.json"
    file.write_text(json.dumps(RUNS)[:-1] + ', "U": ["2@0", "2@0"]}', encoding="utf-8")
    with pytest.raises(BalanceError, match=r'a\.json: not JSON: key "U" appears twice'):
        mahovik.balance(influence=file)
    with pytest.raises(BalanceError, match=r"gone\.json: no such file"):
        mahovik.balance(influence=tmp_path / "gone.json")
