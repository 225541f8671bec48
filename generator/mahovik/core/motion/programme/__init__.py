"""Programmes: phi_s(t) of the flywheels that makes the carrier move as required. Files and evaluation."""

from mahovik.core.motion.programme.course import Angles, Fourier, Samples
from mahovik.core.motion.programme.model import Programme, RunUpTable
from mahovik.core.motion.programme.read import load_programme, read_programme
from mahovik.core.motion.programme.write import programme_text, save_programme

__all__ = [
    "Angles",
    "Fourier",
    "Programme",
    "RunUpTable",
    "Samples",
    "load_programme",
    "programme_text",
    "read_programme",
    "save_programme",
]
