"""An FMU through bare FMPy, the kernel called alike, and the exercise that both go through.

Floats travel as hexadecimal text, equal to the last bit.
"""

import random
from pathlib import Path

OK, WARNING, DISCARD, ERROR, FATAL = range(5)


class Host:
    """One instance of an FMU in an unpacked directory, and the messages it sent."""

    def __init__(self, unpacked, name="instance", logging=True):
        from fmpy import calloc, free, read_model_description
        from fmpy.fmi2 import (
            FMU2Slave,
            fmi2CallbackAllocateMemoryTYPE,
            fmi2CallbackFreeMemoryTYPE,
            fmi2CallbackFunctions,
            fmi2CallbackLoggerTYPE,
        )

        self.description = read_model_description(str(unpacked), validate=False)
        self.variables = {each.name: each for each in self.description.modelVariables}
        self.messages = []
        self.callbacks = fmi2CallbackFunctions()  # has to live as long as the instance
        self.callbacks.logger = fmi2CallbackLoggerTYPE(self._log)
        self.callbacks.allocateMemory = fmi2CallbackAllocateMemoryTYPE(calloc)
        self.callbacks.freeMemory = fmi2CallbackFreeMemoryTYPE(free)
        self.slave = FMU2Slave(guid=self.description.guid, unzipDirectory=str(unpacked), instanceName=name,
                               modelIdentifier=self.description.coSimulation.modelIdentifier)
        self.slave.instantiate(callbacks=self.callbacks, loggingOn=logging)

    def _log(self, _environment, _instance, status, category, text):
        self.messages.append((status, (category or b"").decode(), text.decode()))

    def reference(self, name):
        return [self.variables[name].valueReference]

    def set(self, name, value):
        kind = self.variables[name].type
        getattr(self.slave, f"set{kind}")(self.reference(name), [value])

    def get(self, name):
        kind = self.variables[name].type
        return getattr(self.slave, f"get{kind}")(self.reference(name))[0]

    def initialize(self, values=None):
        self.slave.setupExperiment(startTime=0.0)
        self.slave.enterInitializationMode()
        for name, value in (values or {}).items():
            self.set(name, value)
        self.slave.exitInitializationMode()

    def step(self, t, h):
        """Status of the step."""
        from fmpy.fmi1 import FMICallException

        try:
            self.slave.doStep(currentCommunicationPoint=t, communicationStepSize=h)
        except FMICallException as error:
            return error.status
        return OK

    def outputs(self):
        return [float(self.get(name)).hex() for name, each in self.variables.items() if each.causality == "output"]

    def close(self):
        self.slave.terminate()
        self.slave.freeInstance()


class Direct:
    """`cardan_kernel.Driveline` of this process, called like a `Host`."""

    def __init__(self, driveline, variables):
        self.driveline, self.variables = driveline, variables

    def set(self, name, value):
        self.driveline.set(name, value)

    def initialize(self, values):
        self.driveline.setup_experiment(0.0)
        self.driveline.enter_initialization_mode()
        for name, value in values.items():
            self.set(name, value)
        self.driveline.exit_initialization_mode()

    def step(self, t, h):
        return OK if self.driveline.do_step(t, h) else DISCARD

    def outputs(self):
        return [float(self.driveline.get(each.name)).hex() for each in self.variables if each.causality == "output"]


# A spatial pair, compliant, with crosses and friction: every part of the kernel has work to do.
CASE = {
    "joint1.angle": 0.35, "joint2.angle": 0.26, "shaft.yoke_phase": 0.7, "shaft.plane_twist": -0.4,
    "joint1.cross.inertia_a": 1e-3, "joint1.cross.inertia_b": 2e-3, "joint1.cross.inertia_m": 1.5e-3,
    "joint1.trunnion.damping_a": 0.01, "joint2.trunnion.friction": 0.3, "output.damping": 0.05,
    "initial.speed": 100.0, "initial.angle": 0.2, "initial.twist": 1e-3, "hold.degree": 5,
}


def exercise(host, steps=40, begin=0):
    """Step with changing lengths, torques and angles; gives the outputs after each step."""
    chance = random.Random(begin)
    found = []
    for place in range(begin, begin + steps):
        h = chance.choice((1e-3, 2e-3, 5e-4))
        host.set("input.torque", 200.0 + 80.0 * chance.uniform(-1.0, 1.0))
        host.set("input.torque.by_speed", -0.1)
        host.set("output.torque", 50.0 * chance.random())
        host.set("joint1.angle.der1", 0.1 * (-1) ** place)
        status = host.step(1e-3 * place, h)
        found.append([status, *host.outputs()])
    return found


def unpack(fmu, directory):
    from fmpy import extract

    extract(fmu, str(directory))
    return Path(directory)
