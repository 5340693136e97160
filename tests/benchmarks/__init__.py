"""Benchmarks: how fast the hot paths are, beside a named baseline (`make bench`)."""
