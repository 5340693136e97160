"""The projection comparison: panels side by side, their settings and their quality."""
