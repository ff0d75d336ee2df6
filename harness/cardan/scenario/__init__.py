"""Scene files: what is simulated, with what, for how long."""

from cardan.scenario.problems import Problem, ScenarioError
from cardan.scenario.scenario import Scenario
from cardan.scenario.tables import COUPLINGS

__all__ = ["COUPLINGS", "Problem", "Scenario", "ScenarioError"]
