"""Figures: plotly builders that take finished numbers and draw them, without computing."""
