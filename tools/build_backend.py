"""Hatchling after a look at the version of Python: an old pip would first try every version of every dependency."""

import sys

if sys.version_info < (3, 11):  # noqa: UP036
    sys.exit(f"mahovik needs Python 3.11 or newer, this is Python {sys.version_info[0]}.{sys.version_info[1]}")

from hatchling.build import *  # noqa: F403
