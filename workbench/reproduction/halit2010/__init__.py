"""Experiments of Halit 2010, keyframes by motion saliency."""
