"""The keyframe inspector: what a selection keeps of a motion."""
