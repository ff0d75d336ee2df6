"""Fixtures of the kernel tests: both kernels and a way to run them."""

import cardan_kernel
import pytest

from tests.kernel.runs import start


@pytest.fixture(params=["interpreted", "compiled"])
def kernel(request):
    """Class `Driveline`, interpreted and compiled."""
    found = cardan_kernel.Interpreted if request.param == "interpreted" else cardan_kernel.Compiled
    if found is None:
        pytest.skip("the compiled kernel was not built: no C compiler at installation")
    return found


@pytest.fixture
def started():
    """The preferred kernel, started with values by name."""
    return lambda **options: start(cardan_kernel.Driveline, **options)
