"""Stands for tests of laws: texts of a vessel, and random stands that bear the laws of each kind."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mahovik.core.stand import Stand, loads
from mahovik.core.stand.model import Law
from mahovik.core.stand.random import Features, random_stand
from mahovik.laws.cross_flow.law import CrossFlow
from mahovik.laws.damping.law import Damping
from mahovik.laws.fading.law import FadingDamping
from mahovik.laws.fin.law import Fin, Fins
from mahovik.laws.propeller.law import Propeller, Propellers

CARRIER = """
schema = 1
name = "vessel"
[carrier]
mass = 30.0
inertia = [0.2, 3.0, 3.0]
"""

POD = """
[[instrument]]
name = "pod"
position = [0.3, 0, 0.2]
"""

STRIPS = """
[carrier.cross_flow]
density = "1025 kg/m^3"
x = ["-70 cm", 0, 0.7]
height = { value = [0, 19, 0], unit = "cm" }
breadth = [0, 0.19, 0]
drag_y = 1.1
drag_z = [1.0, 1.1, 1.0]
"""

FADING = """
[carrier.fading_damping]
linear = ["2 N s/m", 20, 20, 0.1, 3, 3]
rate = "3 s/m"
"""

FINS = """
[[fin]]
name = "hull"
density = "1025 kg/m^3"
area = 0.2
aspect = 0.5
drag = 0.2
speed = "whole"
[[fin]]
name = "stern"
position = [-0.7, 0, 0]
density = 1025
area = "100 cm^2"
lift_slope = 0.7
induced = 1.43
deflection = "10 deg"
incidence = false
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

PROPELLERS = """
[[propeller]]
name = "main"
position = ["-80 cm", 0, 0]
density = 1026
diameter = "14 cm"
thrust = [0.4566, -0.4174]
torque = [0.07, -0.0585]
speed = "1500 rpm"
wake = 0.056
deduction = 0.1
whole = true
left = true
[[propeller]]
name = "bow"
mount = "pod"
axis = [0, 2, 0]
density = "1026 kg/m^3"
diameter = 0.1
thrust = [0.4, -0.3, -0.1]
"""

TORQUERS = """
schema = 1
name = "compass"
magnetic_field = ["20 uT", 0, "-40 uT"]
[carrier]
mass = 3.0
inertia = [0.1, 0.2, 0.25]
[[instrument]]
name = "boom"
angles = ["90 deg", 0, 0]
[[torquer]]
name = "mx"
dipole = [2.0, 0, 0]
[[torquer]]
name = "my"
mount = "boom"
dipole = { value = [3.0, 0, 0], unit = "A m^2" }
"""

KEY = 'derivatives = "with added-mass products"'

PRODUCTS = f"""
schema = 1
name = "slender"
[carrier]
mass = 30.0
inertia = [0.2, 3.0, 3.0]
added_mass = [1, 30, 31, 0.1, 4, 5]
[carrier.damping]
terms = [{{ wrench = "X", of = ["w", "q"], value = -31.2 }}, {{ wrench = "N", of = ["u", "v"], value = -29.0 }}]
{KEY}
"""

CONTROL = (
    CARRIER
    + """
[carrier.control_derivatives]
race = 2e-4
terms = [
    { wrench = "X", of = ["u", "r", "rudder.deflection"], value = -3.1 },
    { wrench = "Y", of = ["u", "|v|", "|rudder.deflection|", "main.race"], value = "2.5 N s^3/m^3" },
    { wrench = "N", of = ["|main.speed|", "main.speed"], value = 1e-4 },
    { wrench = "Z", of = ["w", "w", "w"], value = -4.2 },
    { wrench = "K", of = ["p", "|main.race|"], value = -0.3 },
]
"""
    + POD
    + """
[[fin]]
name = "rudder"
density = 1025
area = 0.01
lift_slope = 2.0
incidence = false
deflection = 0.2
[[propeller]]
name = "main"
position = ["-80 cm", 0, 0]
density = 1026
diameter = "14 cm"
thrust = [0.4566, -0.4174]
torque = [0.07, -0.0585]
speed = 90.0
"""
)

TEXTS = {
    "control": CONTROL,
    "fading": CARRIER + FADING,
    "strips": CARRIER + STRIPS,
    "fins": CARRIER + POD + FINS,
    "propellers": CARRIER + POD + PROPELLERS,
    "torquers": TORQUERS,
    "products": PRODUCTS,
}
"""A stand file with each law."""

FADES = FadingDamping(
    tuple(tuple(20.0 * (i == j) + 0.7 * (i - 2 * j + 0.3 * i * j) for j in range(6)) for i in range(6)),  # type: ignore[arg-type]
    1.7,
)
SLENDER = CrossFlow(
    1025.0, (-0.8, -0.2, 0.3, 0.9), (0.1, 0.3, 0.25, 0.05), (0.12, 0.28, 0.22, 0.06), (1.1, 1.2, 1.0, 0.9),
    (0.8, 0.9, 0.7, 0.6), 2, together=False,
)  # fmt: skip
RUDDER = Fin(
    "rudder", (-0.7, 0.2, 0.1), (2.0, 0.1, 0.0), (0.1, 0.3, -1.0), 1025.0, 0.02, 3.1, 0.02, 0.15, 0.3, 0.1, "across",
    incidence=True,
)  # fmt: skip
HULL = replace(RUDDER, name="hull", position=(0.1, 0.0, 0.0), span=(0.0, 1.0, 0.0), stall=None, speed="whole")
PLANE = replace(RUDDER, name="plane", incidence=False, stall=None, speed="along", deflection=-0.2)
MAIN = Propeller(
    "main", (-0.8, 0.1, 0.05), (2.0, 0.1, 0.2), 1026.0, 0.14, (0.46, -0.42, -0.1), (0.07, -0.06, 0.01), 150.0,
    0.06, 0.1, whole=False, left=False,
)  # fmt: skip
WHOLE = replace(MAIN, name="whole", position=(0.1, 0.3, 0.0), speed=-90.0, whole=True, left=True)
STILL = replace(MAIN, name="still", axis=(0.0, 1.0, 0.0), speed=0.0)


def bearing(law: str, seed: int = 1) -> Stand:
    """A random stand with a law of a kind on its bodies; "all" has every kind."""
    features = Features(instruments=1)
    if law in ("torquers", "all"):
        features = replace(features, instruments=2, laws={"suspension": 0, "leg": 0, "torquer": 3})
    if law in ("products", "all"):
        features = replace(features, fluid=True, stream=True)
    stand = random_stand(np.random.default_rng(seed), 2, features)
    carrier: list[Law] = list(stand.carrier.laws) if law == "products" else []
    further: list[Law] = []
    if law in ("products", "all"):
        damping = stand.carrier.law(Damping) or Damping(None, None, ())
        carrier = [replace(damping, contains_products=True)]
    if law in ("control", "all"):
        carrier += loads(CONTROL).carrier.laws
    if law in ("fading", "all"):
        carrier.append(FADES)
        further.append(replace(FADES, rate=0.4))
    if law in ("strips", "all"):
        carrier.append(SLENDER)
        further.append(replace(SLENDER, together=True))
    if law == "fins":
        carrier.append(Fins((RUDDER, HULL)))
    if law in ("fins", "all"):
        further.append(Fins((PLANE, replace(RUDDER, name="tab"))))
    if law == "propellers":
        carrier.append(Propellers((MAIN, WHOLE)))
    if law in ("propellers", "all"):
        further.append(Propellers((replace(STILL, speed=20.0), replace(WHOLE, name="aft"))))
    return replace(
        stand,
        carrier=stand.carrier.with_laws(*carrier),
        instruments=tuple(body.with_laws(*further) for body in stand.instruments[:1]) + stand.instruments[1:],
    )
