"""Flywheel programmes as C: tables, drive torques, errors of the tables, the files."""

from mahovik.out.export.programme.files import LIMITS, NODES, ProgrammeExport, check_belongs, export_programme

__all__ = ["LIMITS", "NODES", "ProgrammeExport", "check_belongs", "export_programme"]
