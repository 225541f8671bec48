"""Random numbers of a campaign: uniform in 0..1, by seed, name and sample.

A stream has a key, which Philox makes of the seed and the name of the factor, and a place for every sample. So the
number of a sample is the same whichever process draws it, and in whatever order; and a factor keeps its numbers when
others are added to the file.
"""

from __future__ import annotations

from hashlib import blake2b

import numpy as np
from numpy.random import Generator, Philox
from numpy.typing import NDArray

Array = NDArray[np.float64]

_BLOCK = 4
"""Numbers of 64 bits that Philox makes of one count."""


def key_of(seed: int, name: str) -> int:
    """The key of a stream, 128 bits."""
    return int.from_bytes(blake2b(f"{seed} {name}".encode(), digest_size=16).digest(), "little")


def uniform(seed: int, name: str, first: int, count: int) -> Array:
    """The numbers of `count` samples from `first` on, in 0 <= u < 1."""
    skip = first % _BLOCK
    stream = Generator(Philox(counter=first // _BLOCK, key=key_of(seed, name)))
    return stream.random(skip + count)[skip:]


def generator(seed: int, name: str) -> Generator:
    """A generator for what is drawn at once for a whole campaign, such as the scrambling of a sequence."""
    return Generator(Philox(key_of(seed, name)))
