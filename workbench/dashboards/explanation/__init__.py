"""The optimizer explained, step by step, on one sample's error landscape."""
