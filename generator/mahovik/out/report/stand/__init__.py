"""The report of a stand: one page for people, made of sections; a section a module."""
