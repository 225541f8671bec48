"""All audits, in the order of the page."""

from __future__ import annotations

from audits import gazebo, held, npsauv
from audits.audit import Audit

AUDITS: dict[str, Audit] = {each.name: each for of in (npsauv, gazebo, held) for each in of.AUDITS}
"""Audits by name."""
