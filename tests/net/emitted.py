"""Hashes of the C of example and random stands: of every file, and of every public function with what it calls."""

from __future__ import annotations

import hashlib
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import mahovik
from mahovik.contract.functions import ALL
from mahovik.core.emit.delivery import delivery

STANDS = Path(__file__).parent / "stands"

FEW = ("forward", "momentum")
"""Functions of the random stands that are generated with `--only`."""

DEFINITION = re.compile(r"^(?:[A-Z]\w* )*(?:static )?[a-z]\w* \*?(\w+)\([^;{]*\)\n?\{\n.*?^\}$", re.M | re.S)
NAME = re.compile(r"\b[a-z]\w+\b")


def cases() -> Iterator[tuple[str, Path | mahovik.Stand, dict[str, Any]]]:
    """Name, stand and options: the example stands with all functions, the random ones with options in turn."""
    yield "bench8 default", mahovik.example("bench8"), {}
    for name in mahovik.examples():
        yield name, mahovik.example(name), {"only": ALL}
    yield "bench8 float", mahovik.example("bench8"), {"only": ALL, "real": "float"}
    yield "bench8 batch", mahovik.example("bench8"), {"only": ALL, "batch": True}
    yield "bench8 only", mahovik.example("bench8"), {"only": ("forward", "inverse_fast"), "real": "float"}
    for number, path in enumerate(sorted(STANDS.glob("random*.toml"))):
        options: dict[str, Any] = {"only": ALL}
        if number % 4 == 3:
            options["real"] = "float"
        if number % 5 == 4:
            options["batch"] = True
        if number % 7 == 6:
            options["only"] = FEW
        yield path.stem, path, options


def digest(text: str) -> str:
    """Short hash of a text."""
    return hashlib.sha256(text.encode()).hexdigest()[:12]


def emitted(stand: Path | mahovik.Stand, options: dict[str, Any]) -> dict[str, dict[str, str]]:
    """Hashes of the C of a stand: `files` by name, `functions` by name."""
    additions = ("selftest", "eva", *(("recorder",) if options.get("only") == ALL else ()))
    additions = (*additions, *(("batch",) if options.get("batch") else ()))
    loaded = mahovik.load(stand) if isinstance(stand, Path) else stand
    files = delivery(loaded, options.get("real", "double"), options.get("only", ()), additions)
    sources = {name: text for name, text in files.items() if name.endswith((".c", ".h"))}
    functions: dict[str, str] = {}
    for name, header in sources.items():
        if name.endswith(".h") and f"{name[:-2]}.c" in sources:
            functions |= _functions(header, sources[f"{name[:-2]}.c"])
    return {"files": {name: digest(text) for name, text in sorted(sources.items())}, "functions": functions}


def _functions(header: str, source: str) -> dict[str, str]:
    """Hash of each function that the header declares: of its text and of all that it calls."""
    bodies = {match[1]: match[0] for match in DEFINITION.finditer(source)}
    calls = {name: (set(NAME.findall(text)) & bodies.keys()) - {name} for name, text in bodies.items()}
    hashes = {}
    for name in bodies:
        if not re.search(rf"\b{name}\(", header):
            continue
        reached, waiting = {name}, [name]
        while waiting:
            new = calls[waiting.pop()] - reached
            reached |= new
            waiting += new
        hashes[name] = digest("".join(bodies[one] for one in sorted(reached)))
    return hashes
