"""The world outside the FMU: engines, gearbox, loads and the driver, as stateless functions of explicit state."""
