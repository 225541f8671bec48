"""step: order of convergence, conservation, locks, refusals; against SciPy's adaptive integration of the reference."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from mahovik.contract.status import STATUS_VALUES
from mahovik.core.stand import State
from mahovik.core.stand.random import BARE, EVERYTHING, random_stand
from mahovik.proof.reference import evaluate
from mahovik.proof.verify.c_backend import CBackend
from toolchain.quick import quick

DURATION = 0.1


@cache
def free() -> CBackend:
    """Three general flywheels, no external wrench."""
    return CBackend(random_stand(np.random.default_rng(11), 3, BARE, name="free"))


@cache
def everything() -> CBackend:
    """Five flywheels with every kind of wrench."""
    return CBackend(random_stand(np.random.default_rng(12), 5, EVERYTHING, name="busy"))


def start(c: CBackend) -> dict[str, Any]:
    """A moving state."""
    count = len(c.layout.structure.flywheels)
    return {
        "position": [0.1, -0.2, 0.3],
        "attitude": [0.8, 0.0, 0.6, 0.0],
        "V": [0.1, 0.2, -0.3, 0.4, -0.5, 0.6],
        "phi": list(np.linspace(-1, 2, count)),
        "phi_dot": list(np.linspace(-30, 40, count)),
    }


def inputs(c: CBackend, x: dict[str, Any], **more: Any) -> dict[str, Any]:
    """Arguments of step by name; torques and accelerations that differ."""
    count = len(x["phi"])
    values = {"table": c.library.default("default"), "x": x, "tau": [0.05 * (s + 1) for s in range(count)]}
    values |= {"locked": [0] * count, "phi_ddot": [3.0 * (s - 1) for s in range(count)]}
    values |= {"wrench": [0.0] * 6 * len(c.inputs), "dt": 1e-3, "order": 4}
    return values | more


def stepped(c: CBackend, function: str, steps: int, order: int, **more: Any) -> dict[str, Any]:
    """The state after DURATION in equal steps."""
    x = start(c)
    for _ in range(steps):
        status, out = c.call(function, inputs(c, x, dt=DURATION / steps, order=order, **more))
        assert status == 0
        x = out["next"]
    return x


def flat(x: dict[str, Any]) -> np.ndarray:
    """Numbers of a state; phases by their sine and cosine, for they are wrapped."""
    phi = np.array(x["phi"])
    return np.concatenate([x["position"], x["attitude"], x["V"], np.sin(phi), np.cos(phi), x["phi_dot"]])


@pytest.mark.parametrize(
    ("function", "order", "counts", "slack"),
    quick(
        2,
        [
            ("step", 4, (80, 160, 320), 0.2),
            ("step_driven", 2, (320, 640, 1280), 0.1),
            ("step_driven", 4, (20, 40, 80), 0.2),  # with more steps rounding is all that is left
            ("step", 2, (320, 640, 1280), 0.1),
        ],
    ),
)
def test_order_of_convergence(function: str, order: int, counts: tuple[int, ...], slack: float) -> None:
    """Errors against a much finer run fall with the power of the method."""
    c = free()
    exact = flat(stepped(c, function, 1280 * 4, 4))
    errors = [np.abs(flat(stepped(c, function, n, order)) - exact).max() for n in counts]
    slopes = np.log2(np.array(errors[:-1]) / errors[1:])
    assert slopes[-1] == pytest.approx(order, abs=slack)


@pytest.mark.parametrize(("function", "want"), quick(0, [("step_driven", "forward"), ("step", "coupled")]))
def test_step_agrees_with_an_adaptive_integration_of_the_reference(function: str, want: str) -> None:
    """The literal reference, integrated by SciPy with its own kinematics, ends where the C ends."""
    c = everything()
    stand = c.generated.values._stand
    x = start(c)
    count = len(x["phi"])
    tau, phi_ddot = (tuple(inputs(c, x)[name]) for name in ("tau", "phi_ddot"))

    def rates(t: float, y: np.ndarray) -> np.ndarray:
        q = y[3:7] / np.linalg.norm(y[3:7])
        state = State(
            tuple(y[:3]), None, tuple(q), tuple(y[7:13]), tuple(y[13 : 13 + count]), tuple(y[13 + count :]),
            phi_ddot, (0.0,) * 6, tau,
        )  # fmt: skip
        answer = {"phi_ddot": phi_ddot, **evaluate(stand, state, [want])}
        w, u = q[0], q[1:]
        omega, v = y[10:13], y[7:10]
        position = v + 2 * np.cross(u, np.cross(u, v) + w * v)
        attitude = 0.5 * np.concatenate([[-u @ omega], w * omega + np.cross(u, omega)])
        return np.concatenate([position, attitude, answer["V_dot"], y[13 + count :], answer["phi_ddot"]])

    y0 = np.concatenate([x["position"], x["attitude"], x["V"], x["phi"], x["phi_dot"]])
    # at 1e-10 the kinks of |V| V let it be 5e-8 off, by where its steps fall
    judged = solve_ivp(rates, (0, DURATION), y0, method="DOP853", rtol=1e-12, atol=1e-14).y[:, -1]
    ours = stepped(c, function, 4000, 4)
    expected = dict(zip(("position", "attitude", "V"), np.split(judged[:13], [3, 7]), strict=True))
    expected |= {"phi": judged[13 : 13 + count], "phi_dot": judged[13 + count :]}
    # 4,000 steps are within 1e-9 of 16,000
    assert flat(ours) == pytest.approx(flat(expected), rel=1e-8, abs=2e-8)


def test_the_result_may_be_the_state_itself_and_phases_are_wrapped() -> None:
    """A step in place gives the same bits; every phase ends within half a turn."""
    c = free()
    x = start(c) | {"phi": [900.0, -5000.0, 3.2]}
    apart = c.call("step", inputs(c, x))[1]["next"]
    assert max(abs(p) for p in apart["phi"]) <= np.pi * (1 + 1e-15)
    ffi = c.library._ffi
    place = ffi.new("free_state *", x)
    arguments = inputs(c, x) | {"x": place, "next": place}
    status, _ = c.library.run(
        c.program.function("step"), {k: v for k, v in arguments.items() if k not in ("phi_ddot", "wrench")}
    )
    assert status == 0
    assert list(place.phi) == apart["phi"]
    assert list(place.V) == apart["V"]


@pytest.mark.parametrize(
    ("name", "value", "due"),
    [
        ("dt", 0.0, "BAD_ARGUMENT"),
        ("dt", -1e-3, "BAD_ARGUMENT"),
        ("dt", 11.0, "RANGE"),
        ("dt", float("nan"), "NOT_FINITE"),
        ("dt", float("inf"), "NOT_FINITE"),
        ("order", 3, "BAD_ARGUMENT"),
    ],
)
def test_a_bad_step_is_refused(name: str, value: float, due: str) -> None:
    """dt outside (0, MAX_STEP], an unknown order: refused, nothing written."""
    c = free()
    status, out = c.library.run(
        c.program.function("step"),
        {k: v for k, v in inputs(c, start(c), **{name: value}).items() if k not in ("phi_ddot", "wrench")},
        fill=5.5,
    )
    assert status == STATUS_VALUES[due]
    assert set(out["next"]["V"]) == {5.5}


@pytest.mark.slow
@pytest.mark.parametrize("speed", quick(1, [2e3, -2e3]))
def test_a_step_over_too_many_turns_is_refused_in_float(speed: float) -> None:
    """A phase that a float cannot hold to its digits is out of range, not a worse answer."""
    c = CBackend(random_stand(np.random.default_rng(3), 1, BARE, name="turns"), "float")
    x = {"position": [0.0] * 3, "attitude": [1.0, 0, 0, 0], "V": [0.0] * 6, "phi": [999.0], "phi_dot": [speed]}
    arguments = {"table": c.library.default("default"), "x": x, "phi_ddot": [0.0], "order": 4}
    assert c.call("step_driven", arguments | {"dt": 1.0})[0] == STATUS_VALUES["RANGE"]
    status, out = c.call("step_driven", arguments | {"dt": 1e-3})
    assert status == STATUS_VALUES["COARSE"]  # two radians
    assert np.sin(out["next"]["phi"][0]) == pytest.approx(np.sin(999.0 + speed * 1e-3), abs=2e-4)
