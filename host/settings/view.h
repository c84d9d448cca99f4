/* The camera and lens that settings describe. */
#ifndef CS_SETTINGS_VIEW_H
#define CS_SETTINGS_VIEW_H

#include "optics/view.h"
#include "settings/settings.h"

/* What is not set is 0. The image of an image aperture is that of the settings. Eye and target
 * become relative to `origin`, 3 numbers: that of the scene. */
void cs_view_of(const clshear_settings *settings, const double *origin, cs_view *view);

#endif
