"""Small held stands: any hold, and wheels on its carrier."""

from __future__ import annotations

from mahovik.core.stand import Stand, loads

WHEEL = """
[[flywheel]]
name = "w{k}"
axis = {axis}
zero = {zero}
position = {position}
mass = 0.5
spin_inertia = 0.01
transverse_inertia = 0.006
unbalance = {{ static = "{unbalance} g m" }}
"""


def wheel(k: int, axis: list[int], unbalance: float = 0.0, position: tuple[float, ...] = (0, 0, 0)) -> str:
    zero = [0, 0, 1] if axis[2] == 0 else [0, 1, 0]
    return WHEEL.format(k=k, axis=axis, zero=zero, position=list(position), unbalance=unbalance)


def stand(hold: str, wheels: str, more: str = "", gravity: float = -9.81) -> Stand:
    return loads(f"""
schema = 1
name = "drawn"
gravity = [0, 0, {gravity}]
[carrier]
mass = 2.0
inertia = [0.02, 0.03, 0.01]
[hold]
{hold}
{more}
{wheels}
""")


HOLDS = (
    'freedoms = ["x", "z", "pitch"]\npivot = [0.01, 0, 0.05]',
    'freedoms = ["roll", "pitch", "yaw"]\npivot = [0.01, 0.02, 0.05]\nangles = [0.3, -0.2, 0.1]',
    'freedoms = ["z", "yaw"]\npivot = [0.03, 0, 0]\nposition = [1, 2, 3]',
    "basis = [[0, 0, 0.02, 0, 0, 1]]",
    "axis = [1, 1, 1]\npivot = [0, 0.02, 0]",
)
