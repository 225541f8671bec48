"""Renamed things since the release whose self-tests are in this folder, and a header that gives the old names."""

from __future__ import annotations

import re

FUNCTIONS = {"measure": "points", "target": "state_from_coordinates", "attitude": "generalized"}
"""Public functions, old name to new, without the name of the stand."""

STRUCTS = {
    "equations": "matrices_result",
    "momenta": "momentum_result",
    "generalized": "generalized_result",
    "reading": "points_result",
    "forward_slopes": "forward_jacobian_result",
    "coupled_slopes": "coupled_jacobian_result",
}
"""Structs likewise. Members and arguments need no entry: the self-tests use none that was renamed."""


def shim(name: str, header: str) -> str:
    """A header with the old names of a stand, to be included before an old self-test; `header` is the new one.

    Structs are renamed by macros. Functions are constant pointers instead, since an old struct and a new function share
    a name: by macros `attitude` would become `generalized`, and that in turn `generalized_result`.
    """
    pointers = [_pointer(name, old, new, header) for old, new in FUNCTIONS.items() if f" {name}_{new}(" in header]
    macros = [f"#define {name}_{old} {name}_{new}" for old, new in STRUCTS.items()]
    return "\n".join([f'#include "{name}.h"', *pointers, *macros, ""])


def _pointer(name: str, old: str, new: str, header: str) -> str:
    prototype = re.search(rf"^{name}_status {name}_{new}\((.*?)\);", header, re.DOTALL | re.MULTILINE)
    assert prototype is not None
    return f"static {name}_status (*const {name}_{old})({prototype[1]}) = {name}_{new};"
