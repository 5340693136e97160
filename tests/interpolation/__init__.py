"""Tests of workbench.interpolation."""
