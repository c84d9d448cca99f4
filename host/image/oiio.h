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

/* First line of what OpenImageIO says, without the file's name, which our messages begin with. */
inline std::string reason_of(const ImageBuf &image, const std::string &path)
{
    std::string reason = first_line(image.geterror());
    if (reason.find("could not find a format reader") != std::string::npos) reason.clear();
    const size_t advice = reason.find(" Also, it is not the name of an image format");
    if (advice != std::string::npos) reason.resize(advice);
    for (const std::string &named : {"Invalid image file \"" + path + "\": ", " (" + path + ")",
                                     " (\"" + path + "\")", "\"" + path + "\" ", path})
        for (size_t at = reason.find(named); at != std::string::npos; at = reason.find(named))
            reason.erase(at, named.size());
    return reason.empty() ? "not an image that can be read" : reason;
}

/* Drops the cached contents of the file, which may have changed on disk. */
inline void forget(const char *path)
{
    OIIO::ImageCache::create(true)->invalidate(OIIO::ustring(path), true);
}

#endif
