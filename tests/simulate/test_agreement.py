"""The C against SciPy on the literal reference; energy against work; steep and given torques; motors; early ends."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import mahovik
from mahovik import stands
from mahovik.core.motion.laws import TorqueSpeed
from mahovik.core.motion.regime import loads_regime, steady_regime
from mahovik.core.stand import Stand, load, loads, rest_state
from mahovik.core.stand.model import State
from mahovik.core.stand.motor import Motor
from mahovik.core.stand.random import BARE, EVERYTHING, random_stand
from mahovik.errors import RefusedError, RegimeError, UsageError
from mahovik.proof import reference
from mahovik.use.simulate.case import Case
from mahovik.use.simulate.run import Run, simulate
from mahovik.use.study.rest import rest
from simulate.runs import columns
from toolchain.quick import quick

LAWS = """
schema = 1
[flywheel.w1]
phase = 0.3
ramp = { from = 10, to = 60, duration = 0.03, start = 0.01 }
[flywheel.w2]
sweep = { from = "4 Hz", to = "12 Hz", duration = 0.05, scale = "log" }
[flywheel.w3]
harmonic = { mean = 10, amplitude = 5, frequency = 8 }
[wrench]
carrier = [1, 2, 3, 0.1, 0, 0]
w1 = [0, 0.1, 0, 0.01, 0, 0]
"""
TORQUES = """
schema = 1
[flywheel.w1]
torque = 0.3
initial_speed = -5
[flywheel.w2]
speed = 40
[flywheel.w3]
run_up = { torque = 0.2, to = 30, band = 5 }
"""
MIXED = """
schema = 1
[flywheel.w1]
torque = 0.3
initial_speed = -5
[flywheel.w2]
phase = 0.4
harmonic = { mean = 40, amplitude = 10, frequency = 12 }
[flywheel.w3]
ramp = { from = -10, to = 80, duration = 0.03, start = 0.01 }
"""


@cache
def busy() -> Stand:
    """Three flywheels with motors, every kind of wrench."""
    return random_stand(np.random.default_rng(5), 3, EVERYTHING, name="busy")


@cache
def free() -> Stand:
    """Three flywheels, no external wrench."""
    return random_stand(np.random.default_rng(6), 3, BARE, name="freely")


def start(stand: Stand) -> State:
    """A moving carrier, attitude by angles."""
    return replace(rest_state(stand), angles=(0.2, 0.4, -0.3), V=(0.1, -0.2, 0.1, 0.3, 0.2, -0.4), phi=(0.1, 0.2, 0.3))


def case(stand: Stand, text: str, until: float = 0.05, **more: Any) -> Case:
    return Case(stand, loads_regime(text, stand, until), start(stand), until, **{"every": 0.01, **more})


def worst(a: Run, b: Run) -> float:
    """Largest difference, each column relative to its size (at least 1)."""
    assert [*a.columns] == [*b.columns]
    assert (a.stopped, b.stopped) == (None, None)
    sizes = {name: np.maximum(1.0, np.abs(column).max()) for name, column in b.columns.items()}
    return float(max(np.abs(a[name] - b[name]).max() / size for name, size in sizes.items()))


@pytest.mark.parametrize(
    ("text", "dt"), quick(1, [(TORQUES, 1e-4), (MIXED, 5e-5), (LAWS, 1e-4)]), ids=["torques", "mixed", "laws"]
)
def test_c_agrees_with_scipy(text: str, dt: float) -> None:
    """Inputs that vary within a step count as constant there: an error of dt squared."""
    judge = simulate(case(busy(), text), "scipy", mounts=True)
    coarse, fine = (simulate(case(busy(), text, dt=step), mounts=True) for step in (4e-4, dt))
    assert worst(fine, judge) < 2e-6
    assert worst(fine, judge) < worst(coarse, judge) * 2 * (dt / 4e-4) ** 2 + 1e-8
    assert len(judge["t [s]"]) == 6


@pytest.mark.parametrize(("text", "first"), [(LAWS, 0), (MIXED, 1)], ids=["laws", "mixed"])
def test_speed_laws_are_kept_exactly(text: str, first: int) -> None:
    run = simulate(case(busy(), text, every=0.0037))
    motion = case(busy(), text).motion(run["t [s]"])
    for s, name in list(enumerate(("w1", "w2", "w3")))[first:]:
        for k, column in enumerate((f"phi {name} [rad]", f"phi_dot {name} [rad/s]", f"phi_ddot {name} [rad/s2]")):
            np.testing.assert_array_equal(run[column], motion[k][:, s])


def energy(stand: Stand, run: Run, row: int) -> float:
    """Kinetic energy by the reference at a row of a run."""
    x = [run[name][row] for name in list(run.columns)[:14]]
    names = [s.name for s in stand.flywheels]
    state = replace(
        rest_state(stand),
        position=tuple(x[1:4]),
        quaternion=tuple(x[4:8]),
        V=tuple(x[8:14]),
        phi=tuple(run[f"phi {n} [rad]"][row] for n in names),
        phi_dot=tuple(run[f"phi_dot {n} [rad/s]"][row] for n in names),
    )
    return float(reference.evaluate(stand, state, ["momentum"])["energy"])


@pytest.mark.parametrize("text", quick(1, [LAWS.partition("[wrench]")[0], MIXED]), ids=["laws", "mixed"])
def test_energy_is_the_work_of_the_torques_that_speed_laws_need(text: str) -> None:
    run = simulate(case(free(), text, every=1e-4))
    power = np.asarray(sum(run[f"tau w{s} [N m]"] * run[f"phi_dot w{s} [rad/s]"] for s in (1, 2, 3)))
    power = power[run["t [s]"] <= 0.0095]  # before the first corner
    work = np.trapezoid(power, dx=1e-4)
    assert energy(free(), run, len(power) - 1) - energy(free(), run, 0) == pytest.approx(work, rel=1e-5)


@pytest.mark.parametrize(
    "wrong", [{"dt": 0.0}, {"dt": -1.0}, {"dt": float("nan")}, {"every": 0.0}, {"until": float("inf")}, {"order": 3}]
)
def test_bad_numbers_are_refused(wrong: dict[str, Any]) -> None:
    arguments = {"until": 0.1, "every": 0.01, **wrong}
    with pytest.raises(UsageError, match="expected"):
        Case(free(), steady_regime(free(), [0.0] * 3), rest_state(free()), **arguments)


SHAKER = load(stands.path("shaker2"))


def steep_case(text: str, stand: Stand = SHAKER, dt: float = 1e-4) -> Case:
    return Case(stand, loads_regime(f"schema = 1\n{text}\n", stand, 0.05), rest(stand).state, 0.05, every=0.01, dt=dt)


def run_up(torque: float, **more: float) -> str:
    rest_of_it = "".join(f", {key} = {value}" for key, value in more.items())
    return f'default = {{ run_up = {{ torque = {torque}, to = "300 rpm"{rest_of_it} }} }}'


def largest_difference(a: Run, b: Run, quantity: str) -> float:
    assert (a.stopped, b.stopped) == (None, None)
    return float(max(np.abs(a[name] - b[name]).max() for name in a.columns if name.startswith(quantity)))


@pytest.mark.parametrize("torque", [3.0, *(pytest.param(x, marks=pytest.mark.slow) for x in (0.3, 20.0))])
def test_a_strong_run_up_agrees_with_scipy(torque: float) -> None:
    """The figures of docs/studies.md. Torques of 20 N m settle to 0.03 N m, so both are asked of them."""
    judge = simulate(steep_case(run_up(torque)), "scipy")
    run = simulate(steep_case(run_up(torque)))
    assert largest_difference(run, judge, "tau") < 1e-4
    assert largest_difference(run, judge, "phi_dot") < 1e-5
    assert largest_difference(run, judge, "v_dot") < 1e-4
    if torque >= 3.0:
        assert np.abs(run["tau left [N m]"][1:]).max() < 0.031


def test_what_is_too_steep_is_refused_before_the_run() -> None:
    with pytest.raises(
        UsageError, match=r"flywheel left: its torque falls by up to 5e\+03 N m per rad/s.* wider `band`"
    ):
        simulate(steep_case(run_up(50.0, band=0.01)))
    simulate(replace(steep_case(run_up(50.0, band=0.01), dt=1e-6), until=1e-4))  # as the refusal proposes: taken


def test_a_plain_run_in_float_warns_of_lost_increments(recwarn: pytest.WarningsRecorder) -> None:
    options: dict[str, Any] = {"regime": {"default": {"torque": "0.1 mN m", "initial_speed": 200}}}
    mahovik.simulate(mahovik.load(stands.path("sat4")), until=0.001, real="float", dt=1e-5, **options)
    assert ["or real=double" in str(warning.message) for warning in recwarn] == [True]
    recwarn.clear()
    mahovik.simulate(mahovik.load(stands.path("sat4")), until=0.001, real="float", dt=1e-5, carried=True, **options)
    assert not recwarn.list


def test_interruption_keeps_what_was_computed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("mahovik.use.simulate.course.NUMBERS", 1)  # a piece a moment

    def stop(t: float) -> None:
        if t > 0.025:
            raise KeyboardInterrupt

    run = simulate(case(free(), TORQUES), progress=stop)
    assert run.interrupted
    assert run.stopped == "stopped at t = 0.03 s of 0.05 s"
    assert len(run["t [s]"]) == 4


def with_motors(motor: Motor) -> Stand:
    """shaker2 with the motor on both flywheels."""
    stand = load(stands.path("shaker2"))
    return replace(stand, flywheels=tuple(replace(s, motor=motor) for s in stand.flywheels))


def test_a_speed_law_that_the_motor_cannot_give_is_told() -> None:
    stand = with_motors(Motor(0.01, None, None, None, None, 0.0, 0.0, 0.1))
    text = "schema = 1\n[flywheel.left]\nramp = { to = 100, duration = 0.1 }\n[flywheel.right]\nhold = true\n"
    run = simulate(Case(stand, loads_regime(text, stand, 0.05), rest_state(stand), 0.05))
    t, missing = run.weak_motors["left"]
    assert 0.0 <= t <= 0.05
    assert missing == pytest.approx(np.abs(run["motor left [N m]"]).max() - 0.01, rel=1e-12)


RAIL = """
schema = 1
name = "shaker"
carrier = { mass = 19, inertia = [0.2, 0.2, 0.2] }
hold = { freedoms = ["x"] }
suspension = { stiffness = [78956.8352, 0, 0, 0, 0, 0], damping = [40, 0, 0, 0, 0, 0] }
[[flywheel]]
name = "ex"
axis = [0, 0, 1]
zero = [1, 0, 0]
mass = 1
spin_inertia = 2e-3
transverse_inertia = 1.5e-3
unbalance = { static = 0.02 }
motor = { torque = 0.35, speed = "1500 rpm", viscous = 1e-4 }
"""
CURVE = [[0, 0.4], [100, 0.9], ["1500 rpm", 0.2], [160, 0]]


@pytest.mark.parametrize("law", [{"torque": 0.35}, {"torque_speed": CURVE}], ids=["motor", "curve"])
def test_an_exciter_on_a_rail_is_that_of_two_equations(law: dict[str, Any]) -> None:
    """(M) x'' + c x' + k x = u (w^2 cos p + w' sin p), J w' = T(w) + u x'' sin p, by SciPy."""
    M, c, k, u, J, no_load = 20.0, 40.0, 78956.8352, 0.02, 2e-3, 50 * np.pi
    speeds, torques = [0.0, 100.0, no_load, 160.0], [0.4, 0.9, 0.2, 0.0]

    def rates(_: float, y: Any) -> list[float]:
        x, v, p, w = y
        T = np.interp(abs(w), speeds, torques) if "torque_speed" in law else 0.35 * (1 - w / no_load if w > 0 else 1)
        A = np.array([[M, -u * np.sin(p)], [-u * np.sin(p), J]])
        a = np.linalg.solve(A, [u * w * w * np.cos(p) - c * v - k * x, T - 1e-4 * w])
        return [v, a[0], w, a[1]]

    at = np.linspace(0.0, 1.0, 11)
    expected = solve_ivp(rates, (0, 1), [0.0] * 4, rtol=1e-10, atol=1e-12, method="DOP853", t_eval=at).y
    start = {"position": [0, 0, 0]}
    run = columns(loads(RAIL), 1.0, every=0.1, start=start, regime={"flywheel": {"ex": law}})
    for row, name in zip(expected, ("x [m]", "v_x [m/s]", "phi ex [rad]", "phi_dot ex [rad/s]"), strict=True):
        np.testing.assert_allclose(run[name], row, rtol=0.0, atol=2e-5 * np.abs(row).max())


def test_what_a_curve_delivers_is_mirrored_holds_beyond_its_ends_and_is_read_with_units() -> None:
    stand = loads(RAIL)
    law = loads_regime(f"schema = 1\nflywheel.ex = {{ torque_speed = {CURVE} }}", stand, 1.0).flywheels[0].law
    assert isinstance(law, TorqueSpeed)
    assert [law.torque(0.0, w, None) for w in (-200.0, -50.0, 0.0, 50.0, 200.0)] == [0.0, 0.65, 0.4, 0.65, 0.0]
    both = loads_regime("schema = 1\nflywheel.ex = { torque_speed = [[-10, -1], [10, 3]] }", stand, 1.0)
    assert [both.torques(0.0, np.array([w]), (None,))[0] for w in (-20.0, 0.0, 20.0)] == [-1.0, 1.0, 3.0]


@pytest.mark.parametrize(
    ("curve", "words"),
    [
        ("[[0, 1]]", "torque_speed: expected at least two points, found 1"),
        ("[[0, 1], [0, 2]]", r"torque_speed\[1\]\[0\]: its speed 0 rad/s is not above 0 rad/s"),
        ('[[0, "1 m"], [1, 0]]', r"torque_speed\[0\]\[1\]: unit"),
    ],
)
def test_bad_curves_are_refused_in_one_line(curve: str, words: str) -> None:
    with pytest.raises(RegimeError, match=words) as caught:
        loads_regime(f"schema = 1\nflywheel.ex = {{ torque_speed = {curve} }}", loads(RAIL), 1.0)
    assert len(str(caught.value).splitlines()) == 1


def test_samples_move_as_each_alone_and_a_refused_one_is_named() -> None:
    stand = mahovik.load(stands.path("demo3"))
    model = mahovik.build(stand)
    masses = np.linspace(0.5, 0.6, 10)
    law: dict[str, Any] = {"regime": {"default": {"torque": 0.01}}, "mounts": True}
    many = model.simulate("20 ms", tables=model.tables({"w1.mass": masses}), **law)
    one = model.simulate(0.02, tables=model.tables({"w1.mass": masses[3:4]}), **law)
    assert "tau" in one and np.array_equal(many["t"], one["t"])
    for x in one.columns[1:]:
        np.testing.assert_array_equal(many[x.name][3:4], x.values)
    dataset = many.to_xarray()
    assert dict(dataset.sizes)["sample"] == 10
    assert float(dataset.phi_dot.sel(flywheel="w1")[3, -1]) == many["phi_dot"][3, -1, 0]
    start = np.tile(np.concatenate([one[n][0, 0] for n in ("position", "attitude", "V", "phi", "phi_dot")]), (2, 1))
    start[1, 7] = 2e4
    with pytest.raises(RefusedError, match="sample 1: at t = 0 s forward returned RANGE: V u is 20000, at most "):
        model.simulate(0.01, start=start)
    with pytest.raises(RefusedError, match=r"^at t = 0 s forward returned RANGE: V u is 20000, at most "):
        model.simulate(0.01, start=start[1])
    assert np.isnan(model.simulate(0.01, start=start[1], on_error="nan")["position"]).all()
    kept = model.simulate(0.01, start=start, on_error="nan")
    assert [bool(words) for words in kept.refused] == [False, True]
    assert np.isfinite(kept["position"][0]).all()
    assert np.isnan(kept["position"][1, 1:]).all()
