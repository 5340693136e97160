"""Tests of workbench.projection."""
