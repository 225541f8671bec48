"""(13) as printed: optimal control with six flywheels that follow from the others, or with (12) as constraints.

CasADi is imported by `plan` alone, when a method asks for it.
"""

from mahovik.use.plan.ocp.asked import plus_asked

__all__ = ["plus_asked"]
