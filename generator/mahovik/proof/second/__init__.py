"""The second derivation: energies body by body, differentiated by CasADi. It differs from the others in kind."""

from mahovik.proof.second.system import Second

__all__ = ["Second"]
