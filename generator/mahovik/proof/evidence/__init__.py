"""The evidence for the C of one stand in one folder: every check run, its output kept, and a summary page."""
