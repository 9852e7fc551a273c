"""Robots on disk."""
