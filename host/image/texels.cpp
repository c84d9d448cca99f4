/* Reads images for surfaces, environments and apertures. */
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebufalgo.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <vector>

#include <unistd.h>

#include "base/output_file.h"
#include "image/layers.h"
#include "image/oiio.h"
#include "kernels/vector.h"

namespace
{

/* The curve by which stored numbers become linear colours. */
enum class Curve {
    none,  /* there is none: the numbers are no colours */
    files, /* the one that the file names; if it names none, that of sRGB for integers */
    srgb   /* that of sRGB for integers, whatever the file names; none for floats */
};

/* Converts colours from a curve to linear. space: OpenImageIO's name of the curve. gamma: its
 * power, if the name begins with "Gamma", as a PNG's gAMA chunk makes it. "Gamma2.2" stands for the
 * curve of sRGB, since PNGs on that curve say 2.2 (PNG specification, gAMA and sRGB). So does
 * "Rec709", which all integers of PNM files are said to be: programs write those of sRGB. */
ImageBuf linear_of(ImageBuf &&rgba, const std::string &space, float gamma, bool is_integer)
{
    const float powers[4] = {gamma, gamma, gamma, 1.0f};
    if (space == "sRGB" || space == "Gamma2.2" || (space == "Rec709" && is_integer))
        return OIIO::ImageBufAlgo::colorconvert(rgba, "sRGB", "linear", false);
    if (space.compare(0, 5, "Gamma") != 0 || !(gamma > 0.0f)) return std::move(rgba);
    return OIIO::ImageBufAlgo::pow(rgba, OIIO::cspan<float>(powers, 4));
}

/* What the numbers of a file are. */
struct Stored {
    bool is_integer;
    bool is_associated; /* alpha has multiplied the colours */
};

/* WebP files hold colours apart from alpha, but OpenImageIO multiplies them, on their curve. */
Stored stored_in(const ImageBuf &source)
{
    const std::string format(source.file_format_name());
    return {!source.nativespec().format.is_floating_point(),
            (format == "openexr" || format == "tiff" || format == "webp") &&
                source.spec().get_int_attribute("oiio:UnassociatedAlpha") == 0};
}

/* Any number of channels as RGBA: grey is repeated, alpha is 1 where there is none. Colours become
 * linear, and what they are before alpha multiplies them. */
ImageBuf linear_rgba(const ImageBuf &source, const Stored &stored, Curve curve)
{
    int order[4];
    picture_channels(source.spec(), order);
    const float fill[4] = {0.0f, 0.0f, 0.0f, 1.0f};
    ImageBuf rgba = OIIO::ImageBufAlgo::channels(source, 4, order, fill);
    rgba.specmod().alpha_channel = 3;
    if (order[3] >= 0 && stored.is_associated) rgba = OIIO::ImageBufAlgo::unpremult(rgba);
    std::string space = source.spec().get_string_attribute("oiio:ColorSpace");
    if (space.empty() || curve == Curve::srgb) space = stored.is_integer ? "sRGB" : "linear";
    if (curve == Curve::none) return rgba;
    const float gamma = source.spec().get_float_attribute("oiio:Gamma", 2.2f);
    return linear_of(std::move(rgba), space, gamma, stored.is_integer);
}

/* An image to read: a file, or `size` bytes of one at `memory` if that is not null. */
struct Source {
    const char *path;
    const char *label; /* what messages call it */
    const void *memory;
    size_t size;
};

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

/* The name that makes OpenImageIO read an image in memory by its kind. */
clshear_status name_for(const Source &from, std::string &name, cs_error *error)
{
    if (from.size == 0) return cs_fail(error, CLSHEAR_BAD_FILE, "%s: has no bytes", from.label);
    const Kind *kind = kind_of(from.memory, from.size);
    if (kind == nullptr)
        return cs_fail(error, CLSHEAR_BAD_FILE, "%s: not an image that can be read", from.label);
    if (kind->extension == nullptr)
        return cs_fail(error, CLSHEAR_BAD_FILE, "%s: %s images are not read from within a file",
                       from.label, kind->name);
    name = std::string("embedded.") + kind->extension;
    return CLSHEAR_OK;
}

/* Texels in one image: more are a damaged head rather than a picture. */
constexpr uint64_t most_texels = uint64_t(1) << 28;

/* Whether an image has texels, and not too many of them. */
clshear_status check_size(const char *label, int width, int height, cs_error *error)
{
    if (width > 0 && height > 0 &&
        static_cast<uint64_t>(width) <= most_texels / static_cast<uint64_t>(height))
        return CLSHEAR_OK;
    return cs_fail(error, CLSHEAR_BAD_FILE, "%s: %d x %d texels: must be 1 to 2^28", label, width,
                   height);
}

/* Puts the rows of a Radiance file, and their texels, in the usual order. Its head begins with the
 * sign and the name of the axis that the rows follow, then those of the texels in a row, which
 * OpenImageIO counts as orientations 1 to 8: -Y+X, -Y-X, +Y-X, +Y+X, +X-Y, +X+Y, -X+Y, -X-Y. */
ImageBuf upright(ImageBuf &&source)
{
    const int order = source.orientation();
    ImageBuf rows = order > 4 ? OIIO::ImageBufAlgo::transpose(source) : std::move(source);
    if (order == 2 || order == 8) return OIIO::ImageBufAlgo::flop(rows);
    if (order == 3 || order == 7) return OIIO::ImageBufAlgo::rotate180(rows);
    if (order == 4 || order == 6) return OIIO::ImageBufAlgo::flip(rows);
    return rows;
}

/* The picture as it is meant to be seen. That of an EXR file is its display window: the data may be
 * a part of it, outside which all channels are 0, or go beyond it. The head of a Radiance file says
 * in which order its rows and columns come. In other files the orientation says how a camera was
 * held, and texture coordinates are those of the texels. */
ImageBuf displayed(ImageBuf &&source)
{
    const ImageSpec &spec = source.spec();
    const std::string format(source.file_format_name());
    if (format == "openexr" && !(spec.roi() == spec.roi_full()))
        return OIIO::ImageBufAlgo::cut(source, spec.roi_full());
    return format == "hdr" ? upright(std::move(source)) : std::move(source);
}

/* An image as RGBA, its colours linear. */
clshear_status read_rgba(const Source &from, Curve curve, ImageBuf &rgba, cs_error *error)
{
    const char *flaw = from.memory == nullptr ? cs_not_a_file(from.path) : nullptr;
    if (flaw != nullptr) return cs_fail(error, CLSHEAR_BAD_FILE, "%s: %s", from.label, flaw);
    std::string path = from.path;
    clshear_status status = CLSHEAR_OK;
    if (from.memory != nullptr)
        status = name_for(from, path, error);
    else if (access(from.path, R_OK) != 0)
        return cs_fail(error, CLSHEAR_BAD_FILE, "%s: cannot be opened: %s", from.label,
                       std::strerror(errno));
    else
        forget(from.path);
    if (status != CLSHEAR_OK) return status;
    OIIO::Filesystem::IOMemReader reader(const_cast<void *>(from.memory), from.size);
    ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    OIIO::Filesystem::IOProxy *memory = from.memory != nullptr ? &reader : nullptr;
    ImageBuf source(path, 0, 0, nullptr, &config, memory);
    if (!source.init_spec(path, 0, 0))
        return cs_fail(error, CLSHEAR_BAD_FILE, "%s: %s", from.label,
                       reason_of(source, path).c_str());
    const int part = picture_part(source, path, &config, memory);
    const ImageSpec &spec = source.spec();
    status = check_size(from.label, spec.width, spec.height, error);
    if (status == CLSHEAR_OK)
        status = check_size(from.label, spec.full_width, spec.full_height, error);
    if (status != CLSHEAR_OK) return status;
    if (!source.read(part, 0, true, TypeDesc::FLOAT))
        return cs_fail(error, CLSHEAR_BAD_FILE, "%s: %s", from.label,
                       reason_of(source, path).c_str());
    const Stored stored = stored_in(source);
    rgba = linear_rgba(displayed(std::move(source)), stored, curve);
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
    const Curve given = use.is_srgb != 0 ? Curve::srgb : Curve::files;
    clshear_status status =
        read_rgba(from, use.kind == CS_TEXELS_COLOUR ? given : Curve::none, rgba, error);
    if (status != CLSHEAR_OK) return status;
    convert_texels(use, rgba);
    /* Brighter texels would be infinite, and black times them no number. No number becomes 0. */
    rgba = OIIO::ImageBufAlgo::clamp(rgba, 0.0f, CS_LARGEST_HALF);
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
    clshear_status status = read_rgba({path, path, nullptr, 0}, Curve::files, rgba, error);
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
        const float colour[3] = {texel[0], texel[1], texel[2]};
        const float value = cs_luminance(colour);
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
    clshear_status status = read_rgba({path, path, nullptr, 0}, Curve::files, rgba, error);
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
