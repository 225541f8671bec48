"""A rigid body without flywheels, as the text of a stand file, for tests of judges."""

BRICK = """
schema = 1
name = "brick"
gravity = [0, 0, 9.81]
[carrier]
mass = 4.0
center_of_mass = [0.01, -0.02, 0.03]
inertia = [0.2, 0.3, 0.4]
inertia_about = "center_of_mass"
"""
