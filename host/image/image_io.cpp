/* C++ because OpenImageIO has no C interface. No exception leaves this file. */
#include "image/image_io.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imagecache.h>
#include <OpenImageIO/imageio.h>

#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <string>
#include <unistd.h>
#include <vector>

#include "base/output_file.h"

namespace
{

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
std::string first_line(const std::string &text)
{
    return text.substr(0, text.find('\n'));
}

/* Drops the cached contents of the file, which may have changed on disk. */
void forget(const char *path)
{
    OIIO::ImageCache::create(true)->invalidate(OIIO::ustring(path), true);
}

/* Any number of channels as RGBA: grey is repeated, alpha is 1 where there is none. Colours become
 * linear; files of integers (`is_integer`) that say nothing of their curve have that of sRGB. */
ImageBuf linear_rgba(const ImageBuf &source, bool is_integer, bool is_colour)
{
    const int channels = source.nchannels();
    const int alpha = source.spec().alpha_channel;
    const int grey = channels < (alpha >= 0 ? 4 : 3);
    const int order[4] = {0, grey ? 0 : 1, grey ? 0 : 2, alpha};
    const float fill[4] = {0.0f, 0.0f, 0.0f, 1.0f};
    ImageBuf rgba = OIIO::ImageBufAlgo::channels(source, 4, order, fill);
    std::string space = source.spec().get_string_attribute("oiio:ColorSpace");
    if (space.empty()) space = is_integer ? "sRGB" : "linear";
    if (space != "sRGB" || !is_colour) return rgba;
    return OIIO::ImageBufAlgo::colorconvert(rgba, "sRGB", "linear", false);
}

/* An image to read: a file, or `size` bytes of one at `memory` if that is not null. */
struct Source {
    const char *path;
    const char *label; /* what messages call it */
    const void *memory;
    size_t size;
};

/* The usual extension for the first bytes of an image, since OpenImageIO goes by names. */
const char *extension_for(const void *memory, size_t size)
{
    static const struct {
        const char *magic;
        size_t length;
        const char *extension;
    } known[] = {{"\x89PNG", 4, "png"}, {"\xff\xd8\xff", 3, "jpg"},
                 {"RIFF", 4, "webp"},   {"\x76\x2f\x31\x01", 4, "exr"},
                 {"#?", 2, "hdr"},      {"GIF8", 4, "gif"},
                 {"II*", 3, "tif"},     {"MM", 2, "tif"},
                 {"BM", 2, "bmp"}};
    for (const auto &entry : known)
        if (size >= entry.length && std::memcmp(memory, entry.magic, entry.length) == 0)
            return entry.extension;
    return "png";
}

/* First line of what OpenImageIO says, without the file's name, which our messages begin with. */
std::string reason_of(const ImageBuf &image, const std::string &path)
{
    std::string reason = first_line(image.geterror());
    const size_t advice = reason.find(" Also, it is not the name of an image format");
    if (advice != std::string::npos) reason.resize(advice);
    for (const std::string &named : {"Invalid image file \"" + path + "\": ", " (" + path + ")",
                                     " (\"" + path + "\")", "\"" + path + "\" ", path})
        for (size_t at = reason.find(named); at != std::string::npos; at = reason.find(named))
            reason.erase(at, named.size());
    return reason.empty() ? "not an image that can be read" : reason;
}

/* Colours as they are before alpha multiplies them. */
ImageBuf without_alpha(ImageBuf &&source)
{
    const ImageSpec &spec = source.spec();
    const std::string format(source.file_format_name());
    const bool associated = format == "openexr" || format == "tiff";
    if (spec.alpha_channel < 0 || !associated ||
        spec.get_int_attribute("oiio:UnassociatedAlpha") != 0)
        return std::move(source);
    return OIIO::ImageBufAlgo::unpremult(source);
}

/* Texels in one image: more are a damaged head rather than a picture. */
constexpr uint64_t most_texels = uint64_t(1) << 28;

/* An image as RGBA, its colours (`is_colour`) linear. */
clshear_status read_rgba(const Source &from, bool is_colour, ImageBuf &rgba, cs_error *error)
{
    if (from.memory == nullptr && cs_is_special_file(from.path))
        return cs_fail(error, CLSHEAR_BAD_FILE, "%s: is not a regular file", from.label);
    std::string path = from.path;
    if (from.memory != nullptr)
        path = std::string("embedded.") + extension_for(from.memory, from.size);
    else
        forget(from.path);
    OIIO::Filesystem::IOMemReader reader(const_cast<void *>(from.memory), from.size);
    ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    ImageBuf source(path, 0, 0, nullptr, &config, from.memory != nullptr ? &reader : nullptr);
    if (!source.init_spec(path, 0, 0))
        return cs_fail(error, CLSHEAR_BAD_FILE, "%s: %s", from.label,
                       reason_of(source, path).c_str());
    const uint64_t width = static_cast<uint64_t>(source.spec().width);
    const uint64_t height = static_cast<uint64_t>(source.spec().height);
    if (width == 0 || height == 0 || width > most_texels / height)
        return cs_fail(error, CLSHEAR_BAD_FILE, "%s: %d x %d texels: must be 1 to 2^28", from.label,
                       source.spec().width, source.spec().height);
    if (!source.read(0, 0, true, TypeDesc::FLOAT))
        return cs_fail(error, CLSHEAR_BAD_FILE, "%s: %s", from.label,
                       reason_of(source, path).c_str());
    const bool is_integer = !source.nativespec().format.is_floating_point();
    rgba = linear_rgba(without_alpha(std::move(source)), is_integer, is_colour);
    if (rgba.has_error())
        return cs_fail(error, CLSHEAR_BAD_FILE, "%s: %s", from.label,
                       first_line(rgba.geterror()).c_str());
    return CLSHEAR_OK;
}

/* Applies base and gain, and converts what are no colours. */
void convert_texels(const cs_texel_use &use, ImageBuf &rgba)
{
    if (use.base != 0.0f || use.gain != 1.0f) {
        const float gains[4] = {use.gain, use.gain, use.gain, 1.0f};
        const float bases[4] = {use.base, use.base, use.base, 0.0f};
        rgba = OIIO::ImageBufAlgo::mad(rgba, OIIO::cspan<float>(gains, 4),
                                       OIIO::cspan<float>(bases, 4));
    }
    if (use.kind == CS_TEXELS_COLOUR || use.kind == CS_TEXELS_DATA) return;
    std::vector<float> texels(4 * rgba.spec().image_pixels());
    if (!rgba.get_pixels(rgba.roi(), TypeDesc::FLOAT, texels.data())) return;
    if (!cs_texels_convert(use.kind, texels.data(), static_cast<size_t>(rgba.spec().width),
                           static_cast<size_t>(rgba.spec().height)))
        throw std::bad_alloc();
    rgba.set_pixels(rgba.roi(), TypeDesc::FLOAT, texels.data());
}

clshear_status read_texels(const Source &from, const cs_texel_use &use, cs_texels *texels,
                           cs_error *error)
{
    ImageBuf rgba;
    clshear_status status = read_rgba(from, use.kind == CS_TEXELS_COLOUR, rgba, error);
    if (status != CLSHEAR_OK) return status;
    convert_texels(use, rgba);
    const size_t width = static_cast<size_t>(rgba.spec().width);
    const size_t height = static_cast<size_t>(rgba.spec().height);
    auto *halves = static_cast<uint16_t *>(std::malloc(width * height * 4 * sizeof(uint16_t)));
    if (halves == nullptr) throw std::bad_alloc();
    if (!rgba.get_pixels(rgba.roi(), TypeDesc::HALF, halves)) {
        std::free(halves);
        return cs_fail(error, CLSHEAR_BAD_FILE, "%s: %s", from.label,
                       first_line(rgba.geterror()).c_str());
    }
    texels->width = static_cast<uint32_t>(width);
    texels->height = static_cast<uint32_t>(height);
    texels->halves = halves;
    return CLSHEAR_OK;
}

/* Reduces by summing whole blocks of texels, which preserves the total light. */
clshear_status read_luminance(const char *path, int most, float **luminance, int *width,
                              int *height, cs_error *error)
{
    ImageBuf rgba;
    clshear_status status = read_rgba({path, path, nullptr, 0}, true, rgba, error);
    if (status != CLSHEAR_OK) return status;
    const int full_width = rgba.spec().width, full_height = rgba.spec().height;
    const int longer = full_width > full_height ? full_width : full_height;
    const int step = (longer + most - 1) / most;
    *width = (full_width + step - 1) / step;
    *height = (full_height + step - 1) / step;
    const size_t row = static_cast<size_t>(*width);
    auto *sums =
        static_cast<float *>(std::calloc(row * static_cast<size_t>(*height), sizeof(float)));
    if (sums == nullptr) throw std::bad_alloc();
    for (ImageBuf::ConstIterator<float> texel(rgba); !texel.done(); ++texel) {
        const float value = 0.2126f * texel[0] + 0.7152f * texel[1] + 0.0722f * texel[2];
        const auto x = static_cast<size_t>((texel.x() - rgba.spec().x) / step);
        const auto y = static_cast<size_t>((texel.y() - rgba.spec().y) / step);
        if (value > 0.0f) sums[y * row + x] += value;
    }
    *luminance = sums;
    return CLSHEAR_OK;
}

clshear_status read_colours(const char *path, float **colours, size_t *width, size_t *height,
                            cs_error *error)
{
    ImageBuf rgba;
    clshear_status status = read_rgba({path, path, nullptr, 0}, true, rgba, error);
    if (status != CLSHEAR_OK) return status;
    *width = static_cast<size_t>(rgba.spec().width);
    *height = static_cast<size_t>(rgba.spec().height);
    auto *values = static_cast<float *>(std::malloc(*width * *height * 3 * sizeof(float)));
    if (values == nullptr) throw std::bad_alloc();
    OIIO::ROI rgb = rgba.roi();
    rgb.chend = 3;
    if (!rgba.get_pixels(rgb, TypeDesc::FLOAT, values)) {
        std::free(values);
        return cs_fail(error, CLSHEAR_BAD_FILE, "%s: %s", path,
                       first_line(rgba.geterror()).c_str());
    }
    *colours = values;
    return CLSHEAR_OK;
}

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

clshear_status read_picture(const char *path, cs_loaded_picture *loaded, cs_error *error)
{
    if (access(path, R_OK) != 0)
        return cs_fail(error, CLSHEAR_BAD_FILE, "%s: cannot be opened: %s", path,
                       std::strerror(errno));
    if (cs_is_special_file(path))
        return cs_fail(error, CLSHEAR_BAD_FILE, "%s: is not a regular file", path);
    forget(path);
    ImageBuf source(path);
    if (!source.read(0, 0, true, TypeDesc::FLOAT))
        return cs_fail(error, CLSHEAR_BAD_FILE, "%s: %s", path,
                       first_line(source.geterror()).c_str());
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

void set_attributes(const cs_picture *picture, ImageSpec &spec)
{
    for (size_t i = 0; i < picture->attribute_count; i++) {
        const cs_attribute &attribute = picture->attributes[i];
        switch (attribute.kind) {
        case CS_ATTRIBUTE_TEXT:
            spec.attribute(attribute.name, attribute.text);
            break;
        case CS_ATTRIBUTE_INT:
            spec.attribute(attribute.name, attribute.integer);
            break;
        case CS_ATTRIBUTE_FLOAT:
            spec.attribute(attribute.name, attribute.numbers[0]);
            break;
        case CS_ATTRIBUTE_MATRIX:
            spec.attribute(attribute.name, OIIO::TypeMatrix, attribute.numbers);
            break;
        }
    }
}

/* The chosen planes, interleaved, with the offset of the picture's window. */
ImageBuf interleaved(const cs_picture *picture, const std::vector<size_t> &chosen)
{
    ImageSpec spec(picture->width, picture->height, static_cast<int>(chosen.size()),
                   TypeDesc::FLOAT);
    spec.x = picture->x;
    spec.y = picture->y;
    spec.full_width = picture->full_width;
    spec.full_height = picture->full_height;
    spec.channelnames.clear();
    for (size_t index : chosen)
        spec.channelnames.push_back(picture->names[index]);
    set_attributes(picture, spec);
    ImageBuf buffer(spec);
    const size_t count = chosen.size();
    const size_t pixels =
        static_cast<size_t>(picture->width) * static_cast<size_t>(picture->height);
    auto *target = static_cast<float *>(buffer.localpixels());
    for (size_t c = 0; c < count; c++)
        for (size_t p = 0; p < pixels; p++)
            target[p * count + c] = picture->planes[chosen[c]][p];
    return buffer;
}

std::string extension_of(const char *path)
{
    std::string extension = OIIO::Filesystem::extension(path, false);
    for (char &letter : extension)
        letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    return extension;
}

/* The pixels to encode: all planes for EXR, 8-bit or 16-bit sRGB for other formats. */
ImageBuf buffer_for(const std::string &extension, const cs_picture *picture)
{
    std::vector<size_t> chosen;
    for (size_t i = 0; i < picture->channel_count; i++)
        if (extension == "exr" || std::strlen(picture->names[i]) == 1) chosen.push_back(i);
    if (extension == "exr") return interleaved(picture, chosen);
    chosen.clear();
    for (const char *name : {"R", "G", "B"})
        for (size_t i = 0; i < picture->channel_count; i++)
            if (std::strcmp(picture->names[i], name) == 0) chosen.push_back(i);
    ImageBuf linear = interleaved(picture, chosen);
    if (!linear.has_error() && chosen.size() == 3)
        cs_tone_apply(&picture->tone, static_cast<float *>(linear.localpixels()),
                      static_cast<size_t>(picture->width) * static_cast<size_t>(picture->height));
    return OIIO::ImageBufAlgo::colorconvert(linear, "linear", "sRGB", false);
}

/* Encodes into the file `path`, or into `memory` unless it is NULL. Returns an error message, empty
 * on success. */
std::string encode(const std::string &extension, const ImageBuf &buffer, const std::string &path,
                   OIIO::Filesystem::IOProxy *memory)
{
    auto output = OIIO::ImageOutput::create(extension);
    if (output == nullptr) return "this image format cannot be written";
    ImageSpec spec = buffer.spec();
    const bool is_exr = extension == "exr";
    const bool is_tiff = extension == "tif" || extension == "tiff";
    spec.set_format(TypeDesc::UINT8);
    if (is_exr) spec.set_format(TypeDesc::FLOAT);
    if (is_tiff) spec.set_format(TypeDesc::UINT16);
    if (!is_exr) spec.attribute("oiio:ColorSpace", "sRGB");
    if (is_exr) spec.attribute("compression", "zip");
    if (memory != nullptr) output->set_ioproxy(memory);
    if (!output->open(path, spec) || !output->write_image(TypeDesc::FLOAT, buffer.localpixels()))
        return first_line(output->geterror());
    return output->close() ? std::string() : first_line(output->geterror());
}

/* Encodes in memory first: OpenImageIO loses libpng's write errors, and libjpeg ends the process
 * when the disk is full. Pipes and devices cannot seek, so encoders must not write to them. */
std::string write_by_memory(const std::string &extension, const ImageBuf &buffer,
                            const std::string &path)
{
    OIIO::Filesystem::IOVecOutput memory;
    std::string failure = encode(extension, buffer, path, &memory);
    if (!failure.empty()) return failure;
    FILE *stream = std::fopen(path.c_str(), "wb");
    if (stream == nullptr) return std::strerror(errno);
    const auto &bytes = memory.buffer();
    errno = 0;
    const bool written = std::fwrite(bytes.data(), 1, bytes.size(), stream) == bytes.size();
    const int reason = errno;
    if (std::fclose(stream) != 0 && written) return std::strerror(errno);
    return written ? std::string() : std::strerror(reason);
}

/* Pixels a side, beyond which libjpeg ends the process. */
constexpr int most_of_jpeg = 65500;

clshear_status write_picture(const char *path, const cs_picture *picture, cs_error *error)
{
    const std::string extension = extension_of(path);
    const bool is_large = extension != "png" && extension != "jpg" && extension != "jpeg";
    const ImageBuf buffer = buffer_for(extension, picture);
    cs_output_file file;
    if (buffer.has_error())
        return cs_fail(error, CLSHEAR_BAD_FILE, "%s: %s", path,
                       first_line(buffer.geterror()).c_str());
    if (cs_output_begin(path, &file) != 0)
        return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "%s: out of memory", path);
    std::string failure = is_large && !cs_is_special_file(path)
                              ? encode(extension, buffer, file.part, nullptr)
                              : write_by_memory(extension, buffer, file.part);
    const int reason = cs_output_end(&file, failure.empty());
    if (failure.empty() && reason != 0) failure = std::strerror(reason);
    if (failure.empty()) return CLSHEAR_OK;
    return cs_fail(error, CLSHEAR_BAD_FILE, "%s: cannot be written: %s", path, failure.c_str());
}

} // namespace

extern "C" clshear_status cs_image_read_texels(const char *path, const char *label,
                                               const void *memory, size_t size,
                                               const cs_texel_use *use, cs_texels *texels,
                                               cs_error *error)
{
    return guarded(label, error, [&] {
        return read_texels({path, label, memory, size}, *use, texels, error);
    });
}

clshear_status cs_image_read_luminance(const char *path, int most, float **luminance, int *width,
                                       int *height, cs_error *error)
{
    return guarded(path, error,
                   [&] { return read_luminance(path, most, luminance, width, height, error); });
}

extern "C" clshear_status cs_image_read_colours(const char *path, float **colours, size_t *width,
                                                size_t *height, cs_error *error)
{
    return guarded(path, error, [&] { return read_colours(path, colours, width, height, error); });
}

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

extern "C" clshear_status cs_image_check(const char *path, int width, int height, cs_error *error)
{
    return guarded(path, error, [&] {
        const std::string extension = extension_of(path);
        bool known = false;
        for (const char *one : {"exr", "png", "jpg", "jpeg", "tif", "tiff"})
            known |= extension == one;
        if (!known)
            return cs_fail(error, CLSHEAR_BAD_FILE,
                           "%s: unknown image format; use .exr, .png, .jpg or .tif", path);
        const bool is_jpeg = extension == "jpg" || extension == "jpeg";
        if (is_jpeg && (width > most_of_jpeg || height > most_of_jpeg))
            return cs_fail(error, CLSHEAR_BAD_FILE,
                           "%s: %d x %d pixels: JPEG holds at most %d a side; write PNG or EXR",
                           path, width, height, most_of_jpeg);
        return CLSHEAR_OK;
    });
}

extern "C" clshear_status cs_image_write(const char *path, const cs_picture *picture,
                                         cs_error *error)
{
    clshear_status status = cs_image_check(path, picture->width, picture->height, error);
    if (status != CLSHEAR_OK) return status;
    return guarded(path, error, [&] { return write_picture(path, picture, error); });
}
