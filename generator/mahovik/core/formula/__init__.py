"""The derivation's formulas as data: written by SymPy in a fixed order of operations, read without it."""
