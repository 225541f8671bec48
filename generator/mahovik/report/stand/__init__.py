"""The report of a stand: one page for people, made of sections; a section a module."""

from mahovik.report.stand.material import Material
from mahovik.report.stand.page import Page, page

__all__ = ["Material", "Page", "page"]
