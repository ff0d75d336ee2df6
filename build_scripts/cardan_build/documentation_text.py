"""What the documentation page says in words: pieces of HTML without values."""

PURPOSE = """<p>CardanDriveline is the part of a drive train between an engine (or gearbox) and a load: an input
shaft, one or two universal (cardan, Hooke) joints, the intermediate shaft between them and an output shaft. It
computes the speed ripple of the joints, the torsional vibration of the shaft, the torques, the forces on the joints'
crosses and the energy balance. Engine and load stay outside: give the torque of both, read speed and angle of both
shafts.</p>
<ul>
<li><b>One joint</b>: leave <code>joint2.angle</code> at 0.</li>
<li><b>Rigid or compliant</b> intermediate shaft: <code>model.fidelity</code> = 1 or 2.</li>
<li><b>Driven by torque or by speed</b>: <code>model.drive</code> = 0 uses <code>input.torque</code>; 1 uses
<code>input.speed_command</code> and tells the torque that it takes as <code>input.reaction_torque</code>.</li>
<li><b>Moving joint angles</b>: the angles are inputs with first and second derivative.</li>
</ul>
"""

START = """<p>Connect <code>input.torque</code> (drives), <code>output.torque</code> (resists) and the two joint
angles; read <code>input.speed</code> and <code>output.speed</code>. All values are in SI units: angles in rad, speeds
in rad/s. In Python, with the package <code>fmpy</code>:</p>
<pre id="example">from fmpy import simulate_fmu

result = simulate_fmu(
    "CardanDriveline.fmu", stop_time=0.2, output_interval=1e-3, debug_logging=True,
    start_values={"joint1.angle": 0.35, "joint2.angle": 0.26, "initial.speed": 314.0,
                  "input.torque": 200.0, "output.torque": 200.0},
    output=["output.speed", "shaft.torque", "energy.residual"])
assert result["time"][-1] > 0.2 - 1e-9, "the FMU refused a step: its message says why"
print(result["output.speed"].min(), result["output.speed"].max())
</pre>
<p>Fixed parameters are set before initialization; tunable ones and all inputs at any communication point. Outputs
hold their values at the end of the step, and right after initialization. The communication step may change from step
to step; inside it the FMU integrates with steps of its own (DOP853, order 8) to <code>model.tolerance</code>, over
which a tolerance given by the importer wins. <code>energy.residual</code> is a live accuracy meter: it is what the
energy balance misses.</p>
"""

SIGNS = """<ul>
<li>e<sub>1</sub>, e<sub>2</sub>, e<sub>3</sub> point along the shafts from the input to the output. Angles, speeds
and torques of shaft i are right-handed about e<sub>i</sub>.</li>
<li><code>input.torque</code> drives: positive speeds the input shaft up. <code>output.torque</code> resists: positive
slows a positive speed down.</li>
<li>The bend β is never negative; its normal n follows from e<sub>j</sub> &times; e<sub>j+1</sub> = sin β<sub>j</sub>
n<sub>j</sub>. Bending the other way is a plane twist of 180°.</li>
<li>φ<sub>in</sub> = 0: the joint's input trunnion lies in the joint plane (the null plane of VDI 2722);
φ<sub>out</sub> = 0: the output trunnion stands normal to it. Where angles are counted from the normal, add 90°.</li>
<li>ψ (<code>shaft.yoke_phase</code>): from joint 1's output trunnion to joint 2's input trunnion. θ
(<code>shaft.plane_twist</code>): from n<sub>1</sub> to n<sub>2</sub>; 0 is the W layout, 180° the Z layout. Both
about e<sub>2</sub>.</li>
</ul>
"""

AFTER_EQUATIONS = """<p>A rigid shaft (<code>model.fidelity</code> = 1) has φ<sub>a</sub> = φ<sub>y</sub>, and
everything is referred to the input shaft. With <code>model.drive</code> = 1 the input motion is given and the first
equation yields the reaction torque. Coulomb friction is smoothed over 0.01 rad/s of trunnion rate. The inertia of a
cross is taken at the momentary joint angle. States are the input angle within one turn with a turn counter, the twist
and two speeds: torques stay as sharp after 10<sup>7</sup> turns as in the first.</p>
"""

HOLD = """<p>Values alone are what any FMI importer sends, and that is all that is needed: they are held over the
step. A held torque lags by half a step, though, and feeds energy into a vibration. Send more, and it is followed
inside the step:</p>
<table class="narrow"><tr><th>Input</th><th>What it does</th></tr>
<tr><td><code>.der1</code></td><td>The torque goes on with this slope (<code>hold.degree</code> 1, the default). It is
the derivative by time at constant shaft speed where <code>.by_speed</code> is given too, else the whole
derivative.</td></tr>
<tr><td><code>.by_speed</code></td><td>K = ∂T/∂ω: the torque follows the shaft's speed as it changes within the step.
Steep loads stay stable with it.</td></tr>
<tr><td><code>hold.degree</code></td><td>0: p is constant. 1: linear with <code>.der1</code>. 3 and 5: Hermite
polynomial through the last two or three communication points, values and slopes; the error falls with the fourth and
sixth power of the step. Begin with short steps: a polynomial is not used over more than eight times its
history.</td></tr>
<tr><td><code>hold.restart</code></td><td>Set true for the step that begins where a torque jumped: the history is
dropped. Set it false again afterwards.</td></tr>
</table>
<p><code>input.speed_command</code> and the joint angles are polynomials over the step in the same manner: value +
<code>.der1</code> s + <code>.der2</code> s²/2. A joint angle that moves needs its derivatives; one that only jumps
keeps the momenta and the shaft angles, but the speeds miss g dβ/dt.</p>
"""

STATE = """<p>The state can be read, restored and serialized (<code>canGetAndSetFMUstate</code>,
<code>canSerializeFMUstate</code>). It is complete: integrator, step size control and torque history are in it, so a
step that is repeated after a restore is equal to the last bit. Several instances are independent of each other.
<code>fmi2Reset</code> brings an instance back to its start values.</p>
"""

ERRORS = """<p>A value out of range, NaN or infinite, a joint at or beyond 90°, a fixed parameter set too late, a call
in the wrong order: the next step is refused with <code>fmi2Discard</code>. The message names the variable, its value,
the allowed range and what to do. The state stays as it was; after a correction or a restored state the run goes on.
Values are judged together at the next step, not as they are set.</p>
<p><b>Texts arrive only with debug logging on</b> (<code>loggingOn</code> of <code>fmi2Instantiate</code>;
<code>debug_logging=True</code> in FMPy). Log categories: <code>logAll</code> tells which kernel runs,
<code>logStatusWarning</code> what was accepted but probably not meant, <code>logStatusDiscard</code> and
<code>logStatusError</code> refusals and failures; <code>logStatusFatal</code> is the exporter's.</p>
"""

LIMITS = """<ul>
<li>Rotation about the shaft axes only: no bending, whirling or axial motion of the shafts, no backlash.</li>
<li>Joint angles lie in [0, 90°). 89.9° is accurate, 90° is refused.</li>
<li>Coulomb friction is smoothed over 0.01 rad/s: a stuck shaft creeps below that.</li>
<li>The compliant model with an extreme stiffness costs steps; above about 10<sup>9</sup> N.m/rad the rigid one is the
answer, to which it converges as 1/k.</li>
<li>Binaries for 64-bit Linux (glibc 2.32 or later) and 64-bit Windows; the importing process must have a Python, see
<a href="externalDependencies.txt">externalDependencies.txt</a>.</li>
</ul>
"""

TROUBLES = (
    ("A run ends early, without an error",
     "The importer took <code>fmi2Discard</code> for a wish to stop (<code>simulate_fmu</code> of FMPy does). Compare "
     "the last time with the stop time, switch debug logging on and read the message."),
    ("No messages at all",
     "Debug logging is off in the importer."),
    ("The process crashes while loading",
     "The folder that the FMU is unpacked to has one of <code>+ # % ;</code> or a letter beyond ASCII in its path. Use "
     "a temporary folder with plain letters; spaces are fine."),
    ("Loading fails with undefined symbols such as <code>Py_Initialize</code>",
     "The importer is no Python program. Load libpython first: link it, or set <code>LD_PRELOAD</code> to "
     "libpython3.x.so on Linux; on Windows python3.dll must be on the path."),
    ("<code>fmi2SetRealInputDerivatives</code> returns an error",
     "The exporter does not know it. Slopes are ordinary inputs here: <code>.der1</code> and <code>.by_speed</code>."),
    ("A vibration grows that should not",
     "Torques are held over a step that is too long. Send <code>.der1</code> and <code>.by_speed</code>, or shorten "
     "the step."),
    ("It is slow",
     "The first message says <i>interpreted kernel</i>: no compiled kernel inside fits this Python (3.11 or later on "
     "the platform of the build). Results are the same. In C and other hosts each call costs a few microseconds: read "
     "only the outputs you need."),
    ("An algebraic loop is reported",
     "The importer ignores the dependencies in the model description. At communication points no output depends "
     "directly on an input; in initialization accelerations, reaction torque and joint loads depend on the torques, "
     "angles and speeds do not."),
    ("Runs in threads interfere",
     "FMPy changes the current directory while it loads an FMU: load in one thread, or use processes."),
    ("The process aborts at its very end, after a good run",
     "Rare, and known of Python FMUs: write results before leaving."),
)

PORTS = """<p><code>terminalsAndIcons</code> describes both shaft ends as rotational flanges (FMI 2.0.4 and later;
others ignore the folder): <code>input</code> with the torque flowing in, <code>output</code> with the torque flowing
out. Their members are <code>phi</code> (angle), <code>w</code> (speed), <code>a</code> (acceleration) and
<code>tau</code> (torque) as in the Modelica Standard Library, and the torque's <code>tau_der1</code> and
<code>tau_by_speed</code>.</p>
"""
