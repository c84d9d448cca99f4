#include "optics/optics.h"

#include <math.h>

#include "clshear/device/disk.h"
#include "optics/aperture_kinds.h"

float cs_optics_unit(const cs_view *camera)
{
    const float blades = camera->blades > 2 ? (float)camera->blades : 3.0f;
    switch (camera->aperture) {
    case CLSHEAR_APERTURE_DISK:
        return sqrtf(CS_PI);
    case CLSHEAR_APERTURE_POLYGON:
        return sqrtf(0.5f * blades * sinf(2.0f * CS_PI / blades));
    default:
        return 2.0f;
    }
}

float cs_lens_extent(const cs_view *camera)
{
    return 2.0f / cs_optics_unit(camera);
}

/* Reach and deviation of a disk of area 1 or a square. */
static void set_extent(cs_optics *optics, cs_f32 reach, cs_f32 deviation)
{
    for (int axis = 0; axis < 2; axis++) {
        optics->half_width[axis] = reach;
        optics->deviation[axis] = deviation;
    }
}

static clshear_status make_aperture(const cs_view *camera, cs_optics_tables *tables,
                                    cs_error *error)
{
    switch (camera->aperture) {
    case CLSHEAR_APERTURE_DISK:
        set_extent(&tables->optics, CS_DISK_RADIUS, 0.5f * CS_DISK_RADIUS);
        return CLSHEAR_OK;
    case CLSHEAR_APERTURE_SQUARE:
        set_extent(&tables->optics, 0.5f, 0.288675135f);
        return CLSHEAR_OK;
    case CLSHEAR_APERTURE_POLYGON:
        return cs_polygon_make(camera->blades, camera->blade_rotation_deg, tables, error);
    case CLSHEAR_APERTURE_IMAGE:
        return cs_aperture_image_make(camera->image, tables, error);
    default:
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "aperture %d is not known",
                       (int)camera->aperture);
    }
}

clshear_status cs_optics_make(const cs_view *camera, clshear_filter filter, float width_px,
                              cs_optics_tables *tables, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    cs_optics *optics = &tables->optics;
    const float anamorphic = camera->anamorphic != 0.0f ? camera->anamorphic : 1.0f;
    tables->table = (cs_array){.item_size = sizeof(cs_f32)};
    CS_REQUIRE(anamorphic >= 0.01f && anamorphic <= 100.0f, CLSHEAR_BAD_ARGUMENT,
               "anamorphic ratio %g: must be 0.01 to 100", (double)anamorphic);
    CS_TRY(cs_filter_make(filter, width_px, tables, error));
    CS_TRY(make_aperture(camera, tables, error));
    optics->aperture = (cs_u32)camera->aperture;
    optics->squeeze = 1.0f / anamorphic;
    optics->closed =
        filter == CLSHEAR_FILTER_BOX && optics->filter_width == 1.0f &&
        (camera->aperture == CLSHEAR_APERTURE_DISK || camera->aperture == CLSHEAR_APERTURE_SQUARE);
done:
    return status;
}

void cs_optics_free(cs_optics_tables *tables)
{
    cs_array_free(&tables->table);
}
