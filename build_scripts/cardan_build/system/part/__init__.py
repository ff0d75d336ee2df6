"""Engine, load, driver or moving joints of a scene as a co-simulation FMU of their own.

These modules travel in the FMU, together with ``cardan.models``: Python 3.9 and the standard library are all they
have there. The build renames them and their imports (docs/FMI.md, trap 1).
"""
