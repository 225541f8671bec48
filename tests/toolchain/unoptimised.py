"""Emitted C of tests is built without optimisation: the bits do not depend on it, and gcc takes a quarter of the time.

tests/emit/test_selftest.py holds all optimisations to the same bits, and commands in processes of their own build as
for users, unless they find the library of a Python model that a test has built already.
"""

from mahovik.core.toolchain.compiler import BITS

FLAGS = (*BITS, "-O0")


def install() -> None:
    """Build so what this process builds from now on."""
    from mahovik.core.toolchain import compiled, library, store  # here, as they load NumPy

    vars(compiled).update(SINGLE=FLAGS, BATCH=FLAGS)
    vars(library).update(FLAGS=FLAGS)
    vars(store).update(KEPT=1000)
