"""``cardan scenes``: what can be simulated out of the box."""

from __future__ import annotations

import typer

from cardan.cli.failures import expected_errors


def scenes() -> None:
    """List the scenes that come with the package; `cardan simulate` takes their names."""
    with expected_errors():
        from cardan.scenario import Scenario

        loaded = [Scenario.load(name) for name in Scenario.shipped()]
    width = max((len(scenario.name) for scenario in loaded), default=0)
    for scenario in loaded:
        typer.echo(f"{scenario.name:<{width}}  {scenario.stop_time:>7g} s  {scenario.title}")
    if loaded:
        typer.echo(f"\nThe files to copy from stand in {loaded[0].base}")
