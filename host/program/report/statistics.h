/* What a render cost, on standard output. */
#ifndef CS_PROGRAM_REPORT_STATISTICS_H
#define CS_PROGRAM_REPORT_STATISTICS_H

#include <clshear/clshear.h>

void report_statistics(const clshear_context *context, const clshear_scene *scene,
                       const clshear_film *film);

#endif
