"""Rotations: C of a quaternion, C a and C^T a."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import Any

from mahovik.core.formula.derived import attitude as derived
from mahovik.core.formula.derived import wrench as derived_wrench
from mahovik.core.lower.symbolic import assign, translate
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind


def rotation() -> Function:
    """Rotation matrix of a quaternion of any length."""
    q = Argument("q", Kind.REAL, (4,), purpose="quaternion, w first")
    C = Argument("C", Kind.REAL, (9,), "out", purpose="x0 = C x1, row by row")
    body = Body()
    p = q.place
    k = body.let("k", 2 / (p[0] * p[0] + p[1] * p[1] + p[2] * p[2] + p[3] * p[3]))
    assign(body, list(C.place), derived.rotation_of_quaternion(), {"q": p, "k": k})
    return body.function("rotation", "Rotation matrix of a quaternion of any length: no square root is needed.", (q, C))


def turn_back() -> Function:
    """C^T a of a quaternion of any length, without C."""
    q = Argument("q", Kind.REAL, (4,), purpose="quaternion, w first")
    a = Argument("a", Kind.REAL, (3,))
    out = Argument("out", Kind.REAL, (3,), "out", purpose="must not overlap a")
    body, p = Body(), q.place
    k = body.let("k", 2 / (p[0] * p[0] + p[1] * p[1] + p[2] * p[2] + p[3] * p[3]))
    half = [body.let(f"t{i + 1}", translate(x, {"q": p, "a": a.place})) for i, x in enumerate(derived.half_rotation())]
    assign(body, list(out.place), derived.inverse_rotation(), {"q": p, "a": a.place, "t": half, "k": k})
    function = body.function("turn_back", "C^T a of a quaternion of any length: no matrix is needed.", (q, a, out))
    return replace(function, short=True)


def rotate_back() -> Function:
    """C^T a."""
    purpose = "C^T a: components from the outer axes to the rotated axes."
    return _rotation_function("rotate_back", purpose, derived_wrench.rotated_back())


def rotate() -> Function:
    """C a."""
    return _rotation_function("rotate", "C a: from the turned axes to the outer ones.", derived_wrench.rotated())


def _rotation_function(name: str, purpose: str, formula: Iterable[Any]) -> Function:
    C = Argument("C", Kind.REAL, (9,))
    a = Argument("a", Kind.REAL, (3,))
    out = Argument("out", Kind.REAL, (3,), "out", purpose="must not overlap a")
    body = Body()
    assign(body, list(out.place), formula, {"C": C.place, "a": a.place})
    return body.function(name, purpose, (C, a, out))
