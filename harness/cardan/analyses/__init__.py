"""Analyses of drivelines: frequency response about a rotating operating point, stability, orders.

They take scenarios and arrays and return result objects; plots take result objects. The equations come from the
kernel (`cardan_kernel.analysis`) or, where it is said so, from an FMU through FMI alone.
"""
