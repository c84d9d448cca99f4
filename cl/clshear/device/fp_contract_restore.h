/* Ends the functions of a public header: the including program gets OpenCL's default back, which
 * allows fusing.
 *
 * OpenCL C cannot save the state of a pragma. A program that has switched fusing off itself defines
 * CS_KEEP_FP_CONTRACT_OFF: then it stays off. This file has no include guard on purpose. */
#if (defined(__OPENCL_VERSION__) || defined(__OPENCL_C_VERSION__)) && \
    !defined(CS_KEEP_FP_CONTRACT_OFF)
#pragma OPENCL FP_CONTRACT ON
#endif
