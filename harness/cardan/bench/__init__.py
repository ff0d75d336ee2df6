"""Measurements: speed against error, coupling, cost, and the hard cases."""
