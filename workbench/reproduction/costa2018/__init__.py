"""Experiments of Costa 2018, spatial keyframes and the optimizer of projections."""
