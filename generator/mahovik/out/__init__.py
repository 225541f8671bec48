"""Interfaces for people and for other programs.

Enters: commands, files, arrays. Leaves: tables, reports, exported projects, stands made from models of other programs.
"""
