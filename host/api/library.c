/* Public functions without an object: version, status, samplers. */
#include "api/arguments.h"
#include "clshear/analysis.h"
#include "clshear/clshear.h"
#include "pattern/pattern.h"

/* Public structs end without padding: a member more makes them larger, so that their size tells
 * whether a caller has set it. */
#define CS_ENDS_WITH(type, last)                                                        \
    _Static_assert(offsetof(type, last) + sizeof(((type *)NULL)->last) == sizeof(type), \
                   #type " ends without padding")
CS_ENDS_WITH(clshear_fit, slope_high);
CS_ENDS_WITH(clshear_film_info, full_height);
CS_ENDS_WITH(clshear_integrand, extent);
CS_ENDS_WITH(clshear_light, edge2);
CS_ENDS_WITH(clshear_material, reserved);
CS_ENDS_WITH(clshear_mesh, normals_to);
CS_ENDS_WITH(clshear_progress, noise_pixel);
CS_ENDS_WITH(clshear_reach, points);
CS_ENDS_WITH(clshear_sampler_info, is_default);
CS_ENDS_WITH(clshear_scene_info, high);
CS_ENDS_WITH(clshear_setting_info, most);

const char *clshear_version(void)
{
    return CLSHEAR_VERSION_STRING;
}

int clshear_version_number(void)
{
    return CLSHEAR_VERSION;
}

const char *clshear_status_name(clshear_status status)
{
    switch (status) {
#define CS_STATUS_NAME(identifier, number, meaning) \
    case CLSHEAR_##identifier:                      \
        return #identifier;
        CLSHEAR_STATUS_LIST(CS_STATUS_NAME)
    default:
        return NULL;
    }
}

const char *clshear_message(void)
{
    return cs_thread_error()->message;
}

int clshear_sampler_describe(size_t index, clshear_sampler_info *info)
{
    if (index >= CS_SAMPLER_COUNT || info == NULL) return 0;
    const cs_u32 number = (cs_u32)index;
    const clshear_sampler_info described = {.name = cs_sampler_name(number),
                                            .about = cs_sampler_about(number),
                                            .progressive = cs_sampler_is_progressive(number),
                                            .is_default = number == cs_sampler_default()};
    cs_struct_out(info, &described, sizeof described);
    return 1;
}
