/* Begins the functions of a public header: multiply-adds are not fused from here on.
 *
 * If the device fused where the host does not, nearly half of all tuples would differ in their last
 * bit. Where fusing pays, the code says fma. Each header includes this file after its other
 * includes and fp_contract_restore.h at its end. It has no include guard on purpose.
 *
 * Compilers for the host do not read this pragma. Compile the host with -ffp-contract=off if it
 * must compute the same bits as the device. */
#if defined(__OPENCL_VERSION__) || defined(__OPENCL_C_VERSION__)
#pragma OPENCL FP_CONTRACT OFF
#endif
