"""Required motions of the carrier, q(t): the motion file, the motion with its derivatives, bounds and objective."""

from mahovik.core.motion.course import Course
from mahovik.core.motion.required.limits import with_winding
from mahovik.core.motion.required.model import Bounds, Objective, RequiredMotion, Winding
from mahovik.core.motion.required.read import load_motion, load_motion_or_slew, read_motion, read_motion_or_slew
from mahovik.core.motion.required.slew import Slew

__all__ = [
    "Bounds",
    "Course",
    "Objective",
    "RequiredMotion",
    "Slew",
    "Winding",
    "load_motion",
    "load_motion_or_slew",
    "read_motion",
    "read_motion_or_slew",
    "with_winding",
]
