"""Stands with closed forms: one wheel in the middle of a carrier, its axis along z of E1."""

from __future__ import annotations

from pathlib import Path

from mahovik.core.stand import Stand, load

M_CARRIER, M_WHEEL, J_TRANSVERSE, J_SPIN = 40.0, 2.0, 3.0, 0.02

HEAD = f"""
schema = 1
name = "one"
[carrier]
mass = {M_CARRIER}
inertia = [{J_TRANSVERSE}, {J_TRANSVERSE}, 2.0]
[[point]]
name = "eye"
angles = ["90 deg", 0, 0]
"""

WHEEL = """
[[flywheel]]
name = "w"
axis = [0, 0, 1]
zero = [1, 0, 0]
mass = {mass}
spin_inertia = {spin}
transverse_inertia = 0.011
unbalance = {{ {unbalance} }}
"""


def one_wheel(folder: Path, unbalance: str, more: str = "") -> Stand:
    """The stand with a wheel of this unbalance, and more tables."""
    file = folder / "one.toml"
    file.write_text(HEAD + WHEEL.format(mass=M_WHEEL, spin=J_SPIN, unbalance=unbalance) + more)
    return load(file)
