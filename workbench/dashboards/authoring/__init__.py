"""The authoring of motions on the plane of spatial keyframes."""
