"""Public functions that the C has only where `generate --only` names them, so that other stands do not pay."""

from __future__ import annotations

from mahovik.contract.public_function import PublicFunction

_ROWS = (
    PublicFunction(
        "regressor",
        "Regressor",
        ("table", "mounting", "x", "V_dot", "phi_ddot"),
        ("Y_carrier", "Y_flywheel", "Y_drive", "Y_added_mass", "Y_linear", "Y_quadratic"),
        ("reference",),
    ),
    PublicFunction(
        "identify_step",
        "Regressor",
        ("table", "mounting", "x", "V_dot", "phi_ddot", "wrench", "noise", "forget", "estimate"),
        ("estimate",),
        ("reference",),
        needs="flywheels",
        python=False,
    ),
)

CHOSEN = {row.name: row for row in _ROWS}
"""Rows by name."""
