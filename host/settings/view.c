#include "settings/view.h"

static void take_vector(const double *numbers, float *vector)
{
    for (int axis = 0; axis < 3; axis++)
        vector[axis] = (float)numbers[axis];
}

void cs_view_of(const clshear_settings *settings, cs_view *view)
{
    take_vector(cs_numbers(settings, EYE), view->eye);
    take_vector(cs_numbers(settings, TARGET), view->target);
    take_vector(cs_numbers(settings, UP), view->up);
    view->fov_deg = (float)cs_number(settings, FOV);
    view->lens_radius = (float)cs_number(settings, LENS_RADIUS);
    view->focal_distance = (float)cs_number(settings, FOCAL_DISTANCE);
    view->aperture = (clshear_aperture)cs_integer(settings, APERTURE);
    view->blades = (int)cs_integer(settings, BLADES);
    view->blade_rotation_deg = (float)cs_number(settings, BLADE_ROTATION);
    view->image = settings->aperture.luminance != NULL ? &settings->aperture : NULL;
    view->anamorphic = (float)cs_number(settings, ANAMORPHIC);
}
