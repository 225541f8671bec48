"""(8) forward in time for given flywheel motions: rest, the carrier's course, how both change with those motions."""

from mahovik.use.plan.forward.chart import Chart
from mahovik.use.plan.forward.course import Course, along, course, linearise, pushes
from mahovik.use.plan.forward.drive import Drive, drive
from mahovik.use.plan.forward.equilibrium import Equilibrium, equilibrium

__all__ = [
    "Chart",
    "Course",
    "Drive",
    "Equilibrium",
    "along",
    "course",
    "drive",
    "equilibrium",
    "linearise",
    "pushes",
]
