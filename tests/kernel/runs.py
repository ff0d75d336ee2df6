"""Start and step a driveline in a test; whatever is refused fails the test."""

from cardan_kernel import VARIABLES


def start(kernel, values, tolerance=None):
    """A driveline with `values` by variable name, initialized."""
    driveline = kernel()
    driveline.setup_experiment(0.0, None, tolerance)
    driveline.enter_initialization_mode()
    for name, value in values.items():
        driveline.set(name, value)
    driveline.exit_initialization_mode()
    assert driveline.last_error == ""
    return driveline


def go(driveline, until, step, before=None, begin=0.0):
    """Step from `begin` to `until` (s); `before(t)` sets inputs at each communication point."""
    count = round((until - begin) / step)
    for i in range(count):
        if before is not None:
            before(begin + i * step)
        assert driveline.do_step(begin + i * step, step), driveline.last_error
    return driveline


def outputs(driveline):
    """All outputs by name."""
    return {v.name: driveline.get(v.name) for v in VARIABLES if v.causality == "output"}
