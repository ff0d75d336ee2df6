cimport cython

cdef extern from "math.h":
    double sin(double x) noexcept
    double cos(double x) noexcept
    double fabs(double x) noexcept

cdef enum:
    MOST_HARMONICS = 96

@cython.final
cdef class Law:
    cdef double c0, c1, c2, order, value, slope, by_angle
    cdef int harmonics
    cdef bint plain
    cdef double rest[194]
    cdef double gain[194]

    cdef void polynomial(self, double c0, double c1, double c2) noexcept
    @cython.locals(i=int)
    cdef series(self, double order, list rest, list gain)
    @cython.locals(c1=double, s1=double, c=double, s=double, value=double, slope=double, turning=double, rate=double,
                   keep=double, n=int)
    cdef void take(self, double p, double w) noexcept
