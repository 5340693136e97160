"""Experiments: grids of runs, executed in parallel and stored, never the same run twice.

Import from the modules: :mod:`~workbench.experiments.grid` executes runs, and
:mod:`~workbench.experiments.runs` holds what can be run.
"""
