cimport cython

from .stepper cimport Stepper

cdef extern from "math.h":
    bint isfinite(double x) noexcept

cdef enum:
    FIXED = 1
    TUNABLE = 2
    INPUT = 3
    OUTPUT = 4
    REAL = 10
    INTEGER = 20
    BOOLEAN = 30
    WARNING = 1
    ERROR = 3

cdef int VARIABLE_COUNT, FIRST_INPUT, FIRST_OUTPUT, FIRST_LOAD_OUTPUT, FIRST_LAYOUT_OUTPUT, FIRST_COUNTER

cdef class Values:
    cdef object log
    cdef readonly str last_error
    cdef str pending
    cdef bint stale
    cdef Stepper stepper
    cdef double[::1] z
    cdef int kinds[128]

    @cython.locals(z='double[::1]', place=int, reference=long, value=double, access=int)
    cdef set_values(self, int kind, references, values)
    @cython.locals(z='double[::1]')
    cdef set_parameter(self, long reference, double value, int access)
    @cython.locals(z='double[::1]')
    cdef double value(self, long reference, int kind)
    cdef compute(self, int group)
