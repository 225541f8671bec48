"""Times of the Python functions: a number in s, or a text with a unit, as on the command line."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

import mahovik
from api.models import model
from mahovik.out.functions.given import time_limit
from mahovik.stands import path

DEMO3, SHAKER2, SAT4 = (str(path(name)) for name in ("demo3", "shaker2", "sat4"))
TILT = str(path("shaker2").with_name("shaker2.motion.json"))
SEARCHES: dict[str, Callable[[str], object]] = {
    "plan": lambda limit: mahovik.plan(SHAKER2, TILT, seconds=limit),
    "design": lambda limit: mahovik.design(SHAKER2, TILT, "phase", seconds=limit),
    "quiet": lambda limit: mahovik.quiet(SAT4, "acc1", (20.0, 200.0), backend=None, seconds=limit),
    "excite": lambda limit: mahovik.excite(SAT4, speed="3000 rpm", seconds=limit),
}


def test_a_run_of_texts_is_that_of_the_numbers() -> None:
    texts = mahovik.simulate(DEMO3, "20 ms", dt="0.5 ms", every="2000 us")
    numbers = mahovik.simulate(DEMO3, 0.02, dt=0.0005, every=0.002)
    assert len(texts) == 11
    assert texts.t[-1] == 0.02
    np.testing.assert_array_equal(texts.run.data, numbers.run.data)


def test_a_step_of_a_text_is_that_of_the_number() -> None:
    x = model("demo3").state(phi_dot=100.0)
    for step in (model("demo3").step, model("demo3").step_driven):
        np.testing.assert_array_equal(step(x, "0.1 ms").phi, step(x, 1e-4).phi)


@pytest.mark.parametrize("name", ["until", "dt", "every"])
@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("1", '"1" has no unit, write the number without quotes for SI'),
        ("1 m", 'unit "m" does not fit, expected a time (s)'),
        ("soon", '"soon" is not a number with a unit'),
        ("0 s", "0: expected a time above 0, in s"),
    ],
)
def test_other_texts_are_refused_by_name(name: str, text: str, words: str) -> None:
    given = {"until": 1.0, name: text}
    with pytest.raises(mahovik.UsageError) as refused:
        mahovik.simulate(DEMO3, **given)  # type: ignore[arg-type]
    assert str(refused.value).startswith(f"--{name}")
    assert words in str(refused.value)


def test_a_step_refuses_other_texts() -> None:
    x = model("demo3").state()
    with pytest.raises(mahovik.InputError, match=r'^dt: unit "m" does not fit, expected a time \(s\)'):
        model("demo3").step(x, "1 m")


@pytest.mark.parametrize("name", SEARCHES)
@pytest.mark.parametrize(
    ("text", "words"), [("1 kg", 'seconds: unit "kg" does not fit'), ("0 s", "seconds 0: expected")]
)
def test_searches_read_their_limit_before_they_begin(name: str, text: str, words: str) -> None:
    with pytest.raises(mahovik.UsageError, match=words):
        SEARCHES[name](text)


def test_the_limit_of_a_search_is_in_seconds() -> None:
    assert [time_limit("seconds", each) for each in ("1 min", "500 ms", 2, None)] == [60.0, 0.5, 2, None]


def test_a_judge_reads_its_timeout() -> None:
    with pytest.raises(mahovik.UsageError, match='timeout: unit "kg" does not fit'):
        mahovik.judge(DEMO3, "cat", timeout="1 kg")
