"""Motion in time: a stand under a regime, by the generated C or, to judge it, by SciPy and the literal reference."""
