"""Response to unbalanced flywheels at constant speeds: exact periodic steady states, spectra, sweeps."""

from mahovik.use.study.response.periodic import Periodic, periodic_response
from mahovik.use.study.response.scene import Scene
from mahovik.use.study.response.speeds import Turning, common_period

__all__ = ["Periodic", "Scene", "Turning", "common_period", "periodic_response"]
