"""Does to an unpacked FMU what pythonfmu's exporter does, with the standard library alone.

``pythonX.Y -I -B bare_host.py`` reads ``{"resources": DIR, "names": {name: value reference}, ...}`` from standard
input. So Python versions can be tried for which no FMPy is installed.
"""

import json
import sys


def load(resources):
    """The slave's class: the exporter imports the module and runs its text a second time."""
    sys.path.insert(0, resources)
    with open(resources + "/slavemodule.txt") as stream:
        name = stream.readline().strip()
    module = __import__(name)
    local = {}
    with open(f"{resources}/{name}.py") as stream:
        exec(compile(stream.read(), name, "exec"), module.__dict__, local)
    derived = [key for key, each in local.items() if isinstance(each, type)
               and [base.__name__ for base in each.__mro__[1:]].count("Fmi2Slave")]
    return getattr(module, derived[0])


def main():
    job = json.load(sys.stdin)
    slave = load(job["resources"])(instance_name="bare", resources=job["resources"], logger=0, visible=0)
    names = job["names"]
    slave.setup_experiment(0.0, None, None)
    slave.enter_initialization_mode()
    for name, value in job["values"].items():
        setter = slave.set_integer if isinstance(value, int) else slave.set_real
        setter([names[name]], [value])
    slave.exit_initialization_mode()
    steps = []
    for place in range(20):
        slave.set_real([names["input.torque"]], [100.0 + 10.0 * place])
        done = slave.do_step(1e-3 * place, 1e-3)
        steps.append([done] + [value.hex() for value in slave.get_real(job["outputs"])])
    state = slave._get_fmu_state()
    slave._set_fmu_state(state)
    again = type(slave)._fmu_state_from_bytes(type(slave)._fmu_state_to_bytes(state)) == state
    slave.terminate()
    messages = [(int(each.status), each.category, each.msg) for each in slave._get_log_queue()]
    print(json.dumps({"steps": steps, "messages": messages, "state": again, "path": job["resources"] in sys.path}))


if __name__ == "__main__":
    main()
