"""The mechanics of a stand on NumPy columns: (2) to (12) for many moments at once, with exact derivatives.

`Mechanics.of(stand)`, then `prescribe(mechanics, course, bias)`, then `residual` or `linear` at the flywheels' angles;
`drive` and a `Chart` give the carrier's course by (8) under given flywheel motions.
"""

from mahovik.use.numeric.array import Array, Complex
from mahovik.use.numeric.by_carrier import ByCarrier, by_carrier, slopes_of_residual
from mahovik.use.numeric.evaluate import Linear, flywheel_damping, flywheel_wrenches, linear, residual, torques
from mahovik.use.numeric.flywheels import waves
from mahovik.use.numeric.forward import (
    INTERVALS,
    BlockElimination,
    CarrierCourse,
    Chart,
    Drive,
    Equilibrium,
    acceleration_rates,
    course,
    drive,
    equilibrium,
    integrate,
    linearise,
    linearise_along,
)
from mahovik.use.numeric.held_chart import HeldChart, chart_at
from mahovik.use.numeric.held_kinematics import held_pose, held_slopes, held_twists
from mahovik.use.numeric.kinematics import Twists, in_E1, twists
from mahovik.use.numeric.prescribed_motion import Mechanics, Norm, PrescribedMotion, able_at, prescribe, prescribed_at
from mahovik.use.numeric.se3 import (
    attitude,
    block_diagonal,
    fixed_axes,
    flywheel_transfer,
    inertia,
    motor_cross,
    mount_axes,
    place,
    rotation_vector_rate,
    skew,
    transfer,
    turn,
)
from mahovik.use.numeric.stream import uniform_stream

__all__ = [
    "INTERVALS",
    "Array",
    "BlockElimination",
    "ByCarrier",
    "CarrierCourse",
    "Chart",
    "Complex",
    "Drive",
    "Equilibrium",
    "HeldChart",
    "Linear",
    "Mechanics",
    "Norm",
    "PrescribedMotion",
    "Twists",
    "able_at",
    "acceleration_rates",
    "attitude",
    "block_diagonal",
    "by_carrier",
    "chart_at",
    "course",
    "drive",
    "equilibrium",
    "fixed_axes",
    "flywheel_damping",
    "flywheel_transfer",
    "flywheel_wrenches",
    "held_pose",
    "held_slopes",
    "held_twists",
    "in_E1",
    "inertia",
    "integrate",
    "linear",
    "linearise",
    "linearise_along",
    "motor_cross",
    "mount_axes",
    "place",
    "prescribe",
    "prescribed_at",
    "residual",
    "rotation_vector_rate",
    "skew",
    "slopes_of_residual",
    "torques",
    "transfer",
    "turn",
    "twists",
    "uniform_stream",
    "waves",
]
