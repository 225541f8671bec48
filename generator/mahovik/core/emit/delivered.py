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
from dataclasses import dataclass, field, replace
from importlib.metadata import version
from pathlib import Path, PurePosixPath
from typing import Any

import mahovik
from mahovik import __version__
from mahovik.contract.functions import ALL
from mahovik.core.emit.delivery import ADDITIONS
from mahovik.core.emit.generate import PRECISIONS
from mahovik.core.emit.manifest import FORMAT, NAME, Header, as_text, digest, read_header
from mahovik.core.emit.names import VERIFICATION
from mahovik.core.stand.fields import stand_name_problem
from mahovik.core.stand.files import content
from mahovik.core.stand.model import Stand
from mahovik.core.stand.structure import under_name
from mahovik.errors import CheckError, MahovikError, UsageError
from mahovik.writing import write_all

COST_PAGE = "COST.md"
"""Measured cost of the C whose SHA-256 it names; `mahovik verify --cost` writes it, the manifest does not list it."""

PROVENANCE = "provenance.json"
"""File beside the manifest, which does not list it: what made the folder, of this machine."""

_MARK = "Generated: change the stand file instead."
_NOTHING = "nothing was written"
_OTHER = "is not what the generator makes of the stand file"


@dataclass(frozen=True)
class Options:
    """What `generate` was asked for beside the prefix, which is the name of the stand: as its options have it.

    `project`: also `attitude-` before the project of an attitude loop; "" for none. `settings`: of a block or a loop.
    """

    real: str = "double"
    only: tuple[str, ...] = ()
    additions: tuple[str, ...] = ()
    project: str = ""
    settings: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class Delivery:
    """Paths that were written, the manifest after what it lists, and a line on each file that was removed."""

    paths: tuple[Path, ...]
    notes: tuple[str, ...]


def read_manifest(folder: Path, name: str = NAME) -> dict[str, Any] | None:
    """The manifest of a folder, of a file name; None where there is none. Raises UsageError where it is not ours."""
    path = folder / name
    if not path.is_file():
        return None
    try:
        document = json.loads(content(path).decode("utf-8"))
        known = str(document["generator"]).startswith("mahovik ") and document["format"] == FORMAT
        known = known and isinstance(document["stand"], str) and document["real"] in PRECISIONS
        only = document.get("only", list(ALL))
        known = known and isinstance(only, list) and all(isinstance(name, str) for name in only)
        if known and isinstance(document["files"], dict):
            return dict(document)
    except (OSError, ValueError, KeyError, TypeError, RecursionError):
        pass
    raise UsageError(f"{path}: is not a manifest of mahovik: choose another folder, {_NOTHING}")


def manifest_there(folder: Path, name: str = NAME) -> dict[str, Any] | None:
    """Likewise, and None where it is not ours."""
    try:
        return read_manifest(folder, name)
    except UsageError:
        return None


def manifests_beside(folder: Path, stand: Stand) -> dict[str, dict[str, Any]]:
    """Manifests of programmes, servos and loops beside the C of a stand, by their names, such as `bench8_programme`."""
    paths = sorted(folder.glob(f"{stand.name}_*.json"))
    manifests = {path.stem: manifest_there(folder, path.name) for path in paths}
    return {name: there for name, there in manifests.items() if there is not None and there["stand"] == stand.name}


def files_beside(folder: Path, stand: Stand) -> dict[str, list[str]]:
    """Files of each of them that are not as it lists them. Line endings do not count."""
    return {
        name: [file for file, listed in there["files"].items() if not has_hash(folder / file, listed)]
        for name, there in manifests_beside(folder, stand).items()
    }


def has_hash(path: Path, listed: str) -> bool:
    """Whether a file is there with this SHA-256. Line endings do not count."""
    return path.is_file() and listed in (_hash(path), digest(path.read_bytes().replace(b"\r\n", b"\n")))


def delivered_options(folder: Path) -> Options | None:
    """Options of the C in a folder, by its manifest; None where there is none. Raises UsageError."""
    manifest = read_manifest(folder)
    if manifest is None:
        return None
    stems = {PurePosixPath(name).stem for name in manifest["files"]}
    added = tuple(name for name in ADDITIONS if {f"{manifest['stand']}_{name}", f"mahovik_{name}"} & stems)
    only, project, settings = manifest.get("only", ALL), manifest.get("project", ""), manifest.get("settings")
    return Options(manifest["real"], tuple(only), added, str(project), settings if isinstance(settings, dict) else {})


def with_prefix(stand: Stand, prefix: str | None) -> Stand:
    """The stand by another name, which is that of its files and the first word of every name in C. UsageError."""
    if prefix is None:
        return stand
    problem = stand_name_problem(prefix)
    if problem is not None:
        raise UsageError(f"prefix {prefix}: {problem}")
    return replace(stand, name=prefix)


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
    there = ", ".join(f'"{name}", physics {header.physics}' for name, header in headers.items())
    raise refusal(
        f'{folder}: holds the C of stand {there}, expected that of "{stand.name}", also under another name '
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
    files: Mapping[str, str],
    replaceable: Sequence[str] = (),
    made_by: str = "",
) -> Delivery:
    """Writes the files of a stand, their manifest among them.

    Of the `replaceable` files, which a user may replace by others, those that were changed stay as they are.
    `made_by`: text of `provenance`, which is written beside them and not listed.

    Raises UsageError where a file there is not the generator's own, and for a project in the place of a delivered
    folder or the reverse. What an older generator left, and a COST.md of other C, is removed.
    """
    old = manifest_of(folder, stand) or {}
    listed: Mapping[str, str] = old.get("files", {})
    unchanged = {name for name in listed if (folder / name).is_file() and _hash(folder / name) == listed[name]}
    yours = [name for name in replaceable if name in listed and name not in unchanged and (folder / name).is_file()]
    written = {name: text for name, text in files.items() if name not in yours}
    project = json.loads(files[NAME]).get("project")
    for name, text in written.items():
        path = folder / name  # what is no file at all is refused where it is written
        if name == NAME or not path.is_file() or name in unchanged or _hash(path) == digest(text):
            continue
        there = path.read_bytes()
        if old or _MARK.encode() not in there or f'of the stand "{stand.name}"'.encode() not in there:
            why = "was changed by hand" if name in listed else "was not written by mahovik"
            raise UsageError(f"{path}: {why}: move it away or choose another folder, {_NOTHING}")
    if old and bool(old.get("project")) != bool(project):
        what = f"the project of target {old['project']}" if old.get("project") else "what `mahovik generate` delivers"
        raise UsageError(f"{folder}: holds {what}: choose another folder, {_NOTHING}")
    path = folder / PROVENANCE
    if made_by and path.is_file() and b'"package": ' not in path.read_bytes():
        raise UsageError(f"{path}: was not written by mahovik: move it away or choose another folder, {_NOTHING}")
    stale = {}
    for name in sorted(unchanged - {*files, COST_PAGE}):
        if "/" not in name.removeprefix(VERIFICATION):  # a manifest may name anything
            stale[folder / name] = "is no longer delivered"
    if is_cost_page(folder, stand) and not _is_measured_on(folder, files.get(f"{stand.name}.c", "")):
        stale[folder / COST_PAGE] = "was measured on other C: measure again with `mahovik verify --cost`"
    paths = write_all(folder, written)
    if made_by:
        paths += write_all(folder, {PROVENANCE: made_by})
    notes = [f"{folder / name} is yours and stays as it is" for name in yours]
    for path, why in stale.items():
        path.unlink(missing_ok=True)
        if path.parent != folder and not any(path.parent.iterdir()):
            path.parent.rmdir()
        notes.append(f"{path} was removed: it {why}")
    return Delivery(paths, tuple(notes))


def manifest_of(folder: Path, stand: Stand) -> dict[str, Any] | None:
    """The manifest of a folder, None where there is none. Raises UsageError if it is of another stand, or not ours."""
    manifest = read_manifest(folder)
    if manifest is not None and manifest["stand"] != stand.name:
        raise UsageError(
            f'{folder}: holds the C of stand "{manifest["stand"]}": choose another folder, or that name by prefix, '
            f"{_NOTHING}"
        )
    return manifest


def is_cost_page(folder: Path, stand: Stand) -> bool:
    """Whether a folder has a COST.md of this stand."""
    path = folder / COST_PAGE
    return path.is_file() and path.read_bytes().startswith(
        f"# Cost of {stand.name}\n\nWritten by `mahovik verify --cost`".encode()
    )


def _is_measured_on(folder: Path, source: str) -> bool:
    """Whether COST.md names this source."""
    return digest(source).encode() in (folder / COST_PAGE).read_bytes()


def _hash(path: Path) -> str:
    return digest(path.read_bytes())


def provenance(stand_file: bytes | None) -> str:
    """What made a folder: hash of the installed package, its commit where known, Python, NumPy; the stand file's hash.

    The package is hashed over paths and contents of its Python files; the commit is that of a checkout which it runs
    in, `+` where files differ from it.
    """
    package = Path(mahovik.__file__).resolve().parent
    result = hashlib.sha256()
    for path in sorted(package.rglob("*.py")):
        result.update(path.relative_to(package).as_posix().encode() + b"\0" + path.read_bytes())
    return as_text(
        {
            "generator": f"mahovik {__version__}",
            "package": result.hexdigest(),
            "commit": _commit(package),
            "python": platform.python_version(),
            "numpy": version("numpy"),
            "stand_file": None if stand_file is None else digest(stand_file),
        }
    )


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


def differences(folder: Path, stand: Stand, files: Mapping[str, str], beside: Mapping[str, str]) -> list[str]:
    """Differences of the folder from what `deliver` would leave, a line each; none if it is as the stand file gives it.

    `files`: those of the C, none where it is not written; `beside`: those of programmes and servos. A folder of the
    other element type differs in every file: one line reports that.
    """
    header = read_header(folder, stand.name)
    if files and header is not None and header.real not in (None, real := json.loads(files[NAME])["real"]):
        there = header.real
        return [f"{folder}: its C is {there}, expected {real}: real={there} is right, or generate it again"]
    result = []
    for name, text in {**files, **beside}.items():
        path = folder / name
        if not path.is_file():
            made_as = ", expected what generate wrote, with the project that it was made with" if name == NAME else ""
            result.append(f"{path}: is missing{made_as}")
        elif path.read_bytes() != text.encode("utf-8"):
            other = "is not the manifest of these files" if name == NAME else _OTHER
            result.append(f"{path}: {other}")
    for manifest, changed in files_beside(folder, stand).items():
        result += [f"{folder / name}: is not what {manifest}.json lists" for name in changed if name not in beside]
    if files and is_cost_page(folder, stand) and not _is_measured_on(folder, files[f"{stand.name}.c"]):
        result.append(f"{folder / COST_PAGE}: was measured on other C")
    return result
