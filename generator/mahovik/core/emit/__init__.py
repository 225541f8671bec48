"""C text of a program: the only place that knows C syntax. No mechanics here."""

from mahovik.core.emit.generate import generate

__all__ = ["generate"]
