"""Quality: how well an embedding keeps distances and neighbourhoods, and rebuilds samples."""
