"""The equations of the documentation page, in the notation of `mathml`; they are those of docs/PHYSICS.md."""

from __future__ import annotations

from typing import NamedTuple


class Equations(NamedTuple):
    """Equations on one subject.

    Attributes
    ----------
    title, text : str
        Heading, and an introduction in HTML.
    formulas : tuple of (str, str)
        Formula, and what it is in HTML.
    """

    title: str
    text: str
    formulas: tuple[tuple[str, str], ...]


ONE_JOINT = Equations(
    "One joint",
    "Bend angle β, c = cos β, s = sin β, input angle φ from the joint plane, D = 1 &minus; s² cos² φ.",
    (
        (r"\varphi_{out} = \varphi + atan2( (1-c) \sin\varphi \cos\varphi , c \cos^2\varphi + \sin^2\varphi )",
         "output angle; goes on over any number of turns"),
        (r"r = \frac{\partial\varphi_{out}}{\partial\varphi} = \frac{c}{D} \quad "
         r"r' = - \frac{c s^2 \sin 2\varphi}{D^2} \quad "
         r"g = \frac{\partial\varphi_{out}}{\partial\beta} = \frac{s \sin\varphi \cos\varphi}{D}",
         "ratio (<code>joint1.ratio</code>, from cos β to 1/cos β), its slope, and the effect of a moving joint angle"),
        (r"\omega_{out} = r \omega_{in} + g \frac{d \beta}{d t} \quad T_{in} = r T_{out}",
         "speeds, and torques of a joint without mass and friction"),
        (r"rate_{in} = \omega_{in} r s \cos\varphi \quad rate_{out} = \omega_{in} s \sin\varphi_{out}",
         "rates of the cross about its trunnions (<code>trunnion.rate_in</code>, <code>rate_out</code>)"),
        (r"J_c(\varphi) = \frac{J_a s^2 c^2 \cos^2\varphi + ( J_b s^2 \sin^2\varphi + J_m c^2 ) D}{D^2}",
         "inertia of the cross, as the input shaft feels it (<code>cross.inertia_a</code>, <code>_b</code>, "
         "<code>_m</code>)"),
        (r"P_{loss} = c_a rate_{in}^2 + c_b rate_{out}^2 "
         r"+ M_f ( | rate_{in} | + | rate_{out} | )",
         "power lost in the trunnions: viscous (<code>trunnion.damping_a</code>, <code>_b</code>) and Coulomb "
         "(<code>trunnion.friction</code>)"),
        (r"C_{in} = T_{in} \tan\beta \sin\varphi \quad C_{out} = T_{out} \tan\beta \cos\varphi_{out}",
         "secondary couples, along e<sub>1</sub> &times; a on the input shaft and e<sub>2</sub> &times; b on the "
         "output shaft; a, b: trunnion axes"),
    ),
)

DRIVELINE = Equations(
    "The driveline",
    "Input inertia J<sub>1</sub>, joint 1, shaft half J<sub>2a</sub>, spring k and damper d, shaft half "
    "J<sub>2b</sub>, joint 2, output inertia J<sub>3</sub>. φ<sub>1</sub> and ω<sub>1</sub> belong to the input shaft, "
    "φ<sub>a</sub> and ω<sub>a</sub> to the intermediate shaft at joint 1, φ<sub>y</sub> and ω<sub>y</sub> at joint 2; "
    "M<sub>1</sub> and M<sub>2</sub> are the torques of bearing drag and trunnion friction.",
    (
        (r"\varphi_{in,2} = \varphi_y + \psi - \theta + 90\text{°}",
         "input angle of joint 2, x in short, from yoke phase ψ and plane twist θ"),
        (r"T_s = k ( \varphi_a - \varphi_y ) + d ( \omega_a - \omega_y )",
         "<code>shaft.torque</code>; the twist itself is a state, not a difference of angles that have grown large"),
        (r"( J_1 + J_{2a} r_1^2 + J_{c1} ) \frac{d \omega_1}{d t} + \frac{1}{2} \frac{\partial}{\partial\varphi_1} "
         r"( J_{2a} r_1^2 + J_{c1} ) \omega_1^2 = T_{drive} - r_1 T_s - M_1",
         "input side"),
        (r"( J_{2b} + J_{c2} + J_3 r_2^2 ) \frac{d \omega_y}{d t} + \frac{1}{2} \frac{\partial}{\partial x} "
         r"( J_{c2} + J_3 r_2^2 ) \omega_y^2 = T_s - r_2 T_{load} - M_2",
         "output side"),
        (r"\frac{d \omega_a}{d t} = r \frac{d \omega_1}{d t} + r' \omega_1^2 "
         r"+ 2 \frac{\partial r}{\partial\beta} \omega_1 \frac{d \beta}{d t} "
         r"+ \frac{\partial g}{\partial\beta} ( \frac{d \beta}{d t} )^2 + g \frac{d^2 \beta}{d t^2}",
         "behind a joint whose angle moves"),
        (r"\varphi_3 = \varphi_{out,2} - 90\text{°} - ( \psi - \theta )",
         "<code>output.angle</code>: equals <code>input.angle</code> for a homokinetic pair"),
    ),
)

PAIR = Equations(
    "Two joints as one",
    "The pair is homokinetic (ratio always 1) where β<sub>1</sub> = β<sub>2</sub> and δ = ψ &minus; θ = 0 or 180°. "
    "In general, with c<sub>i</sub> = cos β<sub>i</sub>, the ratio of a rigid shaft lies in [1/κ, κ]:",
    (
        (r"\kappa + \frac{1}{\kappa} = \frac{( c_1^2 + c_2^2 ) \cos^2\delta + ( 1 + c_1^2 c_2^2 ) \sin^2\delta}"
         r"{c_1 c_2}", "extreme ratio κ of the pair"),
        (r"U = \kappa - \frac{1}{\kappa} \quad \cos\beta_{eq} = \frac{1}{\kappa}",
         "<code>layout.nonuniformity</code> and <code>layout.equivalent_angle</code>"),
    ),
)

HOLD = Equations(
    "",
    "",
    (
        (r"T(s) = p(s) + K \omega(s) \quad p(0) = u - K \omega(0)",
         "u: the torque input, K: its <code>.by_speed</code>, s: time since the communication point"),
    ),
)

GROUPS = (ONE_JOINT, DRIVELINE, PAIR)
