/* Public functions without an object: version, status, samplers. */
#include "api/arguments.h"
#include "clshear/clshear.h"
#include "pattern/pattern.h"

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
