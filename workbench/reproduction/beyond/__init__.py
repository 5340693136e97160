"""Experiments beyond the theses: our optimizers, and questions that they left open."""
