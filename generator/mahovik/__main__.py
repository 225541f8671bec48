"""`mahovik` and `python -m mahovik`: the command line."""

import gc
import os
import sys

ONE_THREAD = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
"""Read by the linear algebra under NumPy when it is loaded."""


ALLOCATIONS = 200_000
"""Between two searches for circular garbage. The imports of a command make fewer objects, and no garbage among them."""


def run() -> None:
    """Runs it. Ctrl-C while it is still imported ends as everywhere else: one line, status 130.

    Linear algebra has one thread, unless the environment says otherwise: the matrices are small, and the number of
    threads may change the order of sums, so that the same seed would not give the same programme on every machine.
    """
    for name in ONE_THREAD:
        os.environ.setdefault(name, "1")
    gc.set_threshold(ALLOCATIONS)
    try:
        from mahovik.out.command_line import main

        main()
    except KeyboardInterrupt:
        sys.stderr.write("error: interrupted; no file is half written\n")
        sys.exit(130)
    finally:
        gc.freeze()  # the process ends: two last searches through all of its objects would find nothing that matters


if __name__ == "__main__":
    run()
