cimport cython

cdef extern from "math.h":
    double sin(double x) noexcept
    double cos(double x) noexcept
    double sqrt(double x) noexcept
    double fabs(double x) noexcept
    double atan2(double y, double x) noexcept

cdef double SMOOTHING_RATE, INFINITE_TIME

@cython.final
cdef class Joint:
    cdef double inertia_a, inertia_b, inertia_m, damping_a, damping_b, coulomb
    cdef bint rough, crossed, swinging
    cdef double beta, beta1, beta2, c, s, versine
    cdef double sp, cp, D, r, rp, g, rb, gb, jc, jcp, jcb
    cdef double along_a, along_b, rate_a, rate_b, drag, drag_power

    cdef void equip(self, double inertia_a, double inertia_b, double inertia_m,
                    double damping_a, double damping_b, double coulomb) noexcept
    @cython.locals(half=double)
    cdef void bend(self, double beta, double beta1, double beta2) noexcept
    @cython.locals(c=double, s=double, over=double, both=double)
    cdef void turn(self, double sp, double cp) noexcept
    @cython.locals(c=double, s=double, D=double, plane=double, top=double, dD=double, dtop=double, bD=double,
                   btop=double)
    cdef void _turn_cross(self, double sp, double cp, double d2) noexcept
    @cython.locals(b1=double)
    cdef double bias(self, double w) noexcept
    @cython.locals(root=double)
    cdef void slide(self, double w) noexcept
    @cython.locals(a=double, b=double, moment_a=double, moment_b=double)
    cdef void friction(self, double w) noexcept
    @cython.locals(speed=double, width=double, turning=double, reversing=double, near=double, leaving=bint)
    cdef double reach(self, double w, double dw) noexcept
    cdef double lead(self) noexcept
    cdef double couple_in(self, double torque) noexcept
    cdef double couple_out(self, double torque) noexcept
    @cython.locals(t=double, a=double, b=double, into=double, out=double)
    cdef double trunnion_force(self, double torque_in, double torque_out, double radius) noexcept
