"""Tests of what reproduces the theses."""
