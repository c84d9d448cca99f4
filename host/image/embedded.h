/* Images that lie in memory, within the file of a scene. */
#ifndef CS_IMAGE_EMBEDDED_H
#define CS_IMAGE_EMBEDDED_H

#include "image/oiio.h"

/* The name of a file that makes OpenImageIO, which goes by names, read the image of `size` bytes by
 * its kind. Fails with one line that begins with `label` where that is none that can be read. */
clshear_status embedded_name(const char *label, const void *memory, size_t size, std::string &name,
                             cs_error *error);

#endif
