/* Periodograms of point sets by the direct transform: no grid, no interpolation.
 *
 * The exponential of a point at frequency (a, b) is the product of one of a and one of b, so those
 * are tabulated for each point first; what is left is a product of two complex matrices. */
#include "clshear/device/packet.h"
#include "kernels/frequencies.h"
#include "kernels/kernel.h"
#include "kernels/lanes.h"

/* Rows of the spectrum that a work-item sums up at once: their sums stay in registers. */
#define CS_SPECTRUM_ROWS 8

/* exp(-2 pi i f.x) for `count` points and the frequencies of each column: one work-item for
 * CS_PACKET columns of a point. Multiples of x are taken modulo 1 in whole numbers, exactly.
 *
 * Global size: at least count * columns / CS_PACKET. points: `count` points in [0, 1), of `stride`
 * coordinates. real, imaginary: count * columns floats each; columns is a multiple of CS_PACKET. */
CS_KERNEL void cs_exponentials(const uint count, const uint columns, const cs_frequencies set,
                               const uint stride, __global const float *points,
                               __global float *real, __global float *imaginary)
{
    uint blocks = columns / (uint)CS_PACKET;
    uint point = (uint)get_global_id(0) / blocks;
    uint column = (uint)get_global_id(0) % blocks * (uint)CS_PACKET;
    if (point >= count) return;
    cs_vuint index = (cs_vuint)(column) + CS_LANE_INDEX;
    cs_vuint part[3], rest = index / set.wide;
    part[0] = index - rest * set.wide;
    part[2] = rest / set.deep;
    part[1] = rest - part[2] * set.deep;
    cs_vuint turns = (cs_vuint)(0u);
    for (int i = 0; i < 3; i++) {
        float x = points[(size_t)point * stride + set.coordinate[i]];
        turns += ((cs_vuint)((uint)set.first[i]) + part[i] * (uint)set.step[i]) *
                 convert_uint(x * 4294967296.0f);
    }
    cs_vfloat half_turns = CS_OVER_LANES(convert_float)(cs_as_vint(turns)) * 0x1p-31f;
    size_t at = (size_t)point * columns + column;
    *(__global cs_loose_float *)(real + at) = cospi(half_turns);
    *(__global cs_loose_float *)(imaginary + at) = -sinpi(half_turns);
}

/* Adds the points to the sums of CS_PACKET x CS_SPECTRUM_ROWS frequencies and, after a set's last
 * points, |sum|^2 / N to their power.
 *
 * Global size: at least columns / CS_PACKET * rows / CS_SPECTRUM_ROWS. sums: rows * columns real
 * parts, then as many imaginary ones; power: rows * columns. The tables are those of
 * cs_exponentials, of x for `columns` frequencies and of y for `rows`. */
CS_KERNEL void cs_periodogram(const uint count, const uint columns, const uint rows,
                              const uint begins, const uint ends, const float scale,
                              __global const float *x_real, __global const float *x_imaginary,
                              __global const float *y_real, __global const float *y_imaginary,
                              __global float *sums, __global float *power)
{
    uint row_blocks = rows / (uint)CS_SPECTRUM_ROWS;
    uint column = (uint)get_global_id(0) / row_blocks * (uint)CS_PACKET;
    uint row = (uint)get_global_id(0) % row_blocks * (uint)CS_SPECTRUM_ROWS;
    if (column >= columns) return;
    cs_vfloat real[CS_SPECTRUM_ROWS], imaginary[CS_SPECTRUM_ROWS];
    __attribute__((opencl_unroll_hint(CS_SPECTRUM_ROWS))) for (int i = 0; i < CS_SPECTRUM_ROWS; i++)
    {
        real[i] = (cs_vfloat)(0.0f);
        imaginary[i] = (cs_vfloat)(0.0f);
    }
    for (uint point = 0; point < count; point++) {
        cs_vfloat a = *(__global const cs_loose_float *)(x_real + (size_t)point * columns + column);
        cs_vfloat b =
            *(__global const cs_loose_float *)(x_imaginary + (size_t)point * columns + column);
        __global const float *c = y_real + (size_t)point * rows + row;
        __global const float *d = y_imaginary + (size_t)point * rows + row;
        __attribute__((opencl_unroll_hint(CS_SPECTRUM_ROWS))) for (int i = 0; i < CS_SPECTRUM_ROWS;
                                                                   i++)
        {
            real[i] = fma(a, (cs_vfloat)(c[i]), fma(-b, (cs_vfloat)(d[i]), real[i]));
            imaginary[i] = fma(a, (cs_vfloat)(d[i]), fma(b, (cs_vfloat)(c[i]), imaginary[i]));
        }
    }
    __attribute__((opencl_unroll_hint(CS_SPECTRUM_ROWS))) for (int i = 0; i < CS_SPECTRUM_ROWS; i++)
    {
        size_t at = (size_t)(row + (uint)i) * columns + column;
        __global cs_loose_float *sum_real = (__global cs_loose_float *)(sums + at);
        __global cs_loose_float *sum_imaginary =
            (__global cs_loose_float *)(sums + (size_t)rows * columns + at);
        cs_vfloat re = begins ? real[i] : *sum_real + real[i];
        cs_vfloat im = begins ? imaginary[i] : *sum_imaginary + imaginary[i];
        *sum_real = re;
        *sum_imaginary = im;
        if (ends) *(__global cs_loose_float *)(power + at) += (re * re + im * im) * scale;
    }
}
