"""Tests of workbench.widgets."""
