"""``python -m cardan_build -o FILE``: build the FMU from a shell."""

from __future__ import annotations

import argparse
import logging
import sys
from pathlib import Path

from . import BuildError, build


def main(arguments: list[str] | None = None) -> int:
    """Build as told on the command line; 0 if a verified FMU stands at its place, 2 otherwise."""
    parser = argparse.ArgumentParser(prog="python -m cardan_build", description="Build CardanDriveline.fmu.")
    parser.add_argument("-o", "--output", type=Path, default=Path("CardanDriveline.fmu"), help="file to write")
    parser.add_argument("--portable", action="store_true", help="leave the compiled kernel out")
    parser.add_argument("--kernel", type=Path, action="append", default=[], metavar="DIR",
                        help="add compiled kernels made elsewhere (may be given again)")
    given = parser.parse_args(arguments)
    logging.basicConfig(level=logging.INFO, format="%(message)s", stream=sys.stderr)
    try:
        print(build(given.output, portable=given.portable, kernel_dirs=given.kernel))
    except BuildError as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
