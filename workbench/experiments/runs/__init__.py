"""Runs: what a grid executes, one module for each kind.

A kind of run is a frozen dataclass that follows :class:`~workbench.experiments.runs.base.Run`.
"""
