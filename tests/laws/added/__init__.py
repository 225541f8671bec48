"""Folders of laws that are not in the package, for `with_tug`."""
