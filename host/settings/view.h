/* Camera and lens of the settings. */
#ifndef CS_SETTINGS_VIEW_H
#define CS_SETTINGS_VIEW_H

#include "optics/view.h"
#include "settings/settings.h"

/* Fills `view`. Unset values are 0. The image of an image aperture belongs to the settings. Eye and
 * target become relative to `origin`, the scene's, 3 numbers; NULL: 0. */
void cs_view_of(const clshear_settings *settings, const double *origin, cs_view *view);

#endif
