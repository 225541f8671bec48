"""The linear model of a stand about a state, A, B, C, D, and its modes."""

from mahovik.use.study.linear.model import Channel, LinearModel, linear_model
from mahovik.use.study.linear.modes import Mode, Modes, modes

__all__ = ["Channel", "LinearModel", "Mode", "Modes", "linear_model", "modes"]
