"""Example stands shipped with the package: `mahovik new NAME`, tests, generated/bench8."""

from __future__ import annotations

from pathlib import Path

from mahovik.errors import UsageError
from mahovik.nearest import suggestion

_FOLDER = Path(__file__).parent


def names() -> tuple[str, ...]:
    """Names of the example stands, sorted."""
    return tuple(sorted(file.stem for file in _FOLDER.glob("*.toml")))


def path(name: str) -> Path:
    """The stand file of an example. Raises UsageError for an unknown name."""
    if name not in names():
        raise UsageError(f'no example stand "{name}"{suggestion(name, names())}')
    return _FOLDER / f"{name}.toml"


def motions(name: str) -> tuple[Path, ...]:
    """The motion files that belong to an example (NAME.motion.json, NAME_*.motion.json), sorted."""
    path(name)
    return tuple(sorted([*_FOLDER.glob(f"{name}.motion.json"), *_FOLDER.glob(f"{name}_*.motion.json")]))


def servo_and_regime(name: str) -> dict[str, Path]:
    """The servo and the regime that belong to an example, if there are: "servo", "regime"."""
    path(name)
    files = {kind: _FOLDER / f"{kind}s" / f"{name}.toml" for kind in ("servo", "regime")}
    return {kind: file for kind, file in files.items() if file.is_file()}
