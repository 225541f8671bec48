"""The delivered folder on disk: whose C it has, written whole or not at all, never over files of others, and checked.

A file is the generator's own where the folder's manifest lists it with the hash it still has, or where it is C of
this stand that was generated before there were manifests.
"""

from __future__ import annotations

import hashlib
import json
import platform
import re
import subprocess
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from importlib.metadata import version
from pathlib import Path
from typing import Any

import mahovik
from mahovik import __version__
from mahovik.core.emit.generate import PRECISIONS, generate_all
from mahovik.core.emit.manifest import FORMAT, NAME, as_text, digest, manifest
from mahovik.core.emit.names import VERIFICATION
from mahovik.core.emit.reading import Header, read_header
from mahovik.core.stand.content import content
from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand
from mahovik.core.stand.names import stand_name_problem
from mahovik.errors import CheckError, MahovikError, UsageError
from mahovik.writing import write_all

COST_PAGE = "COST.md"
"""Measured cost of the C whose SHA-256 it names; kept as long as the folder holds that C."""

FIGURES = "cost.json"
"""Accepted figures, with which later C is compared; kept when the C changes."""

PROVENANCE = "provenance.json"
"""File beside the manifest, which does not list it: what made the folder, of this machine."""

_MARK = "Generated: change the stand file instead."
_NOTHING = "nothing was written"


@dataclass(frozen=True)
class Options:
    """What `generate` was asked for beside the prefix, which is the name of the stand: as its options have it."""

    real: str = "double"
    only: tuple[str, ...] = ()
    batch: bool = False


@dataclass(frozen=True)
class Delivery:
    """Paths that were written, manifest last, and a line on each file that was removed."""

    paths: tuple[Path, ...]
    notes: tuple[str, ...]


def read_manifest(folder: Path) -> dict[str, Any] | None:
    """The manifest of a folder; None where there is none. Raises UsageError where it is not ours."""
    path = folder / NAME
    if not path.is_file():
        return None
    try:
        found = json.loads(content(path).decode("utf-8"))
        known = str(found["generator"]).startswith("mahovik ") and found["format"] == FORMAT
        known = known and isinstance(found["stand"], str) and found["real"] in PRECISIONS
        only = found.get("only", [])
        known = known and isinstance(only, list) and all(isinstance(name, str) for name in only)
        if known and isinstance(found["files"], dict):
            return dict(found)
    except (OSError, ValueError, KeyError, TypeError, RecursionError):
        pass
    raise UsageError(f"{path}: is not a manifest of mahovik: choose another folder, {_NOTHING}")


def delivered_options(folder: Path) -> Options | None:
    """Options of the C in a folder, by its manifest; None where there is none. Raises UsageError."""
    found = read_manifest(folder)
    return None if found is None else _options(found)


def _options(found: Mapping[str, Any]) -> Options:
    return Options(found["real"], tuple(found.get("only", ())), bool(found.get("batch", False)))


def with_prefix(stand: Stand, prefix: str | None) -> Stand:
    """The stand by another name, which is that of its files and the first word of every name in C. UsageError."""
    if prefix is None:
        return stand
    problem = stand_name_problem(prefix)
    if problem is not None:
        raise UsageError(f"--prefix {prefix}: {problem}")
    return replace(stand, name=prefix)


def under_name(stand: Stand, name: str, physics: str | None) -> Stand | None:
    """The stand by the name that its C has, its own or that of `generate --prefix`; None for C of another stand.

    `physics`: identity of the C, which the name is a part of.
    """
    if stand_name_problem(name) is not None:
        return None
    named = stand if name == stand.name else replace(stand, name=name)
    return named if identities(named).physics == physics else None


def stand_in(folder: Path, stand: Stand, refusal: type[MahovikError] = CheckError) -> Stand:
    """The stand under the name of its C in a folder; unchanged if the folder has C of its own name, or none at all.

    Raises `refusal` for C of other stands only, and where two names fit.
    """
    headers = _headers(folder)
    if stand.name in headers or not headers:
        return stand
    named = (under_name(stand, name, header.physics) for name, header in headers.items())
    fitting = [candidate for candidate in named if candidate is not None]
    if len(fitting) == 1:
        return fitting[0]
    if fitting:
        names = " and ".join(f'"{candidate.name}"' for candidate in fitting)
        raise refusal(f"{folder}: holds C of this stand under the names {names}: move all but one to other folders")
    others = ", ".join(f'"{name}", physics {header.physics}' for name, header in headers.items())
    raise refusal(
        f'{folder}: holds the C of stand {others}, expected that of "{stand.name}", also under another name '
        "(generate --prefix): generate it again, or choose another folder"
    )


def _headers(folder: Path) -> dict[str, Header]:
    """Headers of all stands whose C is in a folder, by the name in that C."""
    names = sorted(path.stem for path in folder.glob("*.h") if path.with_suffix(".c").is_file())
    headers = {name: read_header(folder, name) for name in names if name.isidentifier()}
    return {name: header for name, header in headers.items() if header is not None and header.physics is not None}


def declared_functions(folder: Path, name: str) -> tuple[str, ...]:
    """Functions that the header of a stand in a folder declares, without prefix, in its order."""
    text = (folder / f"{name}.h").read_text(encoding="utf-8", errors="replace")
    return tuple(re.findall(rf"^\w+ {name}_(\w+)\(", text, re.MULTILINE))


def deliver(
    folder: Path,
    stand: Stand,
    real: str,
    files: Mapping[str, str],
    project: str = "",
    only: Sequence[str] = (),
    replaceable: Sequence[str] = (),
    made_by: str = "",
) -> Delivery:
    """Writes the files of a stand and their manifest; `project`: the target whose exported project they are.

    Of the `replaceable` files, which a user may replace by others, those that were changed stay as they are.
    `made_by`: text of `provenance`, which is written beside them and not listed.

    Raises UsageError where a file there is not the generator's own, and for a project in the place of a delivered
    folder or the reverse. COST.md of the same C stays and is listed, and so do accepted figures; a COST.md of other
    C, and what an older generator left, is removed.
    """
    old = read_manifest(folder)
    listed: Mapping[str, str] = {} if old is None else old["files"]
    replaced = [name for name in replaceable if _is_listed(folder, name, listed) is False]
    written = {name: text for name, text in files.items() if name not in replaced}
    _refuse_foreign(folder, stand, written, old)
    if old is not None and bool(old.get("project")) != bool(project):
        what = f"the project of target {old['project']}" if old.get("project") else "what `mahovik generate` delivers"
        raise UsageError(f"{folder}: holds {what}: choose another folder, {_NOTHING}")
    _refuse_changed(folder, old)
    path = folder / PROVENANCE
    if made_by and '"package": ' not in (_text(path) or made_by):
        raise UsageError(f"{path}: was not written by mahovik: move it away or choose another folder, {_NOTHING}")
    cost, kept = _text(folder / COST_PAGE), _kept_files(folder, stand, files)
    names = [n for n in listed if Path(n.removeprefix(VERIFICATION)).name == n.removeprefix(VERIFICATION)]
    stale = [n for n in names if n not in files and n not in kept and _is_listed(folder, n, listed)]
    if cost is not None and not kept and COST_PAGE not in stale and re.search(r"\b[0-9a-f]{64}\b", cost):
        stale.append(COST_PAGE)
    paths = write_all(folder, {**written, NAME: manifest(stand, real, {**files, **kept}, project, only)})
    if made_by:
        write_all(folder, {PROVENANCE: made_by})
    notes = [f"{folder / name} is yours and stays as it is" for name in replaced]
    for name in stale:
        (folder / name).unlink(missing_ok=True)
        measured = "was measured on other C: measure again with `mahovik cost`"
        notes.append(f"{folder / name} was removed: it {measured if name == COST_PAGE else 'is no longer delivered'}")
    return Delivery(paths, tuple(notes))


def provenance(stand_file: bytes | None) -> str:
    """What made a folder: hash of the installed package, its commit where known, Python, NumPy; the stand file's hash.

    The package is hashed over paths and contents of its Python files; the commit is that of a checkout which it runs
    in, `+` where files differ from it.
    """
    package = Path(mahovik.__file__).resolve().parent
    found = hashlib.sha256()
    for path in sorted(package.rglob("*.py")):
        found.update(path.relative_to(package).as_posix().encode() + b"\0" + path.read_bytes())
    return as_text(
        {
            "generator": f"mahovik {__version__}",
            "package": found.hexdigest(),
            "commit": _commit(package),
            "python": platform.python_version(),
            "numpy": version("numpy"),
            "stand_file": None if stand_file is None else digest(stand_file),
        }
    )


def made_by(folder: Path) -> dict[str, Any]:
    """What `provenance` says of a folder; empty where it has none that can be read."""
    try:
        found = json.loads(_text(folder / PROVENANCE) or "{}")
    except (ValueError, RecursionError):
        return {}
    return found if isinstance(found, dict) else {}


def _commit(package: Path) -> str | None:
    """The commit of the checkout that the package is a part of; None elsewhere, such as in an environment in one."""
    listed = ("ls-files", "--error-unmatch", "__init__.py")
    described = ("describe", "--always", "--abbrev=40", "--exclude=*", "--dirty=+")
    try:
        for words in (listed, described):
            command = ["git", "-C", str(package), *words]
            done = subprocess.run(command, capture_output=True, text=True, check=True, timeout=20)
    except (OSError, subprocess.SubprocessError):
        return None
    return done.stdout.strip() or None


def differences(
    folder: Path,
    stand: Stand,
    real: str,
    files: Mapping[str, str],
    only: Sequence[str] = (),
) -> list[str]:
    """Differences of the folder from what `deliver` would leave, a line each; none if it is as the stand file gives it.

    A folder of the other element type differs in every file: one line reports that.
    """
    header = read_header(folder, stand.name)
    if header is not None and header.real is not None and header.real != real:
        there = header.real
        return [f"{folder}: its C is {there}, expected {real}: give --real {there}, or generate it again"]
    found = []
    for name, text in files.items():
        path = folder / name
        if not path.is_file():
            found.append(f"{path}: is missing")
        elif path.read_bytes() != text.encode("utf-8"):
            found.append(f"{path}: is not what the generator makes of the stand file")
    cost, path = _text(folder / COST_PAGE), folder / NAME
    if cost is not None and not _names_source(cost, stand, files):
        found.append(f"{folder / COST_PAGE}: was measured on other C")
    kept = _kept_files(folder, stand, files) | ({COST_PAGE: cost} if cost is not None else {})
    if (listed := _text(path)) is None:
        found.append(f"{path}: is missing")
    elif listed != manifest(stand, real, {**files, **kept}, only=only):
        unlisted = [name for name, text in kept.items() if f'"{name}": "{digest(text)}"' not in listed]
        found += [f"{folder / name}: is not what {NAME} lists" for name in unlisted]
        found.append(f"{path}: does not list these files")
    return found


def add_to_delivery(folder: Path, files: Mapping[str, str]) -> tuple[Path, ...]:
    """Writes more files, such as COST.md, and lists them in the folder's manifest where there is one."""
    old = read_manifest(folder)
    if old is None:
        return write_all(folder, files)
    listed = {**old["files"], **{name: digest(text) for name, text in files.items()}}
    return write_all(folder, {**files, NAME: as_text({**old, "files": dict(sorted(listed.items()))})})


def require_place_for_cost(folder: Path, stand: Stand) -> None:
    """Raises UsageError unless COST.md and cost.json of a stand may be written into a folder.

    That is one that is new or empty, or that holds this stand's C as its file gives it; COST.md and cost.json there
    must be ours.
    """
    old = read_manifest(folder)
    if old is not None:
        _refuse_stand(folder, stand, old)
        options = _options(old)
        made = generate_all(stand, options.real, options.only).files
        if _text(folder / f"{stand.name}.c") != made[f"{stand.name}.c"]:
            raise UsageError(f"{folder}: holds other C than the stand file gives: `mahovik generate` first, {_NOTHING}")
    elif folder.is_dir() and any(path.name not in (COST_PAGE, FIGURES) for path in folder.iterdir()):
        raise UsageError(f"{folder}: is neither empty nor a folder of `mahovik generate`: choose another, {_NOTHING}")
    _refuse_changed(folder, old)
    page, figures = _text(folder / COST_PAGE), _text(folder / FIGURES)
    foreign = [COST_PAGE] if page is not None and not _is_page(page, stand) else []
    foreign += [FIGURES] if figures is not None and not _is_figures(figures, stand) else []
    for name in foreign:
        raise UsageError(
            f"{folder / name}: was not written by mahovik for {stand.name}: move it away or choose another folder, "
            f"{_NOTHING}"
        )


def accepted_figures(folder: Path, stand: Stand) -> str | None:
    """Text of the cost.json of a stand in a folder, None where there is none.

    Raises UsageError if the file is not ours, or was changed.
    """
    _refuse_changed(folder, read_manifest(folder), (FIGURES,))
    text = _text(folder / FIGURES)
    if text is not None and not _is_figures(text, stand):
        raise UsageError(f"{folder / FIGURES}: no figures of `mahovik cost` for {stand.name}: choose another folder")
    return text


def _is_page(text: str, stand: Stand) -> bool:
    """Whether it is a COST.md of this stand."""
    return text.startswith(f"# Cost of {stand.name}\n\nWritten by `mahovik cost`")


def _is_figures(text: str, stand: Stand) -> bool:
    """Whether it is a cost.json of this stand."""
    try:
        found = json.loads(text)
    except (ValueError, RecursionError):
        return False
    return isinstance(found, dict) and found.get("stand") == stand.name and isinstance(found.get("targets"), list)


def _names_source(cost: str, stand: Stand, files: Mapping[str, str]) -> bool:
    """Whether a COST.md names the source of these files."""
    return digest(files[f"{stand.name}.c"]) in cost


def _kept_files(folder: Path, stand: Stand, files: Mapping[str, str]) -> dict[str, str]:
    """Files of `mahovik cost` that stay beside delivered ones, by name: COST.md of the same C, figures of the stand."""
    cost, figures = _text(folder / COST_PAGE), _text(folder / FIGURES)
    found = {COST_PAGE: cost} if cost is not None and _names_source(cost, stand, files) else {}
    return found | ({FIGURES: figures} if figures is not None and _is_figures(figures, stand) else {})


def _refuse_foreign(folder: Path, stand: Stand, files: Mapping[str, str], old: Mapping[str, Any] | None) -> None:
    """Raises UsageError for the first file that would be overwritten and is not ours."""
    if old is not None:
        _refuse_stand(folder, stand, old)
    for name, text in files.items():
        path = folder / name
        if not path.is_file():
            continue  # what is no file at all is refused where it is written
        there = path.read_bytes()
        listed = old["files"].get(name) if old is not None else None
        marked = _MARK.encode() in there and f'of the stand "{stand.name}"'.encode() in there
        if there == text.encode("utf-8") or listed == digest(there) or (old is None and marked):
            continue
        why = "was changed by hand" if listed is not None else "was not written by mahovik"
        raise UsageError(f"{path}: {why}: move it away or choose another folder, {_NOTHING}")


def _refuse_stand(folder: Path, stand: Stand, old: Mapping[str, Any]) -> None:
    if old["stand"] != stand.name:
        raise UsageError(f'{folder}: holds the C of stand "{old["stand"]}": choose another folder, {_NOTHING}')


def _refuse_changed(folder: Path, old: Mapping[str, Any] | None, names: Sequence[str] = (COST_PAGE, FIGURES)) -> None:
    """Raises UsageError for a file of `mahovik cost` that differs from the manifest."""
    for name in names:
        if old is not None and _is_listed(folder, name, old["files"]) is False:
            raise UsageError(f"{folder / name}: was changed by hand: restore it or move it away, {_NOTHING}")


def _is_listed(folder: Path, name: str, listed: Mapping[str, str]) -> bool | None:
    """Whether a file has the hash that a manifest lists; None where it lists none, or there is no such file."""
    path = folder / name
    return digest(path.read_bytes()) == listed[name] if name in listed and path.is_file() else None


def _text(path: Path) -> str | None:
    return path.read_text(encoding="utf-8", errors="replace") if path.is_file() else None
