"""The writer of files: whole or not at all at every instruction, through links, devices and FIFOs."""

from __future__ import annotations

import dis
import os
import stat
import sys
import threading
from collections.abc import Callable
from pathlib import Path
from types import FrameType
from typing import Any

import pytest

from mahovik import writing
from mahovik.errors import UsageError
from mahovik.writing import probe, write, write_all, write_folder

NOP = dis.opmap["NOP"]
"""The beginning of a `try` within another, for Python 3.11 outside of both; no signal is looked for there."""


def interrupted_at(number: int, action: Callable[[], object]) -> bool:
    """Run an action with Ctrl-C at one instruction of the writer; False if it has fewer instructions."""
    left = number

    def trace(frame: FrameType, event: str, _: Any) -> Any:
        nonlocal left
        if frame.f_code.co_filename != writing.__file__:
            return None
        frame.f_trace_opcodes = True
        if event == "opcode" and frame.f_code.co_code[frame.f_lasti] != NOP:
            left -= 1
            if left == 0:
                raise KeyboardInterrupt  # Python then traces no further
        return trace

    before = sys.gettrace()
    sys.settrace(trace)
    try:
        action()
    except KeyboardInterrupt:
        pass
    finally:
        sys.settrace(before)
    return left <= 0


def contents(folder: Path) -> dict[str, str]:
    """Every file below a folder, hidden ones too, and every empty folder."""
    paths = [p for p in folder.rglob("*") if p.is_file() or not any(p.iterdir())]
    return {p.relative_to(folder).as_posix(): p.read_text() if p.is_file() else "" for p in paths}


def two_files(folder: Path) -> None:
    write_all(folder, {"a": "new", "b": "new"})


def tried(folder: Path) -> None:
    probe(folder / "a")


def whole_folder(folder: Path) -> None:
    write_folder(folder / "whole", lambda draft: two_files(draft / "c"))


unclosed = pytest.mark.filterwarnings("ignore::ResourceWarning", "ignore::pytest.PytestUnraisableExceptionWarning")
"""A file object that an interrupt keeps from its `with` is closed by Python, which reports that."""

OLD = {"a": "old", "whole/old": "old"}


@unclosed
@pytest.mark.parametrize(
    ("action", "new"),
    [
        (two_files, {"a": "new", "b": "new", "whole/old": "old"}),
        (tried, OLD),
        (whole_folder, {"a": "old", "whole/c/a": "new", "whole/c/b": "new"}),
    ],
)
def test_an_interrupt_at_any_instruction_leaves_the_old_or_the_new(
    action: Callable[[Path], None], new: dict[str, str], tmp_path: Path
) -> None:
    number, more, seen = 0, True, []
    while more:
        number += 1
        folder = tmp_path / str(number)
        (folder / "whole").mkdir(parents=True)
        for name, text in OLD.items():
            (folder / name).write_text(text)
        more = interrupted_at(number, lambda folder=folder: action(folder))  # type: ignore[misc]
        files = contents(folder)
        assert files in (OLD, new), number
        seen.append(files)
    assert number > 100
    assert seen[0] == OLD
    assert seen[-1] == new


def received(fifo: Path, action: Callable[[], object]) -> str:
    """Text that arrives in a FIFO."""
    messages: list[str] = []
    reader = threading.Thread(target=lambda: messages.append(fifo.read_text()), daemon=True)
    reader.start()
    action()
    reader.join(10.0)
    return "".join(messages)


def test_a_fifo_is_written_through(tmp_path: Path) -> None:
    fifo = tmp_path / "fifo"
    os.mkfifo(fifo)
    probe(fifo)  # must not open it: a reader would see its end
    assert received(fifo, lambda: write(fifo, "text")) == "text"
    (tmp_path / "link").symlink_to("fifo")
    assert received(fifo, lambda: write(tmp_path / "link", "again")) == "again"
    assert stat.S_ISFIFO(fifo.stat().st_mode)
    assert sorted(p.name for p in tmp_path.iterdir()) == ["fifo", "link"]


@pytest.fixture
def device(tmp_path: Path) -> Path:
    """A device of its own that swallows everything."""
    path = tmp_path / "null"
    try:
        os.mknod(path, stat.S_IFCHR | 0o666, os.makedev(1, 3))
        path.open("wb").close()
    except OSError:
        pytest.skip("only root can make a device, and not everywhere")
    return path


def test_a_device_stays_one(device: Path) -> None:
    probe(device)
    write(device, "text")
    write_all(device.parent, {"null": "text", "file": "text"})
    assert stat.S_ISCHR(device.stat().st_mode)
    assert sorted(p.name for p in device.parent.iterdir()) == ["file", "null"]


def test_a_link_stays_and_its_target_is_replaced(tmp_path: Path) -> None:
    (tmp_path / "there").mkdir()
    (tmp_path / "there" / "file").write_text("old")
    (tmp_path / "second").symlink_to("there/file")
    (tmp_path / "first").symlink_to("second")
    before = (tmp_path / "there" / "file").stat().st_ino
    probe(tmp_path / "first")
    write(tmp_path / "first", "new")
    assert (tmp_path / "first").is_symlink()
    assert (tmp_path / "second").is_symlink()
    assert contents(tmp_path / "there") == {"file": "new"}
    assert (tmp_path / "there" / "file").stat().st_ino != before  # moved there whole


def test_links_in_a_circle_and_to_a_folder_are_refused(tmp_path: Path) -> None:
    (tmp_path / "circle").symlink_to("circle")
    (tmp_path / "folder").symlink_to(".")
    for action in (probe, lambda path: write(path, "x")):
        with pytest.raises(UsageError, match=r"circle: cannot be written: .*symbolic link"):
            action(tmp_path / "circle")
        with pytest.raises(UsageError, match="folder: is a directory, expected a file to write"):
            action(tmp_path / "folder")
    assert sorted(p.name for p in tmp_path.iterdir()) == ["circle", "folder"]


def test_what_is_written_through_comes_last(tmp_path: Path) -> None:
    """Where it fails, the files come back."""
    os.mkfifo(tmp_path / "a")
    (tmp_path / "b").write_text("old")
    opener = os.open

    def refused(path: Any, *arguments: Any) -> int:
        if Path(path).name == "a":
            raise BrokenPipeError(32, "Broken pipe")
        return opener(path, *arguments)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("mahovik.writing.os.open", refused)
        with pytest.raises(UsageError, match="a: cannot be written: Broken pipe"):
            write_all(tmp_path, {"a": "new", "b": "new"})
    assert (tmp_path / "b").read_text() == "old"
    assert sorted(p.name for p in tmp_path.iterdir()) == ["a", "b"]


def test_permissions_are_those_of_the_umask(tmp_path: Path) -> None:
    mask = os.umask(0o027)
    try:
        write(tmp_path / "file", "text")
        write_all(tmp_path, {"private": "text"}, mode=0o600)
        write_folder(tmp_path / "folder", lambda draft: None)
    finally:
        os.umask(mask)
    modes = [stat.S_IMODE((tmp_path / name).stat().st_mode) for name in ("file", "private", "folder")]
    assert modes == [0o640, 0o600, 0o750]


def test_a_folder_that_cannot_be_filled_leaves_the_old(tmp_path: Path) -> None:
    def fill(draft: Path) -> None:
        write(draft / "half", "new")
        raise UsageError("stopped")

    (tmp_path / "folder").mkdir()
    (tmp_path / "folder" / "file").write_text("old")
    with pytest.raises(UsageError, match="stopped"):
        write_folder(tmp_path / "folder", fill)
    assert contents(tmp_path) == {"folder/file": "old"}
