"""Tests of workbench.backprojection."""
