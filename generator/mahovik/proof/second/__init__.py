"""The second derivation: energies body by body, differentiated by CasADi. It shares no formula with the others."""

from mahovik.proof.second.evaluate import Second, evaluate

__all__ = ["Second", "evaluate"]
