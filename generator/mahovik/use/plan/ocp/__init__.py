"""(13) as printed: optimal control with dependent flywheels, or with (12) as constraints.

Only `plan` imports CasADi, and only for the methods that need it.
"""

from mahovik.use.plan.ocp.partition import requested_partition

__all__ = ["requested_partition"]
