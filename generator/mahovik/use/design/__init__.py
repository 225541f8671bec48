"""Design: positions, mountings, unbalances of flywheels chosen together with the programme, for a required motion."""

from mahovik.use.design.designer import DesignOptions, design_stand
from mahovik.use.design.freedom import Freedom
from mahovik.use.design.outcome import Outcome
from mahovik.use.design.read import freedom_of_keys, load_freedom

__all__ = ["DesignOptions", "Freedom", "Outcome", "design_stand", "freedom_of_keys", "load_freedom"]
