"""Texts of a stand file with fins, propellers and strips, which the tests of these laws share."""

from __future__ import annotations

CARRIER = """
schema = 1
name = "vessel"
[carrier]
mass = 30.0
inertia = [0.2, 3.0, 3.0]
"""

STRIPS = """
[carrier.cross_flow]
density = 1025
x = [-0.7, 0, 0.7]
height = [0.1, 0.19, 0]
breadth = [0, 0.19, 0]
drag_y = 1.1
drag_z = [1.0, 1.1, 1.0]
"""

POD = """
[[instrument]]
name = "pod"
position = [0.3, 0, 0.2]
"""

RUDDER = """
[[fin]]
name = "rudder"
mount = "pod"
position = [-0.7, 0, 0.1]
span = [0, 0.1, -2]
density = 1025
area = 0.01
aspect = 3
stall = "15 deg"
drag = 0.01
"""

PROPELLER = """
[[propeller]]
name = "main"
position = ["-80 cm", 0, 0]
density = 1026
diameter = "14 cm"
thrust = [0.4566, -0.4174]
torque = [0.07, -0.0585]
"""
