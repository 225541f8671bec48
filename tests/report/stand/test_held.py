"""Reports of held carriers: the hold, its reaction, modes and numbers at a state are those of closed formulas."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mahovik.core.motion.read import loads_regime
from mahovik.core.stand import Stand, load, loads
from mahovik.core.stand.hold import twists
from mahovik.out.report.stand import (
    bodies,
    campbell,
    histories,
    hold,
    matrices,
    response,
)
from mahovik.out.report.stand.material import Material, chosen_state
from mahovik.proof import reference
from mahovik.proof.reference.coordinates import coordinates_at
from mahovik.use.simulate.case import Case
from mahovik.use.simulate.held import allowed_start, home
from mahovik.use.simulate.run import simulate
from mahovik.use.study import campbell as study
from mahovik.use.study.campbell import natural_at
from mahovik.use.study.growth import compare_growth
from mahovik.use.study.response.periodic import scene_of
from report.stand.reports import plain, read
from report.stand.runs import material, run_of

HELD = Path(__file__).resolve().parents[3] / "docs" / "held"


def held_stand(name: str) -> Stand:
    return load(str(HELD / f"{name}.toml"))


def shown(stand: Stand) -> Material:
    return replace(material(stand), state=chosen_state(stand))


def hold_text(stand: Stand) -> str:
    made = hold.section(shown(stand))
    assert made is not None
    assert read(made.html).wrong == []
    assert "nan" not in made.html
    return plain(made.html)


@pytest.mark.parametrize("name", ["pendulum", "force_table", "cube", "air_table", "linear_shaker"])
def test_the_chosen_state_is_one_that_the_hold_allows(name: str) -> None:
    stand = held_stand(name)
    state = chosen_state(stand)
    assert allowed_start(stand, state) == state
    assert np.array(state.V) == pytest.approx(twists(stand.hold) @ np.array(state.u) if stand.hold else None)
    if name == "pendulum":
        assert coordinates_at(stand, state).q == pytest.approx([0.3])


def test_a_force_table_shows_weight_and_the_rotating_force() -> None:
    """12 kg and 2 kg at 9.81 m/s2; 72 g mm at 3000 rpm is 7.106 N, 100 mm above O1."""
    found = hold_text(held_stand("force_table"))
    assert "clamped" in found.lower()
    at_rest = re.search(r"Reaction at rest ([-\d. ]+)", found)
    turning = re.search(r"Reaction R, in E₁ about O₁ ([-\d. ]+)", found)
    assert at_rest is not None and turning is not None
    weight, force = 14.0 * 9.81, 72e-6 * (100 * math.pi) ** 2
    assert [float(x) for x in at_rest[1].split()] == pytest.approx([0, 0, weight, 0, -72e-6 * 9.81, 0], rel=1e-4)
    numbers = [-force, 0, weight, 0, -0.1 * force - 72e-6 * 9.81, 0]
    assert [float(x) for x in turning[1].split()] == pytest.approx(numbers, rel=1e-4)
    made = response.section(shown(held_stand("force_table")))
    assert made is not None
    assert f"force of hold.reaction at most {force:.3g} N RMS at 3000 rpm" in made.summary


def test_a_pendulum_shows_its_freedom_and_its_frequency() -> None:
    """It hangs: 2 pi f = sqrt(m g l / J), wheel locked."""
    stand = held_stand("pendulum")
    found = hold_text(stand)
    assert "pitch turning about y of E1 angle, rad rad/s 0 0 0 0 1 0" in found
    J = 6e-4 + 0.3 * 0.06**2 + 4e-4 + 0.25 * 0.12**2
    f = math.sqrt((0.3 * 0.06 + 0.25 * 0.12) * 9.81 / J) / (2 * math.pi)
    mode = re.search(r"shape 1 ([\d.]+) 0 q_pitch 1", found)
    assert mode is not None
    assert float(mode[1]) == pytest.approx(f, rel=1e-4)
    natural = natural_at(scene_of(stand), np.zeros(1))[0][0]
    assert natural == pytest.approx([f], rel=1e-9)
    assert f"q pitch, rad {math.pi:.4f}" in found.replace("-", "")


def test_the_balance_of_a_held_carrier_has_the_reaction() -> None:
    """F - M V - J phi' - I phi'' + R = K V* in the numbers shown, and R is that of the want."""
    stand = held_stand("cube")
    made = matrices.section(shown(stand))
    assert made is not None
    assert read(made.html).wrong == []
    html = made.html[made.html.index("Balance of (8)") :]
    rows = [
        [float(re.sub(r"·10<sup>(.*?)</sup>", r"e\1", x).replace("−", "-").replace("\u202f", "")) for x in cells]
        for line in re.findall(r"<tr><th[^>]*scope=\"row\">.*?</tr>", html, re.DOTALL)
        if (cells := [re.sub("[\u2007\u2008]", "", c) for c in re.findall(r'<td class="right">(.*?)</td>', line)])
    ]
    F, MV, J, I, R, KV, V_dot = np.array(rows)
    size = np.abs(rows).max()
    assert np.abs(F + MV + J + I + R - KV) == pytest.approx(np.zeros(6), abs=2e-3 * float(size))
    answer = reference.evaluate(stand, chosen_state(stand), ["forward"])
    assert pytest.approx(answer["reaction"], rel=1e-3, abs=1e-9) == R
    assert pytest.approx(answer["V_dot"], rel=1e-3, abs=1e-9) == V_dot


def test_the_residual_of_a_run_has_the_reaction_beside_the_forces() -> None:
    stand = held_stand("pendulum")
    regime = loads_regime("schema = 1\ndefault = { torque = 0.01 }\n", stand, 0.02)
    found = simulate(Case(stand, regime, home(stand), 0.02, every=0.001), "scipy")
    run = run_of(stand, {name: found[name] for name in found.names})
    panel = histories.residuals(stand, run, np.arange(len(run.t)))
    assert panel is not None
    assert max(float(line.y.max()) for line in panel.lines) < 1e-12
    made = histories.section(material(stand, run))
    assert made is not None
    assert "F+R" in re.sub(r"\s", "", plain(made.html)) and "force of the hold" in made.html
    state = run.state(-1, stand.hold)
    assert np.array(state.V) == pytest.approx(twists(stand.hold) @ np.array(state.u) if stand.hold else None, abs=1e-15)


BRAKED = """
schema = 1
name = "braked"
gravity = [0, 0, -9.81]
[carrier]
mass = 2.0
center_of_mass = [0, 0, -0.05]
inertia = [0.02, 0.03, 0.01]
inertia_about = "center_of_mass"
[hold]
freedoms = ["pitch"]
[[hold.friction]]
viscous = 2.0
[[hold.stop]]
at = "60 deg"
stiffness = 40
[[hold.stop]]
at = "-60 deg"
stiffness = 40
[[flywheel]]
name = "wheel"
mass = 0.5
spin_inertia = 0.01
transverse_inertia = 0.006
"""


def test_a_damper_that_drives_is_unstable_from_rest_on() -> None:
    suspension = "[suspension]\nstiffness = [0, 0, 0, 0, 3, 0]\ndamping = [0, 0, 0, 0, -0.5, 0]\n[[flywheel]]"
    stand = loads(BRAKED.replace("viscous = 2.0", "viscous = 0.01").replace("[[flywheel]]", suspension))
    scene = scene_of(stand)
    diagram = study.campbell(scene, np.linspace(0.0, 300.0, 31))
    growth = compare_growth(scene, diagram)
    assert growth is not None and growth.unstable == 0.0
    assert "unstable at 0 rpm" in campbell._growth(scene, diagram)


def test_friction_and_stops_are_shown_with_their_units() -> None:
    made = bodies.section(material(loads(BRAKED)))
    assert made is not None and read(made.html).wrong == []
    found = plain(made.html)
    for words_ in (
        "friction of pitch viscous 2 N m s/rad",
        "stop of pitch, above at 60 deg",
        "stop of pitch, below stiffness 40 N m/rad",
        "damping 0 N m s/rad²",
    ):
        assert words_ in found
    free = bodies.section(material(held_stand("pendulum")))
    assert free is not None and "along the freedoms" not in plain(free.html)


def test_a_carrier_above_critical_damping_is_said_to_have_a_stiffness() -> None:
    """J s^2 + c s + m g l = 0, J of carrier and wheel, has two real roots."""
    J, c, k = 0.03 + 2.0 * 0.05**2 + 0.006, 2.0, 2.0 * 9.81 * 0.05
    roots = np.sort(np.roots([J, c, k]).real)
    made = campbell.section(material(loads(BRAKED)))
    assert made is not None
    found = plain(made.html)
    assert "has a stiffness in every direction" in found
    assert f"eigenvalues of {roots[0]:.4g}, {roots[1]:.4g} 1/s" in found
    assert "Nothing brings" not in found


TILTED_WHEEL = """
schema = 1
name = "ball"
gravity = [0, 0, -9.81]
[carrier]
mass = 1.3
center_of_mass = [0.004, -0.007, 0.06]
inertia = [[6e-3, 1e-4, 2e-4], [1e-4, 7e-3, -3e-4], [2e-4, -3e-4, 5e-3]]
inertia_about = "center_of_mass"
[hold]
freedoms = ["roll", "pitch", "yaw"]
pivot = [0.003, 0, 0.2]
[[flywheel]]
name = "w1"
position = [0.03, -0.02, 0.12]
axis = [0.1, 1, 0.2]
zero = [0, 0, 1]
mass = 0.25
spin_inertia = 4e-4
transverse_inertia = [2.2e-4, 2.6e-4]
unbalance = { static = 2e-5, dynamic = 3e-7, dynamic_at = 1.2 }
"""


def test_growth_of_the_mean_that_no_steady_motion_has_is_not_called_unstable() -> None:
    scene = scene_of(loads(TILTED_WHEEL))
    diagram = study.campbell(scene, np.linspace(0.0, 300.0, 31))
    assert diagram.growth.any()
    growth = compare_growth(scene, diagram)
    assert growth is not None and growth.unstable is None and growth.found >= 3
    assert growth.multiplier < 1.001
    assert "shows no instability" in campbell._growth(scene, diagram)
