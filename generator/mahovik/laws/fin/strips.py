"""Axes of a fin, for the C and for planning; referees make their own."""

from __future__ import annotations

from mahovik.core.stand.columns import hypot
from mahovik.core.stand.model import Vec3
from mahovik.laws.fin.data import Fin


def axes_of(fin: Fin) -> tuple[Vec3, Vec3, Vec3]:
    """Chord, span and normal of length one, at right angles, in the body's frame."""
    chord = _unit(fin.chord)
    normal = _unit(_cross(chord, _unit(fin.span)))
    return chord, _cross(normal, chord), normal


def _cross(a: Vec3, b: Vec3) -> Vec3:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def _unit(a: Vec3) -> Vec3:
    largest = max(abs(x) for x in a)  # first, so that squares neither overflow nor vanish
    x, y, z = (each / largest for each in a)
    length = hypot(x, y, z)
    return (x / length, y / length, z / length)
