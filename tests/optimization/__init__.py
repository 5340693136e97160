"""Tests of workbench.optimization."""
