/* What a scene and its picture measure, and what the render cost, on standard output. */
#ifndef CS_PROGRAM_REPORT_STATISTICS_H
#define CS_PROGRAM_REPORT_STATISTICS_H

#include <clshear/clshear.h>

/* settings: of the render, with the camera completed. */
void report_statistics(const clshear_context *context, const clshear_scene *scene,
                       const clshear_settings *settings, const clshear_film *film);

#endif
