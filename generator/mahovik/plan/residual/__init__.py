"""The residual of (12) for whole motions at once, vectorised, with exact derivatives; torques; the norm.

`Mechanics.of(stand)`, then `prescribe(mechanics, course, bias)`, then `residual` or `linear` at the flywheels' angles.
"""

from mahovik.plan.residual.evaluate import Linear, linear, residual, torques
from mahovik.plan.residual.norm import Norm
from mahovik.plan.residual.prescribed import Mechanics, Prescribed, prescribe

__all__ = ["Linear", "Mechanics", "Norm", "Prescribed", "linear", "prescribe", "residual", "torques"]
