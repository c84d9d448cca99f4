#include "settings/view.h"

void cs_view_of(const clshear_settings *settings, const double *origin, cs_view *view)
{
    static const double zero[3] = {0.0, 0.0, 0.0};
    if (origin == NULL) origin = zero;
    for (int axis = 0; axis < 3; axis++) {
        view->eye[axis] = (float)(cs_numbers(settings, EYE)[axis] - origin[axis]);
        view->target[axis] = (float)(cs_numbers(settings, TARGET)[axis] - origin[axis]);
        view->up[axis] = (float)cs_numbers(settings, UP)[axis];
    }
    view->fov_deg = (float)cs_number(settings, FOV);
    view->orthographic = (float)cs_number(settings, ORTHOGRAPHIC);
    for (int k = 0; k < 2; k++)
        view->tilt_deg[k] = (float)cs_numbers(settings, TILT)[k];
    view->lens_radius = (float)cs_number(settings, LENS_RADIUS);
    view->focal_distance = (float)cs_number(settings, FOCAL_DISTANCE);
    view->aperture = (clshear_aperture)cs_integer(settings, APERTURE);
    view->blades = (int)cs_integer(settings, BLADES);
    view->blade_rotation_deg = (float)cs_number(settings, BLADE_ROTATION);
    view->image = settings->aperture.luminance != NULL ? &settings->aperture : NULL;
    view->anamorphic = (float)cs_number(settings, ANAMORPHIC);
}
