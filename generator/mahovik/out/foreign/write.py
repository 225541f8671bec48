"""An imported stand as a stand file, which says where each number came from."""

from __future__ import annotations

from mahovik.core.stand import dumps, loads
from mahovik.errors import ForeignError, StandError
from mahovik.out.foreign.merge import ImportedStand


def stand_file(found: ImportedStand, source: str, command: str) -> str:
    """The text of the stand file; reading it back gives the same bits. `command` names its origin.

    Raises ForeignError if the model is not a valid stand, with the messages of `mahovik check`.
    """
    comments = {name: [_one_line(line) for line in lines] for name, lines in found.comments.items()}
    head = [f"# Made from {source} by `{command}`. SI units.", *(f"# {line}" for line in found.notes)]
    text = "\n".join(map(_one_line, head)) + "\n" + dumps(found.stand, comments)
    try:
        again = loads(text, source)
    except StandError as error:
        raise ForeignError(error.problems) from None
    assert again == found.stand, "what was written is not what was found"
    return text


def _one_line(text: str) -> str:
    """A comment cannot hold line ends or control characters, which names of other programs may have."""
    return "".join(c if c.isprintable() else " " for c in text)
