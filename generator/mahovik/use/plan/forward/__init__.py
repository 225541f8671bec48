"""(8) integrated in time for given flywheel motions: rest, the carrier's course, and their derivatives."""

from mahovik.use.plan.forward.chart import Chart
from mahovik.use.plan.forward.course import Course, acceleration_rates, course, linearise, linearise_along
from mahovik.use.plan.forward.drive import Drive, drive
from mahovik.use.plan.forward.equilibrium import Equilibrium, equilibrium

__all__ = [
    "Chart",
    "Course",
    "Drive",
    "Equilibrium",
    "acceleration_rates",
    "course",
    "drive",
    "equilibrium",
    "linearise",
    "linearise_along",
]
