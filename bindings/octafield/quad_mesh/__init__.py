"""Quads of wanted sizes along a cross field: `octafield quad-mesh`."""
