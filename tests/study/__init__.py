"""Tests of user studies."""
