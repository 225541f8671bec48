"""`--at rest|STATE.json`: the motion about which a stand is linearised."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from mahovik.errors import CheckError

if TYPE_CHECKING:
    from mahovik.core.stand.model import Stand
    from mahovik.core.stand.state import State

KEYS = ("id", "position", "angles", "quaternion", "V", "phi", "phi_dot", "phi_ddot", "wrench")
"""Keys of a state as `eval` reads it; V* and the drive torques follow from them."""

at_option = click.option(
    "--at", "at", metavar="rest|STATE.json", default="rest", show_default=True, help="The state, as `eval` reads it."
)


def nominal_state(stand: Stand, at: str) -> State:
    """The state that `--at` names. Raises UsageError, CheckError."""
    if at != "rest":
        from mahovik.use.simulate.start import load

        return load(Path(at), stand, KEYS, "; V_dot and tau follow from them")
    from mahovik.use.study.rest import rest

    try:
        return rest(stand).state
    except CheckError as error:
        raise CheckError(f"{error}; give a state by --at STATE.json") from None
