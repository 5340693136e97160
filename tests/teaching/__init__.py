"""Tests of workbench.teaching."""
