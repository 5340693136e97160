"""Tests of workbench.dashboards."""
