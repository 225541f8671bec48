"""A symbol by which the linker notices that a caller's header and the source do not belong together."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from mahovik import __version__
from mahovik.core.lower.golden import fnv1a
from mahovik.core.stand.identity import Identities

_SECTION = ".debug_mahovik"
"""Linkers keep sections of this kind with --gc-sections and resolve their symbols; none of it is loaded."""


@dataclass(frozen=True)
class Link:
    """Statements of C that refer to the symbol, by the width of an address, and the one that defines it.

    `macros`: prefix of the macros of the check; `noticed`: what callers and source must have in common, in words.
    """

    symbol: str
    macros: str
    noticed: str

    @property
    def of_64_bits(self) -> str:
        """Reference of an address of 64 bits."""
        return self._reference(".quad")

    @property
    def of_32_bits(self) -> str:
        """Reference of an address of 32 bits."""
        return self._reference(".long")

    @property
    def definition(self) -> str:
        """Definition as a number, in no section: it needs no memory, and no linker removes it."""
        of = self.symbol
        return _asm(f".globl {of}", f".type {of}, %object", f".size {of}, 1", f".set {of}, 0")

    def _reference(self, directive: str) -> str:
        opened = f'.pushsection {_SECTION},\\"\\",%progbits'
        return _asm(opened, f"{directive} {self.symbol}", ".popsection")


def link(name: str, found: Identities, real: str) -> Link:
    """The symbol of C: its name says element type, version and stand, so that an error message tells both."""
    return _link(name, found, real, "element type, version or stand")


def part_link(name: str, part: str, found: Identities, real: str, declared: Iterable[object]) -> Link:
    """The symbol of a file beside the C, as `servo`; it has a hash of its declarations besides."""
    shape = fnv1a("\n".join(map(str, declared)).encode("utf-8"))
    return _link(f"{name}_{part}", found, f"{real}_{shape:08x}", "element type, declarations, version or stand")


def _link(name: str, found: Identities, shape: str, noticed: str) -> Link:
    version = "_".join(__version__.split("."))
    symbol = f"{name}_link_{shape}_v{version}_{found.physics}"
    return Link(symbol, name.upper(), noticed)


def _asm(*lines: str) -> str:
    """A statement of assembly outside functions, a line of C each."""
    rows = [f'"{line}\\n"' for line in lines]
    return "\n".join([f"__asm__({rows[0]}", *(f"        {row}" for row in rows[1:])]) + ");"
