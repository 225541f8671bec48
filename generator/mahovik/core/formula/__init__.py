"""The derivation's formulas as plain data, in a fixed order of operations, and their cache on disk.

Nothing here imports SymPy unless a formula has to be derived: a command whose formulas are all in the cache never does.
"""
