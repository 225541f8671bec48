"""The wrenches on one body by kind, and their sum."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from mahovik.proof.reference.array import Array

Kinds = Mapping[str, Array]
"""Wrench (6; N, N m) by its kind."""


def body_wrench(kinds: Kinds) -> Array:
    """P_k (6; N, N m): the sum over the kinds of wrench on one body, in its frame about its origin."""
    return np.asarray(sum(kinds.values(), np.zeros(6)))
