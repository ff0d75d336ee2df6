"""The optional compiled kernel; everything else stands in pyproject.toml."""

import sys
from pathlib import Path

from setuptools import setup

ROOT = Path(__file__).resolve().parent
sys.path.insert(0, str(ROOT / "build_scripts"))

from cardan_build.extension import arguments  # noqa: E402 (needs the path above)

setup(**arguments(ROOT))
