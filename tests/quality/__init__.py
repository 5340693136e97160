"""Tests of workbench.quality."""
