"""Stands in Python: read from files, made of a mapping, edited by path; the example stands; what notebooks show."""

from __future__ import annotations

from collections.abc import Mapping
from copy import deepcopy
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mahovik import stands
from mahovik.core.stand import stand_file
from mahovik.core.stand.model import Stand as CoreStand
from mahovik.core.stand.numbers import exact, put
from mahovik.core.stand.stand_file import document_at, read
from mahovik.out.arguments import expecting
from mahovik.signatures import checked


@dataclass(frozen=True, repr=False)
class Stand(CoreStand):
    """A stand: data in SI, checked; its file's keys can be changed by path, with units."""

    @staticmethod
    @checked
    def from_dict(document: Mapping[str, Any], source: str = "stand") -> Stand:
        """The stand of a mapping with the keys of a stand file; numbers, or texts with a unit, as there.

        `source` names it in messages. NumPy arrays count as lists. Raises StandError with every problem.
        """
        return _read(exact(document), source)

    @staticmethod
    @checked
    def of(stand: CoreStand | Mapping[str, Any] | str | Path) -> Stand:
        """A stand as it is, or the one of a file or of a mapping with its keys. Raises StandError."""
        if isinstance(stand, Mapping):
            return Stand.from_dict(stand)
        if not isinstance(stand, CoreStand):
            stand = load(stand)
        if isinstance(stand, Stand):
            return stand
        return Stand(**vars(stand))

    def to_dict(self) -> dict[str, Any]:
        """The keys of its file, as they were given; of a stand that Python code made, all in SI."""
        document: dict[str, Any] | None = self.__dict__.get("_document")
        return deepcopy(document) if document is not None else exact(stand_file.document_of(self))

    @checked
    def replace(self, changes: Mapping[str, Any]) -> Stand:
        """The stand with other values: `{"w1.unbalance.static": "2 g mm", "carrier.mass": 13.0, "gravity[2]": 0}`.

        A path begins with the name of a body, point or law's part, or with a key of the file; keys follow, and places
        in lists, from 0: `carrier.center_of_mass[0]`, `leg[0].stiffness`, `w1.inertia.J12`; `w*.mass` is that of each
        body whose name matches. The value None takes the key away. A flywheel that its file gives by centre of
        mass and inertia takes `unbalance` too: its axial offset and its moments of inertia about the origin stay.
        Numbers of `unbalance` are set last, so a static unbalance is as given whatever mass is set beside it.
        Raises UsageError for a path that leads nowhere, StandError with every problem of the result.
        """
        document = self.to_dict()
        put(document, changes)
        return _read(document, self.name)

    @checked
    def save(self, path: str | Path) -> None:
        """Write it as a stand file, in SI, with every digit. Raises UsageError."""
        from mahovik.writing import write

        write(Path(path), stand_file.dumps(self))

    def _repr_html_(self) -> str:
        from mahovik.core.stand.summary import summarize
        from mahovik.out.result import Result, columns_of

        summary = summarize(self)
        bodies = {"name": "", "kind": "", "mount": "", "mass": "kg", "center_of_mass": "m"}
        unbalance = {"name": "", "spin_inertia": "kg m2", "static": "kg m", "dynamic": "kg m2"}
        return Result(
            f"{repr(self).strip('<>')}, {summary.mass:.6g} kg",
            columns_of(summary.bodies, bodies, {"center_of_mass": ("x", "y", "z")}),
            meta={"unbalance": Result("unbalance", columns_of(summary.unbalance, unbalance))},
        )._repr_html_()


@checked
def load(path: str | Path) -> Stand:
    """The stand of a stand file, checked and in SI. Raises StandError with every problem of the file."""
    with expecting("stand", path):
        return _read(document_at(path), Path(path).name)


def examples() -> tuple[str, ...]:
    """Names of the example stands."""
    return stands.names()


def example(name: str) -> Stand:
    """An example stand by its name. Raises UsageError for an unknown one."""
    return load(stands.path(name))


def _read(document: dict[str, Any], source: str) -> Stand:
    """The stand, which remembers its keys; a copy by `dataclasses.replace` does not, so they are never out of date."""
    stand = Stand.of(read(document, source))
    object.__setattr__(stand, "_document", document)
    return stand
