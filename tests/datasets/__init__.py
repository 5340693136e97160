"""Tests of workbench.datasets."""
