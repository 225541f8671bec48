"""Hypothesis draws the same examples in every run of CI; elsewhere new ones, so that daily work searches on."""

import os

from hypothesis import settings

settings.register_profile("ci", derandomize=True, deadline=None)
if os.environ.get("CI"):
    settings.load_profile("ci")
