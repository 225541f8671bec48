"""Hypothesis draws the same examples in every run of CI; elsewhere new ones, so that daily work searches on.

Commands keep their formulas here, not in the folder of the user.
"""

import os
from pathlib import Path

from hypothesis import settings

os.environ["MAHOVIK_CACHE"] = str(Path(__file__).resolve().parents[1] / ".pytest_cache" / "formulas")

settings.register_profile("ci", derandomize=True, deadline=None)
if os.environ.get("CI"):
    settings.load_profile("ci")
