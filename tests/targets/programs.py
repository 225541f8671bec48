"""Templates of the programs that only tests compile, which lie in this folder beside those of the generator."""

from __future__ import annotations

from pathlib import Path

from jinja2 import FileSystemLoader

from mahovik.core.emit.templates import environment, template

__all__ = ["PIL", "template"]

PIL = "pil.c.j2"
loader = environment().loader
assert isinstance(loader, FileSystemLoader)
loader.searchpath.append(str(Path(__file__).parent))
