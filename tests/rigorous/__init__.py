"""Tests of ball arithmetic."""
