"""The commands of `octafield`, their options and what they print."""
