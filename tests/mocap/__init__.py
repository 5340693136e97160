"""Tests of workbench.mocap."""
