#include "image/embedded.h"

#include <cstring>

namespace
{

/* A kind of image, by the bytes that begin it, behind some that may be any. */
struct Kind {
    size_t offset;
    std::string magic;
    const char *extension; /* nullptr: cannot be read from memory */
    const char *name;
};

/* The kind of an image in memory, or nullptr: OpenImageIO goes by names of files. */
const Kind *kind_of(const void *memory, size_t size)
{
    static const Kind known[] = {
        {0, "\x89PNG", "png", "PNG"},      {0, "\xff\xd8\xff", "jpg", "JPEG"},
        {0, "RIFF", "webp", "WebP"},       {0, "\x76\x2f\x31\x01", "exr", "EXR"},
        {0, "#?", "hdr", "Radiance"},      {0, "GIF8", "gif", "GIF"},
        {0, "II*", "tif", "TIFF"},         {0, "MM", "tif", "TIFF"},
        {0, "BM", "bmp", "BMP"},           {0, "8BPS", "psd", "Photoshop"},
        {0, "DDS ", "dds", "DDS"},         {0, "\xabKTX 20", nullptr, "KTX2"},
        {0, "\xabKTX 11", nullptr, "KTX"}, {4, "ftypavif", nullptr, "AVIF"},
        {4, "ftyphei", nullptr, "HEIC"},   {4, "jP  ", nullptr, "JPEG 2000"},
        {0, "<svg", nullptr, "SVG"},       {0, "<?xml", nullptr, "SVG"}};
    for (const Kind &kind : known)
        if (size >= kind.offset + kind.magic.size() &&
            std::memcmp(static_cast<const char *>(memory) + kind.offset, kind.magic.data(),
                        kind.magic.size()) == 0)
            return &kind;
    static const Kind targa = {0, "TRUEVISION-XFILE.", "tga",
                               "Targa"}; /* ends the file, with a 0 */
    const size_t ends = targa.magic.size() + 1;
    return size >= ends && std::memcmp(static_cast<const char *>(memory) + size - ends,
                                       targa.magic.data(), targa.magic.size()) == 0
               ? &targa
               : nullptr;
}

} // namespace

clshear_status embedded_name(const char *label, const void *memory, size_t size, std::string &name,
                             cs_error *error)
{
    if (size == 0) return cs_fail(error, CLSHEAR_BAD_FILE, "%s: has no bytes", label);
    const Kind *kind = kind_of(memory, size);
    if (kind == nullptr)
        return cs_fail(error, CLSHEAR_BAD_FILE, "%s: not an image that can be read", label);
    if (kind->extension == nullptr)
        return cs_fail(error, CLSHEAR_BAD_FILE, "%s: %s images are not read from within a file",
                       label, kind->name);
    name = std::string("embedded.") + kind->extension;
    return CLSHEAR_OK;
}
