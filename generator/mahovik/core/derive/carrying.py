"""The steps that carry a generic body's inertia from its frame to E1, and its weight (7), in the symbols of programs.

m, b, J: mass, first moment and inertia about the body's origin; O, R: that origin and the body's axes in E1.
"""

from __future__ import annotations

import sympy as sp

from mahovik.core.derive import flywheel
from mahovik.core.derive.screw import cross, elementary, matrix, six_of, symmetric, vector


def harmonics() -> dict[str, flywheel.Inertia]:
    """Harmonics of Theta(phi) of a generic flywheel, in mounting axes about Os."""
    return flywheel.spun_inertia(flywheel.generic())


def rotated_tensor() -> tuple[sp.Matrix, sp.Matrix]:
    """R J as 9 numbers, and R J R^T as six from symbols RJ."""
    return flywheel.rotated_tensor(symmetric("J"), matrix("R"))


def shifted_inertia() -> tuple[sp.Matrix, sp.Matrix]:
    """(mu, six of J) of T Theta T^T: the same body about O1, the latter by the symbols mu."""
    return flywheel.shifted_inertia(sp.Symbol("m"), vector("b"), symmetric("J"), vector("O"))


def spin_momentum() -> sp.Matrix:
    """Moment of I_s about O1 for the spin axis `axis` in E1."""
    return flywheel.spin_momentum(vector("b"), symmetric("J"), vector("O"))


def central_to_origin() -> sp.Matrix:
    """Inertia about the body's origin from J about its centre of mass rc = b / m: J - <b><rc>, without a division."""
    return six_of(symmetric("J") - cross(vector("b")) * cross(vector("rc")))


def mounting_axes() -> tuple[sp.Matrix, sp.Matrix]:
    """First and second column of C3(psi) C2(theta) C1(phi), in c_psi, s_psi, ..."""
    psi, theta, phi = symbols = sp.symbols("psi theta phi")
    C = elementary(3, psi) * elementary(2, theta) * elementary(1, phi)
    for angle in symbols:
        C = C.subs({sp.cos(angle): sp.Symbol(f"c_{angle}"), sp.sin(angle): sp.Symbol(f"s_{angle}")})
    return C[:, 0], C[:, 1]


def weight(displaces: bool) -> sp.Matrix:
    """Weight of every body and Archimedes force: (m g, mu x g) minus those of the displaced fluid.

    g = gravity in E1; mu at the phases of the flywheels: the line of action of a flywheel's weight moves with it.
    """
    g, m, moment = vector("g"), sp.Symbol("m"), vector("mu")
    if displaces:
        m = sp.Symbol("weight_mass")
        moment = moment - vector("displaced_moment")
    return (m * g).col_join(cross(moment) * g)


def weight_reaction(displaces: bool) -> sp.Matrix:
    """Load of weight and Archimedes force on the mount: the negative of `weight`."""
    return -weight(displaces)
