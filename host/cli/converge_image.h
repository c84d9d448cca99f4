/* Convergence of whole images. */
#ifndef CS_CLI_CONVERGE_IMAGE_H
#define CS_CLI_CONVERGE_IMAGE_H

#include "cli/converge.h"

typedef struct cli_view {
    clshear_context *context;
    clshear_scene *scene;
    clshear_camera camera;
} cli_view;

/* Options of a render of `pattern` samples in each replicate, as the flags say. */
clshear_options cli_converge_options(const cli_converge_job *job, const char *sampler,
                                     clshear_shear shear, uint32_t pattern);

/* A series for each sampler and shear: the variance of one pattern, mean over pixels and colours.
 */
int cli_study_image(const cli_converge_job *job, const cli_view *view, cli_study *study);

#endif
