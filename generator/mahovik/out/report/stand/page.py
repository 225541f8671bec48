"""Puts the sections of a report in their order, on one page that needs no network."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from importlib import import_module

from mahovik import __version__
from mahovik.core.emit.generate import describe_bodies
from mahovik.core.emit.templates import source_text, template
from mahovik.core.stand.identity import identities
from mahovik.core.toolchain.process import side_by_side
from mahovik.out.report.stand.material import Material, Section, generate_once

ORDER = (
    "histories",
    "programme",
    "hold",
    "response",
    "jitter",
    "reach",
    "envelopes",
    "campbell",
    "bodies",
    "drawing",
    "singular",
    "matrices",
    "verification",
    "cost",
)
"""Modules of this folder, each with a function `section`, in the order of the page: motion, stand, evidence."""

BESIDE = ("verification", "cost")
"""Sections that wait for compilers, made in parallel with the others."""


@dataclass(frozen=True)
class Page:
    """The page and what it shows as failed, a line each."""

    html: str
    failures: tuple[str, ...]


def page(material: Material, made: Callable[[int], None] = lambda count: None) -> Page:
    """The report of a stand. The same material gives the same bytes. `made` hears how many sections of `ORDER` are."""
    found = _sections(material, made)
    failures = tuple(line for each in found for line in each.failures)
    names = identities(material.stand)
    html = template("report.html.j2").render(
        name=material.stand.name,
        uplot=source_text("uplot/uPlot.iife.min.js").partition("\n")[2],  # without the line of its address
        bodies=describe_bodies(material.stand),
        structure=names.structure,
        physics=names.physics,
        version=__version__,
        files=_files(material),
        failures=failures,
        summaries=[each for each in found if each.summary],
        sections=found,
    )
    return Page(html, failures)


def _sections(material: Material, tell: Callable[[int], None]) -> list[Section]:
    """Sections with content, in their order."""
    done: list[str] = []

    def section(name: str) -> Section | None:
        found: Section | None = make[name](material)
        done.append(name)
        tell(len(done))
        return found

    make = {name: import_module(f"mahovik.out.report.stand.{name}").section for name in ORDER}
    generate_once(material.stand)
    with side_by_side() as pool:
        beside = {name: pool.submit(section, name) for name in BESIDE if name in make}
        made = {name: section(name) for name in ORDER if name not in beside}
        made |= {name: task.result() for name, task in beside.items()}
    return [each for name in ORDER if (each := made[name]) is not None]


def _files(material: Material) -> list[tuple[str, str]]:
    """Sources of the report: kind and name of each file."""
    run = "" if material.run is None else material.run.source
    given = (
        ("stand", material.stand_file),
        ("run", run),
        ("programme", material.programme_file),
        ("motion", material.motion_file),
    )
    return [(kind, name) for kind, name in given if name]
