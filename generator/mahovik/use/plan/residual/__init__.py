"""The residual of (12) for whole motions at once, vectorised, with exact derivatives; torques; the norm.

`Mechanics.of(stand)`, then `prescribe(mechanics, course, bias)`, then `residual` or `linear` at the flywheels' angles;
`by_design` gives the derivatives by positions, mountings and mass properties of the flywheels.
"""

from mahovik.use.plan.residual.by_design import PARAMETERS, DesignRates, by_design
from mahovik.use.plan.residual.evaluate import Linear, linear, residual, torques
from mahovik.use.plan.residual.prescribed_motion import Mechanics, Norm, PrescribedMotion, prescribe

__all__ = [
    "PARAMETERS",
    "DesignRates",
    "Linear",
    "Mechanics",
    "Norm",
    "PrescribedMotion",
    "by_design",
    "linear",
    "prescribe",
    "residual",
    "torques",
]
