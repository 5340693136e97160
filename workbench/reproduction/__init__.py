"""Reproduction: the figures, tables and claims of the theses, remade and judged.

:mod:`~workbench.reproduction.reproduce` runs the notebooks and writes the report. What is
computed for a figure or table lies in one module of :mod:`~workbench.reproduction.costa2018`,
:mod:`~workbench.reproduction.halit2010` or :mod:`~workbench.reproduction.beyond`.
"""
