/* Reads EXR pictures with all their channels and metadata. */
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <unistd.h>

#include "base/output_file.h"
#include "image/oiio.h"

namespace
{

/* Copies a text, an integer, a float or a matrix; returns false for other types. */
bool copy_attribute(const OIIO::ParamValue &source, cs_attribute *target)
{
    std::snprintf(target->name, sizeof target->name, "%s", source.name().c_str());
    if (source.type() == TypeDesc::STRING) {
        target->kind = CS_ATTRIBUTE_TEXT;
        target->text = strdup(source.get_string().c_str());
        if (target->text == nullptr) throw std::bad_alloc();
    } else if (source.type() == TypeDesc::INT) {
        target->kind = CS_ATTRIBUTE_INT;
        target->integer = source.get_int();
    } else if (source.type() == TypeDesc::FLOAT) {
        target->kind = CS_ATTRIBUTE_FLOAT;
        target->numbers[0] = source.get_float();
    } else if (source.type() == OIIO::TypeMatrix) {
        target->kind = CS_ATTRIBUTE_MATRIX;
        std::memcpy(target->numbers, source.data(), sizeof target->numbers);
    } else {
        return false;
    }
    return true;
}

template <typename Item> Item *allocate(size_t count)
{
    auto *items = static_cast<Item *>(std::calloc(count > 0 ? count : 1, sizeof(Item)));
    if (items == nullptr) throw std::bad_alloc();
    return items;
}

void describe(const ImageSpec &spec, cs_loaded_picture *loaded)
{
    cs_picture &picture = loaded->picture;
    picture.width = spec.width;
    picture.height = spec.height;
    picture.x = spec.x;
    picture.y = spec.y;
    picture.full_width = spec.full_width;
    picture.full_height = spec.full_height;
    picture.channel_count = static_cast<size_t>(spec.nchannels);
    loaded->names = allocate<char[32]>(picture.channel_count);
    loaded->name_list = allocate<const char *>(picture.channel_count);
    loaded->plane_list = allocate<const float *>(picture.channel_count);
    loaded->attributes = allocate<cs_attribute>(spec.extra_attribs.size());
    for (const OIIO::ParamValue &attribute : spec.extra_attribs)
        if (copy_attribute(attribute, &loaded->attributes[picture.attribute_count]))
            picture.attribute_count++;
    picture.names = loaded->name_list;
    picture.planes = loaded->plane_list;
    picture.attributes = loaded->attributes;
}

/* Whether a file begins as EXR files do. OpenImageIO would read any format, whatever the name: a
 * few bytes of WebP become gigabytes of pixels. */
bool is_exr(const char *path)
{
    static const unsigned char mark[4] = {0x76, 0x2f, 0x31, 0x01};
    unsigned char first[sizeof mark] = {0};
    std::FILE *stream = std::fopen(path, "rb");
    if (stream == nullptr) return false;
    const size_t count = std::fread(first, 1, sizeof first, stream);
    std::fclose(stream);
    return count == sizeof first && std::memcmp(first, mark, sizeof mark) == 0;
}

clshear_status read_picture(const char *path, cs_loaded_picture *loaded, cs_error *error)
{
    if (access(path, R_OK) != 0)
        return cs_fail(error, CLSHEAR_BAD_FILE, "%s: cannot be opened: %s", path,
                       std::strerror(errno));
    const char *flaw = cs_not_a_file(path);
    if (flaw != nullptr) return cs_fail(error, CLSHEAR_BAD_FILE, "%s: %s", path, flaw);
    if (!is_exr(path))
        return cs_fail(error, CLSHEAR_BAD_FILE, "%s: is no EXR file, as clshear writes them", path);
    forget(path);
    ImageBuf source(path);
    if (!source.read(0, 0, true, TypeDesc::FLOAT))
        return cs_fail(error, CLSHEAR_BAD_FILE, "%s: %s", path, reason_of(source, path).c_str());
    describe(source.spec(), loaded);
    const size_t channels = loaded->picture.channel_count;
    const size_t pixels =
        static_cast<size_t>(source.spec().width) * static_cast<size_t>(source.spec().height);
    const auto *values = static_cast<const float *>(source.localpixels());
    loaded->pixels = allocate<float>(channels * pixels);
    for (size_t c = 0; c < channels; c++) {
        std::snprintf(loaded->names[c], sizeof loaded->names[c], "%s",
                      source.spec().channelnames[c].c_str());
        loaded->name_list[c] = loaded->names[c];
        loaded->plane_list[c] = loaded->pixels + c * pixels;
        for (size_t p = 0; p < pixels; p++)
            loaded->pixels[c * pixels + p] = values[p * channels + c];
    }
    return CLSHEAR_OK;
}

} // namespace

extern "C" clshear_status cs_image_read(const char *path, cs_loaded_picture *loaded,
                                        cs_error *error)
{
    clshear_status status = guarded(path, error, [&] { return read_picture(path, loaded, error); });
    if (status != CLSHEAR_OK) cs_image_free(loaded);
    return status;
}

extern "C" void cs_image_free(cs_loaded_picture *loaded)
{
    for (size_t i = 0; i < loaded->picture.attribute_count; i++)
        std::free(loaded->attributes[i].text);
    std::free(loaded->names);
    std::free(loaded->name_list);
    std::free(loaded->plane_list);
    std::free(loaded->attributes);
    std::free(loaded->pixels);
    *loaded = cs_loaded_picture{};
}
