/* What the files that use OpenImageIO share. They are C++ because it has no C interface; no
 * exception leaves them. */
#ifndef CS_IMAGE_OIIO_H
#define CS_IMAGE_OIIO_H

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagecache.h>
#include <OpenImageIO/imageio.h>

#include <exception>
#include <new>
#include <string>

#include "image/image_io.h"

using OIIO::ImageBuf;
using OIIO::ImageSpec;
using OIIO::TypeDesc;

/* Runs `work` and turns its exceptions into a status. */
template <typename Work> clshear_status guarded(const char *path, cs_error *error, Work work)
{
    try {
        return work();
    } catch (const std::bad_alloc &) {
        return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "%s: out of memory", path);
    } catch (const std::exception &exception) {
        return cs_fail(error, CLSHEAR_BAD_FILE, "%s: %s", path, exception.what());
    }
}

/* The first line of an OpenImageIO message, for one-line errors. */
inline std::string first_line(const std::string &text)
{
    return text.substr(0, text.find('\n'));
}

/* Drops the cached contents of the file, which may have changed on disk. */
inline void forget(const char *path)
{
    OIIO::ImageCache::create(true)->invalidate(OIIO::ustring(path), true);
}

#endif
