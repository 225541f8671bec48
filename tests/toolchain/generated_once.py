"""C of a stand, made once a process for equal arguments."""

from __future__ import annotations

import pickle
from collections.abc import Callable
from dataclasses import replace
from functools import wraps
from inspect import signature
from typing import Any


def once(make: Callable[..., Any]) -> Callable[..., Any]:
    """`make`, whose results are remembered by their arguments, however passed; files of C are the caller's own."""
    known: dict[bytes, Any] = {}
    parameters = signature(make)

    @wraps(make)
    def remembered(*arguments: Any, **named: Any) -> Any:
        bound = parameters.bind(*arguments, **named)
        bound.apply_defaults()
        key = pickle.dumps(bound.arguments)
        if key not in known:
            known[key] = make(*arguments, **named)
        result = known[key]
        return replace(result, files=dict(result.files)) if hasattr(result, "files") else result

    return remembered


def install() -> None:
    """Generate once from now on."""
    from mahovik.core.emit import generate  # not before the process has chosen its threads

    generate.generate_all = once(generate.generate_all)
