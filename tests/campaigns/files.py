"""Campaign files for tests."""

from pathlib import Path

from mahovik.errors import CampaignError
from mahovik.out.campaign.file import CampaignFile, load_campaign

HEAD = 'schema = 1\nstand = "{stand}"\nsamples = {samples}\nseed = {seed}\ndesign = "{design}"\n'


def write(
    folder: Path, body: str, *, stand: str = "sat4", samples: int = 2000, seed: int = 7, design: str = "random"
) -> Path:
    """Write a campaign file: a head, then `body`, which begins with keys or with [vary]."""
    path = folder / "C.toml"
    path.write_text(HEAD.format(stand=stand, samples=samples, seed=seed, design=design) + body, encoding="utf-8")
    return path


def read(folder: Path, body: str, **head: object) -> CampaignFile:
    """The campaign of such a file."""
    return load_campaign(write(folder, body, **head))  # type: ignore[arg-type]  # keys of the head, by name


def refusal(folder: Path, body: str, **head: object) -> str:
    """Message of the reader on a file that it refuses: one line."""
    try:
        read(folder, body, **head)
    except CampaignError as error:
        text = str(error)
        assert text.startswith("C.toml: "), text
        assert "\n" not in text, text
        return text
    raise AssertionError("accepted")
