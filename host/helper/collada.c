#include "helper/collada.h"

#include <string.h>
#include <strings.h>

#include "helper/xml.h"

int cs_is_collada(const char *path)
{
    const char *dot = strrchr(path, '.');
    return dot != NULL && strcasecmp(dot, ".dae") == 0;
}

clshear_status cs_collada_tidy(cs_bytes *bytes, const char *path, cs_error *error)
{
    const clshear_status status = cs_bytes_to_utf8(bytes, path, error);
    size_t kept = 0;
    if (status != CLSHEAR_OK) return status;
    for (size_t i = 0; i < bytes->size; i++) {
        while (bytes->data[i] == '<' && kept > 0 && cs_xml_is_blank(bytes->data[kept - 1]))
            kept--;
        const int is_behind_tag = kept > 0 && bytes->data[kept - 1] == '>';
        if (!is_behind_tag || !cs_xml_is_blank(bytes->data[i]))
            bytes->data[kept++] = bytes->data[i];
    }
    bytes->size = kept;
    bytes->data[kept] = '\0';
    return CLSHEAR_OK;
}
