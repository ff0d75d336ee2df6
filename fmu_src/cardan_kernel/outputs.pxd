cimport cython

from .joint cimport Joint
from .motion cimport Motion

cdef extern from "math.h":
    double sin(double x) noexcept
    double cos(double x) noexcept
    double sqrt(double x) noexcept
    double atan(double x) noexcept

cdef int OUT_ANGLE_IN, OUT_SPEED_IN, OUT_ACCELERATION_IN, OUT_REACTION, OUT_ANGLE, OUT_SPEED, OUT_ACCELERATION
cdef int OUT_SHAFT_TORQUE, OUT_TWIST, OUT_SPEED_A, OUT_SPEED_B, OUT_RATIO1, OUT_RATIO2, OUT_RATIO, OUT_JOINT1
cdef int OUT_JOINT2, OUT_INERTIA_TORQUE, OUT_POWER_IN, OUT_POWER_OUT, OUT_POWER_LOSS, OUT_KINETIC, OUT_STRAIN
cdef int OUT_RESIDUAL, OUT_NONUNIFORMITY, OUT_EQUIVALENT, RADIUS1, RADIUS2

@cython.locals(whole=double, rest=double)
cdef void write_motion(Motion motion, double[::1] z) noexcept
cdef void write_joint(Joint joint, double speed, double torque_in, double torque_out, double radius, double[::1] z,
                      int place) noexcept
@cython.locals(kinetic=double, strain=double)
cdef void write_loads(Motion motion, double[::1] z) noexcept
@cython.locals(c1=double, c2=double, cd=double, sd=double, one=double, apart=double, q=double, u=double, excess=double)
cdef void write_layout(Motion motion, double[::1] z) noexcept
