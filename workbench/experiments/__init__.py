"""Experiments: grids of runs, published values, and the reproduction of figures and tables.

Import from the modules: :mod:`~workbench.experiments.grid` runs many schemes on many data
sets, :mod:`~workbench.experiments.reproduce` remakes the figures and tables of the theses.
"""
