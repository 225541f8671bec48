"""Formats of files of measured data, each read into tables of named columns."""
