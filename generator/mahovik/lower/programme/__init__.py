"""Functions that evaluate a flywheel programme from tables: what `emit/programme.py` prints."""
