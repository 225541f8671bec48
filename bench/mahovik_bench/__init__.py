"""The benchmark: mahovik's C beside its peers, in one process, on the same inputs. Not part of the package."""

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # before NumPy is loaded: all contestants have one core
