"""Jitter of a point under flywheels at any speeds: lines of every wheel and order, and of their combinations."""

from mahovik.use.study.jitter.balance import Balance, balance
from mahovik.use.study.jitter.chain import Makers
from mahovik.use.study.jitter.freedom_view import FreedomView
from mahovik.use.study.jitter.lines import LineName, Lines
from mahovik.use.study.jitter.load_view import LoadView
from mahovik.use.study.jitter.quantity import View
from mahovik.use.study.jitter.study import Jitter, jitter

__all__ = ["Balance", "FreedomView", "Jitter", "LineName", "Lines", "LoadView", "Makers", "View", "balance", "jitter"]
