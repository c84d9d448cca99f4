/* Pi in double precision; CS_PI of the device headers is the float. */
#ifndef CS_BASE_PI_H
#define CS_BASE_PI_H

#define CS_PI_DOUBLE 3.14159265358979323846

#endif
