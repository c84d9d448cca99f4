/* What devices and buffers are made of: for the files of this folder alone. */
#ifndef CS_DEVICE_OBJECTS_H
#define CS_DEVICE_OBJECTS_H

#include <pthread.h>
#include <stdatomic.h>
#include <stdint.h>

#include "device/opencl.h"

typedef struct cs_recorder cs_recorder;

/* What is compiled for a set of features. */
typedef struct cs_variant {
    cl_program programs[CS_PROGRAM_COUNT];
    cl_kernel kernels[CS_KERNEL_COUNT];
    size_t local_sizes[CS_KERNEL_COUNT]; /* of each kernel's work-groups, once it is made */
    atomic_int has_run[CS_KERNEL_COUNT]; /* so that its driver has compiled all of it */
} cs_variant;

struct cs_device {
    pthread_mutex_t lock; /* of programs, kernels and their arguments, and of the recorder */
    cl_device_id id;
    cl_context context;
    cl_command_queue queue;
    cs_variant variants[CS_FEATURE_SETS];
    size_t local_size; /* of a work-group, where the kernel allows that many */
    int packet;
    int threads;
    int is_partition;
    char name[256];
    char driver[256];
    const cs_log *log;     /* NULL: none */
    atomic_int is_warned;  /* of the limit of memory */
    cs_recorder *recorder; /* of its launches; NULL: none */
    atomic_size_t held;    /* bytes of its buffers */
    atomic_size_t most;    /* that were held at once */
};

struct cs_buffer {
    atomic_int references;
    cl_mem memory;
    cs_device *device;
    size_t size;        /* bytes */
    uint64_t number;    /* of all buffers of the process, from 1 on */
    atomic_uint writes; /* how often the host has written to it */
};

#endif
