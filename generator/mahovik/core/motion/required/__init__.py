"""Required motions of the carrier, q(t): the motion file, the motion with its derivatives, bounds and objective."""

from mahovik.core.motion.required.course import Course
from mahovik.core.motion.required.limits import with_winding
from mahovik.core.motion.required.model import Bounds, Objective, RequiredMotion, Winding
from mahovik.core.motion.required.read import load_motion, read_motion

__all__ = ["Bounds", "Course", "Objective", "RequiredMotion", "Winding", "load_motion", "read_motion", "with_winding"]
