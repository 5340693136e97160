"""Tests of workbench.selection."""
