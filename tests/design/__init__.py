"""Tests of the stage `design`."""
