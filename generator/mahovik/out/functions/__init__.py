"""The commands as functions of Python: files or objects in, objects with arrays, names and units out.

Each module is a group of the commands' help; the commands are thin layers over these functions.
"""
