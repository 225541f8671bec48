"""Functions that evaluate a flywheel programme from tables: what `core/emit/programme.py` prints."""
