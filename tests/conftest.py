"""Hypothesis draws the same examples in every run of CI; elsewhere new ones, so that daily work searches on.

Compiled stands are kept here, not in the folder of the user; equal C is compiled once for all tests, and
generated once in each process.
Linear algebra has one thread, and garbage is looked for as seldom, as in the command.
Ctrl-C acts on commands that tests start, also where a shell runs the tests beside itself and has it ignored.
"""

import gc
import os
import signal
import sys
from pathlib import Path

from hypothesis import settings

from mahovik.__main__ import ALLOCATIONS, ONE_THREAD
from toolchain import generated_once, unoptimised

CACHE = Path(__file__).resolve().parents[1] / ".pytest_cache"
TOOLS = Path(__file__).resolve().parents[1] / "tools"

if os.environ.pop("PYTHONDONTWRITEBYTECODE", ""):  # commands that tests start need not compile their modules again
    sys.dont_write_bytecode, sys.pycache_prefix = False, str(CACHE / "bytecode")
    os.environ["PYTHONPYCACHEPREFIX"] = sys.pycache_prefix

gc.set_threshold(ALLOCATIONS)
for name in ONE_THREAD:  # before NumPy is loaded
    os.environ.setdefault(name, "1")
os.environ["MAHOVIK_CACHE"] = str(CACHE / "mahovik")
generated_once.install()
unoptimised.install()

sys.path.append(str(TOOLS))  # tools import one another, and tests import them; last, as names of tests go first

if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)

settings.register_profile("daily", deadline=None)
settings.register_profile("ci", derandomize=True, deadline=None)
settings.load_profile("ci" if os.environ.get("CI") else "daily")
