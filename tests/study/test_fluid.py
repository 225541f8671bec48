"""Passivity and course in a fluid: what drives is found from the speed on at which it does; growth as by hand."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from cli.run import refused, run
from mahovik.core.stand import Stand, loads
from mahovik.use.study.fluid import added_mass, fluid, growth

HEAD = """
schema = 1
name = "hull"
gravity = [0, 0, 9.81]
[carrier]
mass = 20.0
inertia = [0.3, 2.0, 2.0]
added_mass = [2, 25, 24, 0, 1.5, 1.5]
"""


def hull(damping: str) -> Stand:
    return loads(f"{HEAD}[carrier.damping]\n{damping}\n")


def test_matrices_that_damp_are_passive() -> None:
    """A linear part that is not symmetric, but its symmetric part is definite."""
    rows = np.diag([3.0, 9.0, 9.0, 0.2, 2.0, 2.0])
    rows[1, 5], rows[5, 1] = 4.0, -4.0
    found = fluid(hull(f"linear = {rows.tolist()}\nquadratic = [5, 50, 50, 0.1, 5, 5]"), 1.0)
    assert [(p.ahead, p.positive, math.isinf(p.speed)) for p in found.powers] == [
        (False, False, True),
        (True, False, True),
    ]
    # Y = -30 u v has the power -30 u v^2: it damps ahead and drives astern
    astern, ahead = fluid(hull('terms = [{ wrench = "Y", of = ["u", "v"], value = -30 }]'), 1.0).powers
    assert astern.positive and astern.twist[0] < 0 and not ahead.positive


@pytest.mark.parametrize("damping", ["", 'derivatives = "with added-mass products"'])
def test_growth_by_the_moment_of_munk(damping: str) -> None:
    """(m + L22) v' = -(m + L11) U r and (J + L66) r' = (L11 - L22) U v without damping.

    With the key only -m U r is left, which makes no motion grow.
    """
    U = 1.5
    expected = U * math.sqrt((20 + 2) * (25 - 2) / ((20 + 25) * (2.0 + 1.5))) if not damping else 0.0
    assert growth(hull(damping), U) == pytest.approx(expected, rel=1e-6, abs=1e-4)


def test_course_by_the_stability_roots() -> None:
    """Sway and yaw of (M) x' = (N) x with published derivatives, as in a handbook of ship motion."""
    Yv, Yr, Nv, Nr, U = -60.0, 8.0, -3.0, -40.0, 2.0
    terms = ", ".join(
        f'{{ wrench = "{w}", of = ["u", "{x}"], value = {value} }}'
        for w, x, value in (("Y", "v", Yv), ("Y", "r", Yr), ("N", "v", Nv), ("N", "r", Nr), ("Z", "w", -90.0))
    )
    others = '{ wrench = "M", of = ["u", "q"], value = -50 }, { wrench = "X", of = ["u", "|u|"], value = -9 }'
    key = 'derivatives = "with added-mass products"'
    stand = hull(f"terms = [{terms}, {others}]\n{key}")
    M = np.diag([45.0, 3.5])
    N = U * np.array([[Yv, Yr - 20.0], [Nv, Nr]])
    roots = np.linalg.eigvals(np.linalg.solve(M, N)).real
    assert roots.max() < 0
    assert growth(stand, U) == pytest.approx(max(roots.max(), 0.0), abs=1e-4)  # roll is neutral
    unstable = hull(f"terms = [{terms.replace('-3.0', '-300.0')}, {others}]\n{key}")
    N[1, 0] = -300.0 * U
    assert growth(unstable, U) == pytest.approx(np.linalg.eigvals(np.linalg.solve(M, N)).real.max(), rel=1e-6)


def test_added_mass_of_all_bodies() -> None:
    instrument = '[[instrument]]\nname = "fin"\nadded_mass = [1, 0, 2, 0, 0, 0]\n'
    found = added_mass(loads(HEAD + instrument))
    assert found is not None
    assert (found.rows, found.sway, found.heave) == (5, 3.0 - 25.0, 26.0 - 3.0)
    assert found.least == pytest.approx(1.0)
    assert added_mass(loads(HEAD.split("added_mass", maxsplit=1)[0])) is None


def test_check_prints_it(tmp_path: Path) -> None:
    file = tmp_path / "hull.toml"
    file.write_text(f'{HEAD}[carrier.damping]\nterms = [{{ wrench = "Y", of = ["u", "v"], value = -30 }}]\n')
    text = run("check", str(file), "--fluid", "1.5").stdout
    assert "moment of Munk -23 kg u v about z, 22 kg u w about y" in text and "semidefinite" not in text
    for wrong, words in (("0", "out of range"), ("1 kg", "expected a velocity"), ("nan", "out of range")):
        message = refused("check", str(file), "--fluid", wrong)
        assert message.startswith("error: --fluid: ")
        assert words in message


def test_check_warns_of_fins_without_stall_and_of_fading_damping_that_drives(tmp_path: Path) -> None:
    file = tmp_path / "hull.toml"
    fin = '[[fin]]\nname = "rudder"\ndensity = 1025\narea = 0.01\naspect = 3.0\n'
    fading = "[carrier]\nfading_damping = { linear = [3, -9, 9, 0.2, 2, 2], rate = 3 }\n"
    body = HEAD.replace("[carrier]\n", fading, 1)
    assert body != HEAD
    file.write_text(body + fin, encoding="utf-8")
    text = " ".join(run("check", str(file)).stdout.split())
    assert "warning: fin rudder: without `stall`" in text
    assert "warning: carrier: fading_damping.linear has -9 for v: it drives" in text
    file.write_text(body.replace("-9", "9") + fin + 'stall = "15 deg"\n', encoding="utf-8")
    text = run("check", str(file)).stdout
    assert "stall" not in text
    assert "drives" not in text


def test_a_propeller_is_an_engine_and_no_damping(tmp_path: Path) -> None:
    """The report has the thrust, which does work from the first speed on, apart from the damping, which does none."""
    propeller = """
[[propeller]]
name = "main"
density = 1025
diameter = 0.14
thrust = [0.45, -0.4]
speed = "1500 rpm"
"""
    passive = "[carrier.damping]\nlinear = [3, 9, 9, 0.2, 2, 2]\n"
    found = fluid(loads(HEAD + passive + propeller), 1.5)
    assert found.engines == ("carrier",) and [power.positive for power in found.powers] == [False, False]
    assert fluid(loads(HEAD + passive), 1.5).engines == ()
    file = tmp_path / "hull.toml"
    file.write_text(HEAD + propeller, encoding="utf-8")
    text = run("check", str(file), "--fluid", "1.5").stdout
    assert "no body has a law of its twist relative to the fluid but propellers" in text
    assert "propellers on carrier: they are there to drive" in text
