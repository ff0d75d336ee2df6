cimport cython

from .hold cimport Hold
from .integrator cimport Integrator
from .motion cimport Motion
from .tangent cimport Tangent

cdef extern from "math.h":
    double fabs(double x) noexcept
    double pow(double x, double y) noexcept

cdef int FIDELITY, DRIVE, TOLERANCE, INERTIA_IN, INERTIA_OUT, DAMPING_IN, DAMPING_OUT, INERTIA_A, INERTIA_B
cdef int STIFFNESS, DAMPING, YOKE_PHASE, PLANE_TWIST, CROSS1, CROSS2, START_ANGLE, START_SPEED, START_TWIST
cdef int START_TWIST_RATE, HOLD_DEGREE, HOLD_RESTART, TORQUE_IN, TORQUE_OUT, COMMAND, BEND1, BEND2

@cython.final
cdef class Stepper:
    cdef readonly object store
    cdef double[::1] z
    cdef Motion motion
    cdef Integrator integrator
    cdef Tangent tangent
    cdef double column[16]
    cdef double new_in, new_out, rate_in, rate_out, speed_in, speed_out, acceleration_in, acceleration_out

    @cython.locals(z='double[::1]', m=Motion, fast=double)
    cdef void configure(self)
    @cython.locals(z='double[::1]', m=Motion, y='double*', i=int, fast=double)
    cdef void start(self)
    cdef void forget_outputs(self)
    @cython.locals(z='double[::1]', m=Motion, it=Integrator, y='double*', v0=double, points=double, i=int, result=int)
    cdef int step(self, double h)
    @cython.locals(z='double[::1]', m=Motion, y='double*', degree=double, rate_in=double, rate_out=double,
                   slope_in=double, slope_out=double, w3=double, points=double, raised=bint, side=int, at=int,
                   torque=Hold, slope=double, u1=double, m1=double, u2=double, m2=double)
    cdef double hold(self, double h)
    @cython.locals(z='double[::1]', m=Motion, it=Integrator, y='double*', mean=double, i=int)
    cdef void remember(self, double h, double points)
    @cython.locals(z='double[::1]', i=int)
    cdef void push(self, double h, double points)
    @cython.locals(y='double*', i=int)
    cdef void look(self)
    cdef void refresh(self, int group)
    @cython.locals(z='double[::1]', m=Motion, i=int, j=int)
    cdef list columns(self)
