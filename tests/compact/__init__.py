"""Tests of the compact form of a motion."""
