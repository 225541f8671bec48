"""What a person or another program meets.

Enters: commands, files, arrays. Leaves: tables, reports, exported projects, stands made from models of other programs.
"""
