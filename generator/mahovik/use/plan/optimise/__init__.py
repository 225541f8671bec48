"""(13): the programme that is best by the objective and inside the bounds, from a start that nearly solves (12)."""

from mahovik.use.plan.optimise.improve import Improved, finish, improve, judged, over, promise

__all__ = ["Improved", "finish", "improve", "judged", "over", "promise"]
