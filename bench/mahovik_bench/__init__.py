"""The benchmark: mahovik's C beside its peers, in one process, on the same inputs. Not part of the package."""
