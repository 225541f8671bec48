"""Panels as inline SVG for a page: as wide as its place, in the colours of the page, with a read-out."""

from mahovik.out.report.stand.chart.figure import charts

__all__ = ["charts"]
