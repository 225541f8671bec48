"""Flywheel programmes as C: tables, drive torques, how far the tables are from the programme, the files."""

from mahovik.out.export.programme.files import LIMITS, NODES, Exported, check_belongs, export_programme

__all__ = ["LIMITS", "NODES", "Exported", "check_belongs", "export_programme"]
