"""Runs a part as pythonfmu's exporter does, with the standard library alone: for Pythons without FMPy.

``pythonX.Y -I -B bare_part.py`` reads a job from standard input and prints outputs as hexadecimal floats.
"""

import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "build"))

from bare_host import load


def main():
    job = json.load(sys.stdin)
    sys.path.pop(0)
    slave = load(job["resources"])(instance_name="bare", resources=job["resources"], logger=0, visible=0)
    slave.setup_experiment(0.0, None, None)
    slave.enter_initialization_mode()
    slave.exit_initialization_mode()
    rows = []
    for place in range(job["count"]):
        slave.set_real(job["inputs"], [0.3 * place, 30.0 + place][:len(job["inputs"])])
        done = slave.do_step(1e-3 * place, 1e-3)
        rows.append([done] + [value.hex() for value in slave.get_real(job["outputs"])])
    messages = [(int(each.status), each.msg) for each in slave._get_log_queue()]
    print(json.dumps({"rows": rows, "messages": messages, "path": job["resources"] in sys.path,
                      "third": sorted(name for name in sys.modules if name.split(".")[0] in ("numpy", "pydantic"))}))


if __name__ == "__main__":
    main()
