"""Renamed things since the release whose self-tests are in this folder, and a header that gives the old names."""

from __future__ import annotations

import re

FUNCTIONS = {"measure": "points", "target": "state_from_coordinates", "attitude": "generalized"}
"""Public functions, old name to new, without the name of the stand."""

NEW_STATUSES = {"step": ("COARSE",), "step_driven": ("COARSE",), "inverse": ("EXCESSIVE",)}
"""Positive statuses that a function did not have then: it returned the same without these bits, with equal results."""

STRUCTS = {
    "equations": "matrices_result",
    "momenta": "momentum_result",
    "generalized": "generalized_result",
    "reading": "points_result",
    "forward_slopes": "forward_jacobian_result",
    "coupled_slopes": "coupled_jacobian_result",
}
"""Structs likewise. Arguments need no entry."""

MEMBERS = {"I": "I_"}
"""Members of structs; the old self-tests use these words for nothing else."""


def shim(name: str, header: str) -> str:
    """A header with the old names of a stand, to be included before an old self-test; `header` is the new one.

    Structs are renamed by macros. Functions are constant pointers instead, since an old struct and a new function share
    a name: by macros `attitude` would become `generalized`, and that in turn `generalized_result`.
    """
    pointers = [_pointer(name, old, new, header) for old, new in FUNCTIONS.items() if f" {name}_{new}(" in header]
    wrapped = [_without(name, f, bits, header) for f, bits in NEW_STATUSES.items() if f" {name}_{f}(" in header]
    macros = [f"#define {name}_{old} {name}_{new}" for old, new in STRUCTS.items()]
    macros += [f"#define {old} {new}" for old, new in MEMBERS.items()]
    macros += [f"#define {name.upper()}_LANES 1"]  # which headers had then
    return "\n".join([f'#include "{name}.h"', *pointers, *wrapped, *macros, ""])


def _pointer(name: str, old: str, new: str, header: str) -> str:
    return f"static {name}_status (*const {name}_{old})({_arguments(name, new, header)}) = {name}_{new};"


def _without(name: str, function: str, statuses: tuple[str, ...], header: str) -> str:
    """A function that leaves the bits of new statuses out of what the one of today returns, and takes its place."""
    arguments = _arguments(name, function, header)
    given = ", ".join(re.findall(r"(\w+)(?:\[\w*\])?\s*(?:,|$)", arguments))
    new = " | ".join(f"{name.upper()}_{status}" for status in statuses)
    return (
        f"static {name}_status old_{function}({arguments})\n"
        f"{{\n    const {name}_status status = {name}_{function}({given});\n"
        f"    return (status > 0) ? ({name}_status)(status & ~({new})) : status;\n}}\n"
        f"#define {name}_{function} old_{function}"
    )


def _arguments(name: str, function: str, header: str) -> str:
    prototype = re.search(rf"^{name}_status {name}_{function}\((.*?)\);", header, re.DOTALL | re.MULTILINE)
    assert prototype is not None
    return prototype[1]
