"""Independent references for the driveline; see README.md."""
