/* The names of texts in a film's metadata: lists them, and refuses names that files do not keep. */
#include <string.h>
#include <strings.h>

#include "film/film.h"

/* Attributes that EXR has of its own, and names that OpenImageIO takes for these or drops, whatever
 * their capitals. The test of films has them written and read. */
static const char *const reserved[] = {"aperture",
                                       "capDate",
                                       "channels",
                                       "chunkCount",
                                       "comments",
                                       "compression",
                                       "dataWindow",
                                       "description",
                                       "displayWindow",
                                       "envmap",
                                       "expTime",
                                       "ExposureTime",
                                       "FNumber",
                                       "keyCode",
                                       "lineOrder",
                                       "maxSamplesPerPixel",
                                       "owner",
                                       "planarconfig",
                                       "pixelAspectRatio",
                                       "screenWindowCenter",
                                       "screenWindowWidth",
                                       "tiles",
                                       "timeCode",
                                       "type",
                                       "worldToCamera",
                                       "worldToNDC",
                                       "worldtoscreen",
                                       "xDensity",
                                       "XResolution",
                                       "YResolution",
                                       "dwaCompressionLevel"};

static int is_reserved(const char *name)
{
    for (size_t i = 0; i < sizeof reserved / sizeof *reserved; i++)
        if (strcasecmp(reserved[i], name) == 0) return 1;
    return strchr(name, ':') != NULL; /* of a format, such as "png:" */
}

/* Whether the film has a number or a matrix of that name. */
static int is_number(const clshear_film *film, const char *name)
{
    const cs_attribute *attributes = film->attributes.items;
    for (size_t i = 0; i < film->attributes.count; i++)
        if (attributes[i].kind != CS_ATTRIBUTE_TEXT && strcasecmp(attributes[i].name, name) == 0)
            return 1;
    return 0;
}

/* The name that files would take this one for, whose capitals differ; NULL: there is none. */
static const char *same_in_files(const clshear_film *film, const char *name)
{
    static const char *const of_openimageio[] = {"Copyright", "DateTime", "ImageDescription"};
    const cs_attribute *attributes = film->attributes.items;
    for (size_t i = 0; i < sizeof of_openimageio / sizeof *of_openimageio; i++)
        if (strcasecmp(of_openimageio[i], name) == 0 && strcmp(of_openimageio[i], name) != 0)
            return of_openimageio[i];
    for (size_t i = 0; i < film->attributes.count; i++)
        if (strcasecmp(attributes[i].name, name) == 0 && strcmp(attributes[i].name, name) != 0)
            return attributes[i].name;
    return NULL;
}

const char *cs_film_text_name(const clshear_film *film, size_t index)
{
    const cs_attribute *attributes = film->attributes.items;
    for (size_t i = 0; i < film->attributes.count; i++)
        if (attributes[i].kind == CS_ATTRIBUTE_TEXT && index-- == 0) return attributes[i].name;
    return NULL;
}

clshear_status cs_film_check_name(const clshear_film *film, const char *name)
{
    cs_error *error = cs_thread_error();
    const size_t length = strlen(name), most = sizeof((cs_attribute *)NULL)->name - 1;
    if (length == 0 || length > most)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "metadata %.60s: the name has %zu bytes; it must have 1 to %zu", name,
                       length, most);
    if (is_reserved(name))
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "metadata %s: EXR keeps this name for itself; choose another", name);
    if (is_number(film, name))
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "metadata %s: is a number of the film; choose another name", name);
    const char *same = same_in_files(film, name);
    if (same != NULL)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "metadata %s: files do not tell this name from %s; write it so", name, same);
    return CLSHEAR_OK;
}
