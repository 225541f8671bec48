"""FMUs in fmpy's hands move as `mahovik simulate` does."""

from __future__ import annotations

import ctypes
from typing import Any

import fmpy
import numpy as np
import pytest

from export.fmu import fmus
from mahovik.core.lower.fmu.variables import Inputs
from mahovik.core.motion import loads_regime
from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.use.simulate import Case, simulate

UNTIL, EVERY, DT = 0.1, 0.0125, 1e-3
SPEEDS, TORQUE, ACCELERATION, WRENCH = 40.0, 0.02, 30.0, (3.0, -2.0, 1.0, 0.2, 0.1, -0.3)


def start(stand: Stand, inputs: Inputs) -> tuple[State, dict[str, float]]:
    """A state in motion, and the same as start values and inputs of an FMU."""
    N = len(stand.flywheels)
    state = fmus.moving(stand, SPEEDS)
    values = {f"carrier.V[{i + 1}]": state.V[i] for i in range(6)}
    values |= {f"carrier.position[{i + 1}]": state.position[i] for i in range(3)}
    quaternion = state.quaternion or (1.0, 0.0, 0.0, 0.0)
    values |= {f"carrier.attitude[{i + 1}]": quaternion[i] for i in range(4)}
    for k, s in enumerate(stand.flywheels):
        values |= {f"{s.name}.phi": state.phi[k], f"{s.name}.phi_dot": state.phi_dot[k]}
        drive = (1.0 - 2.0 * (k % 2)) * (k + 1) / N
        symbol, size = ("tau", TORQUE) if inputs == "torque" else ("phi_ddot", ACCELERATION)
        values[f"{s.name}.{symbol}"] = size * drive
    for body in stand.bodies:
        if body.wrench_input:
            values |= {f"{body.name}.wrench[{i + 1}]": WRENCH[i] for i in range(6)}
    return state, values


def regime(stand: Stand, state: State, values: dict[str, float], inputs: Inputs) -> Any:
    """The same drives as a regime of `simulate`."""
    lines, wrenches = ["schema = 1"], []
    for k, s in enumerate(stand.flywheels):
        if inputs == "torque":
            law = f"torque = {values[f'{s.name}.tau']!r}"
        else:
            end = state.phi_dot[k] + values[f"{s.name}.phi_ddot"] * 10.0
            law = f"ramp = {{ from = {state.phi_dot[k]!r}, to = {end!r}, duration = 10.0 }}"
        lines.append(f"[flywheel.{s.name}]\n{law}")
    for body in stand.bodies:
        if body.wrench_input:
            wrenches.append(f"{body.name} = {list(WRENCH)}")
    if wrenches:
        lines += ["[wrench]", *wrenches]
    return loads_regime("\n".join(lines), stand, UNTIL)


def pairs(stand: Stand, inputs: Inputs) -> dict[str, str]:
    """Columns of `simulate` by names of variables."""
    found = {f"carrier.position[{i + 1}]": f"{a} [m]" for i, a in enumerate("xyz")}
    found |= {f"carrier.attitude[{i + 1}]": f"q{a}" for i, a in enumerate("wxyz")}
    found |= {f"carrier.V[{i + 1}]": f"v_{a} [m/s]" for i, a in enumerate("xyz")}
    found |= {f"carrier.V[{i + 4}]": f"omega_{a} [rad/s]" for i, a in enumerate("xyz")}
    found |= {f"carrier.V_dot[{i + 1}]": f"v_dot_{a} [m/s2]" for i, a in enumerate("xyz")}
    found |= {f"carrier.V_dot[{i + 4}]": f"omega_dot_{a} [rad/s2]" for i, a in enumerate("xyz")}
    letters = zip("XYZKMN", ("N",) * 3 + ("N m",) * 3, strict=True)
    loads = [f"mount_{a} {{}} [{u}]" for a, u in letters]
    for s in stand.flywheels:
        found |= {f"{s.name}.phi": f"phi {s.name} [rad]", f"{s.name}.phi_dot": f"phi_dot {s.name} [rad/s]"}
        other = ("phi_ddot", "rad/s2") if inputs == "torque" else ("tau", "N m")
        found[f"{s.name}.{other[0]}"] = f"{other[0]} {s.name} [{other[1]}]"
        found |= {f"{s.name}.mount_wrench[{i + 1}]": loads[i].format(s.name) for i in range(6)}
    for name in (*(p.name for p in stand.instruments), *(p.name for p in stand.points)):
        found |= {f"{name}.reading.specific_force[{i + 1}]": f"force_{a} {name} [m/s2]" for i, a in enumerate("xyz")}
        found |= {f"{name}.reading.twist[{i + 4}]": f"gyro_{a} {name} [rad/s]" for i, a in enumerate("xyz")}
    return found


def moved(name: str, version: str, inputs: Inputs, **more: Any) -> tuple[Any, Any, dict[str, str]]:
    """The same motion by fmpy and by `simulate`, and which columns belong together."""
    stand = fmus.stand(name)
    state, values = start(stand, inputs)
    found = pairs(stand, inputs)
    kind = more.pop("kind", "cs")
    backend = more.pop("backend", "c")
    by_fmpy = fmpy.simulate_fmu(
        fmus.path(name, version, kind, inputs), stop_time=UNTIL, output_interval=EVERY, output=list(found),
        start_values=values | ({"dt": DT} if kind == "cs" else {}), **more,
    )  # fmt: skip
    case = Case(stand, regime(stand, state, values, inputs), state, UNTIL, EVERY, DT)
    return by_fmpy, simulate(case, backend, mounts=True), found


def compare(by_fmpy: Any, by_us: Any, found: dict[str, str], tolerance: float) -> None:
    """Each column to `tolerance` of its largest number, or of 1 where that is less: sums of larger ones cancel."""
    times = by_us["t [s]"]
    assert len(by_fmpy) == len(times)
    assert np.abs(by_fmpy["time"] - times).max() < 1e-12
    for name, column in found.items():
        expected = by_us[column]
        scale = max(1.0, float(np.abs(expected).max()))
        assert np.abs(by_fmpy[name] - expected).max() < tolerance * scale, name


def check_co_simulation(name: str, version: str, inputs: Inputs) -> None:
    """The integrator inside is that of `simulate`, and so are its steps."""
    compare(*moved(name, version, inputs), 1e-9)


def test_co_simulation_under_wrenches_is_simulate() -> None:
    check_co_simulation("driven", "2.0", "torque")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "version", "inputs"),
    [
        ("bench8", "2.0", "torque"),
        ("bench8", "3.0", "acceleration"),
        ("auv6", "2.0", "acceleration"),
        ("auv6", "3.0", "torque"),
        ("rigid", "2.0", "torque"),
        ("driven", "3.0", "acceleration"),
    ],
)
def test_others_are_simulate(name: str, version: str, inputs: Inputs) -> None:
    check_co_simulation(name, version, inputs)


def check_model_exchange(name: str, version: str, inputs: Inputs) -> None:
    """CVode on the rates of the FMU; SciPy on the literal reference: nothing is shared but the stand."""
    found = moved(name, version, inputs, kind="me", backend="scipy", solver="CVode", relative_tolerance=1e-11)
    compare(*found, 2e-6)


@pytest.mark.slow
def test_model_exchange_is_the_reference() -> None:
    check_model_exchange("driven", "3.0", "torque")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "version", "inputs"),
    [
        ("bench8", "3.0", "torque"),
        ("auv6", "2.0", "acceleration"),
        ("rigid", "3.0", "torque"),
        ("driven", "3.0", "acceleration"),
    ],
)
def test_others_are_the_reference(name: str, version: str, inputs: Inputs) -> None:
    check_model_exchange(name, version, inputs)


@pytest.mark.slow
def test_the_quaternion_is_drawn_to_unit_length() -> None:
    """Model exchange: d|q|^2/dt = 2 |q|^2 (1 - |q|^2), whatever omega is; so an integrator cannot lose it."""
    with fmus.instance("driven", "3.0", "me", "torque") as one:
        one.put({"carrier.V[4]": 3.0, "carrier.V[6]": -2.0})
        one.begin()
        one.fmu.enterContinuousTimeMode()
        count = 13 + 2 * len(fmus.stand("driven").flywheels)
        states, rates = (np.zeros(count) for _ in range(2))
        pointers = [x.ctypes.data_as(ctypes.POINTER(ctypes.c_double)) for x in (states, rates)]
        one.fmu.getContinuousStates(pointers[0], count)
        for length in (1.0, 1.01, 0.99):
            states[3:7] *= length / np.linalg.norm(states[3:7])
            one.fmu.setContinuousStates(pointers[0], count)
            one.fmu.getContinuousStateDerivatives(pointers[1], count)
            square = length**2
            assert states[3:7] @ rates[3:7] == pytest.approx(square * (1 - square), abs=1e-14)
            assert np.abs(rates[3:7]).max() > 0.1
