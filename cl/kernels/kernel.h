/* How kernels are declared. Device only. */
#ifndef CS_KERNELS_KERNEL_H
#define CS_KERNELS_KERNEL_H

/* With CS_WORK_GROUP, a kernel is launched with work-groups of this size only. */
#ifdef CS_WORK_GROUP
#define CS_KERNEL __kernel __attribute__((reqd_work_group_size(CS_WORK_GROUP, 1, 1)))
#else
#define CS_KERNEL __kernel
#endif

#endif
