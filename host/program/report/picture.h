/* Remarks on a finished picture that cannot be what was meant. */
#ifndef CS_PROGRAM_REPORT_PICTURE_H
#define CS_PROGRAM_REPORT_PICTURE_H

#include "clshear/clshear.h"

/* Prints a line on standard error if the picture is black, if the scene fills hardly any of it, if
 * at the exposure of the settings most of it or of the scene is white when clipped, or nearly all
 * of it nearly black, and if it is sharp everywhere although a lens was given (`has_lens`). */
void remark_on_picture(const clshear_film *film, const clshear_settings *settings, int has_lens);

/* Prints what a render that rules may stop has promised and reached, and what is left. */
void remark_on_end(const clshear_film *film, const clshear_settings *settings);

#endif
