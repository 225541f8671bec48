"""The C program as data: types, expressions, statements, functions; operation counts; and an interpreter.

Nothing here knows mechanics, SymPy or the syntax of C. `lower/` writes programs, `emit/` prints them,
`interpret.py` runs them with NumPy scalars, one operation at a time.
"""
