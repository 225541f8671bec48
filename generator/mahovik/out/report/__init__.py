"""Documents about a stand for a person to read."""
