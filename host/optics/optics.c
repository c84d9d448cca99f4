#include "optics/optics.h"

#include <math.h>

#include "clshear/device/disk.h"
#include "optics/aperture_kinds.h"

/* Size and marginal of one kind of aperture. */
typedef struct aperture {
    /* One unit of the lens coordinates, as a multiple of the lens radius. */
    float (*unit)(const cs_view *camera);

    /* Sets the kind of marginal, half-width and deviation; appends the rows of a tabulated
     * marginal. */
    clshear_status (*make)(const cs_view *camera, cs_optics_tables *tables, cs_error *error);
} aperture;

static float disk_unit(const cs_view *camera)
{
    (void)camera;
    return sqrtf(CS_PI);
}

static float square_unit(const cs_view *camera)
{
    (void)camera;
    return 2.0f;
}

static void set_symmetric(cs_optics *optics, cs_marginal_kind kind, cs_f32 half_width,
                          cs_f32 deviation)
{
    optics->marginal = kind;
    for (int axis = 0; axis < 2; axis++) {
        optics->half_width[axis] = half_width;
        optics->deviation[axis] = deviation;
    }
}

static clshear_status make_disk(const cs_view *camera, cs_optics_tables *tables, cs_error *error)
{
    (void)camera;
    (void)error;
    set_symmetric(&tables->optics, CS_MARGINAL_DISK, CS_DISK_RADIUS, 0.5f * CS_DISK_RADIUS);
    return CLSHEAR_OK;
}

static clshear_status make_square(const cs_view *camera, cs_optics_tables *tables, cs_error *error)
{
    (void)camera;
    (void)error;
    set_symmetric(&tables->optics, CS_MARGINAL_UNIFORM, 0.5f, 0.288675135f);
    return CLSHEAR_OK;
}

static const aperture apertures[] = {
    [CLSHEAR_APERTURE_DISK] = {disk_unit, make_disk},
    [CLSHEAR_APERTURE_SQUARE] = {square_unit, make_square},
    [CLSHEAR_APERTURE_POLYGON] = {cs_polygon_unit, cs_polygon_make},
    [CLSHEAR_APERTURE_IMAGE] = {square_unit, cs_aperture_image_make},
};

/* NULL for an unknown number. */
static const aperture *aperture_of(clshear_aperture number)
{
    return (size_t)number < sizeof apertures / sizeof *apertures ? &apertures[number] : NULL;
}

float cs_optics_unit(const cs_view *camera)
{
    const aperture *known = aperture_of(camera->aperture);
    return known != NULL ? known->unit(camera) : square_unit(camera);
}

float cs_lens_extent(const cs_view *camera)
{
    return 2.0f / cs_optics_unit(camera);
}

clshear_status cs_optics_make(const cs_view *camera, clshear_filter filter, float width_px,
                              cs_optics_tables *tables, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    cs_optics *optics = &tables->optics;
    const aperture *known = aperture_of(camera->aperture);
    const float anamorphic = camera->anamorphic != 0.0f ? camera->anamorphic : 1.0f;
    tables->table = (cs_array){.item_size = sizeof(cs_f32)};
    CS_REQUIRE(anamorphic >= 0.01f && anamorphic <= 100.0f, CLSHEAR_BAD_ARGUMENT,
               "anamorphic ratio %g: must be 0.01 to 100", (double)anamorphic);
    CS_REQUIRE(known != NULL, CLSHEAR_BAD_ARGUMENT, "aperture %d is not known",
               (int)camera->aperture);
    CS_TRY(cs_filter_make(filter, width_px, tables, error));
    CS_TRY(known->make(camera, tables, error));
    optics->squeeze = 1.0f / anamorphic;
    optics->has_closed_form =
        filter == CLSHEAR_FILTER_BOX && optics->filter_width == 1.0f &&
        (optics->marginal == CS_MARGINAL_UNIFORM || optics->marginal == CS_MARGINAL_DISK);
done:
    return status;
}

void cs_optics_free(cs_optics_tables *tables)
{
    cs_array_free(&tables->table);
}
