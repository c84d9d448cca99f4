/* Reads images for surfaces, environments and apertures. */
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebufalgo.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <vector>

#include <unistd.h>

#include "base/output_file.h"
#include "image/embedded.h"
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

/* Opens an image, reads its head and finds the part that is its picture. memory: of from.memory. */
clshear_status open_image(const Source &from, OIIO::Filesystem::IOProxy *memory, ImageBuf &source,
                          int &part, cs_error *error)
{
    const char *flaw = from.memory == nullptr ? cs_not_a_file(from.path) : nullptr;
    if (flaw != nullptr) return cs_fail(error, CLSHEAR_BAD_FILE, "%s: %s", from.label, flaw);
    std::string path = from.path;
    clshear_status status = CLSHEAR_OK;
    if (from.memory != nullptr)
        status = embedded_name(from.label, from.memory, from.size, path, error);
    else if (access(from.path, R_OK) != 0)
        return cs_fail(error, CLSHEAR_BAD_FILE, "%s: cannot be opened: %s", from.label,
                       std::strerror(errno));
    else
        forget(from.path);
    if (status != CLSHEAR_OK) return status;
    ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    source.reset(path, 0, 0, nullptr, &config, memory);
    if (!source.init_spec(path, 0, 0))
        return cs_fail(error, CLSHEAR_BAD_FILE, "%s: %s", from.label,
                       reason_of(source, path).c_str());
    part = picture_part(source, path, &config, memory);
    const ImageSpec &spec = source.spec();
    status = check_size(from.label, spec.width, spec.height, error);
    if (status == CLSHEAR_OK)
        status = check_size(from.label, spec.full_width, spec.full_height, error);
    return status;
}

/* Reads the picture of an image that is open, as numbers of this type. */
clshear_status read_part(const Source &from, ImageBuf &source, int part, TypeDesc type,
                         cs_error *error)
{
    if (source.read(part, 0, true, type)) return CLSHEAR_OK;
    return cs_fail(error, CLSHEAR_BAD_FILE, "%s: %s", from.label,
                   reason_of(source, std::string(source.name())).c_str());
}

/* An image that is open as RGBA, its colours linear. */
clshear_status read_rgba(const Source &from, ImageBuf &&source, int part, Curve curve,
                         ImageBuf &rgba, cs_error *error)
{
    const clshear_status status = read_part(from, source, part, TypeDesc::FLOAT, error);
    if (status != CLSHEAR_OK) return status;
    const Stored stored = stored_in(source);
    rgba = linear_rgba(displayed(std::move(source)), stored, curve);
    if (rgba.has_error())
        return cs_fail(error, CLSHEAR_BAD_FILE, "%s: %s", from.label,
                       first_line(rgba.geterror()).c_str());
    return CLSHEAR_OK;
}

/* A whole image file as RGBA, its colours linear. */
clshear_status read_file(const char *path, ImageBuf &rgba, cs_error *error)
{
    const Source from = {path, path, nullptr, 0};
    ImageBuf source;
    int part = 0;
    const clshear_status status = open_image(from, nullptr, source, part, error);
    if (status != CLSHEAR_OK) return status;
    return read_rgba(from, std::move(source), part, Curve::files, rgba, error);
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

/* RGBA as halves. Brighter texels would be infinite, and black times them no number. No number
 * becomes 0. */
bool store_halves(ImageBuf &&rgba, uint16_t *halves)
{
    rgba = OIIO::ImageBufAlgo::clamp(rgba, 0.0f, CS_LARGEST_HALF);
    return rgba.get_pixels(rgba.roi(), TypeDesc::HALF, halves);
}

/* What becomes of every number that an image of small integers can hold, as halves for red, green,
 * blue and alpha: by the same way as texels, on a picture of them all. Empty where there is no such
 * table: texels are floats, or their alpha counts in their colours. */
std::vector<uint16_t> table_of(const ImageBuf &source, const cs_texel_use &use, Curve curve)
{
    const TypeDesc type = source.nativespec().format;
    const Stored stored = stored_in(source);
    const bool is_byte = type == TypeDesc::UINT8;
    if (!is_byte && type != TypeDesc::UINT16) return {};
    if (stored.is_associated || (use.kind != CS_TEXELS_COLOUR && use.kind != CS_TEXELS_DATA))
        return {};
    ImageSpec spec = source.spec();
    spec.full_x = spec.full_y = spec.x = spec.y = 0;
    spec.full_width = spec.width = is_byte ? 256 : 65536;
    spec.full_height = spec.height = 1;
    spec.set_format(type);
    std::vector<uint16_t> numbers(static_cast<size_t>(spec.width * spec.nchannels));
    for (size_t i = 0; i < numbers.size(); i++) {
        const size_t number = i / static_cast<size_t>(spec.nchannels);
        numbers[i] = static_cast<uint16_t>(is_byte ? 257 * number : number);
    }
    ImageBuf all(spec), floats;
    std::vector<uint16_t> table(4 * static_cast<size_t>(spec.width));
    if (!all.set_pixels(all.roi(), TypeDesc::UINT16, numbers.data()) ||
        !floats.copy(all, TypeDesc::FLOAT))
        return {};
    ImageBuf rgba = linear_rgba(floats, stored, curve);
    convert_texels(use, rgba);
    if (!store_halves(std::move(rgba), table.data())) return {};
    return table;
}

/* Looks the numbers of `source` up. */
template <typename Number>
void look_up(const ImageBuf &source, const std::vector<uint16_t> &table, uint16_t *halves)
{
    int order[4];
    picture_channels(source.spec(), order);
    const auto *numbers = static_cast<const Number *>(source.localpixels());
    const auto channels = static_cast<size_t>(source.nchannels());
    const size_t texels = source.spec().image_pixels();
    for (size_t i = 0; i < texels; i++)
        for (size_t c = 0; c < 4; c++) {
            const size_t number =
                order[c] < 0 ? 0 : numbers[channels * i + static_cast<size_t>(order[c])];
            halves[4 * i + c] = table[4 * number + c];
        }
}

/* Room for the texels of an image of this size. */
void reserve(const ImageSpec &spec, cs_texels *texels)
{
    texels->width = static_cast<uint32_t>(spec.width);
    texels->height = static_cast<uint32_t>(spec.height);
    texels->halves =
        static_cast<uint16_t *>(std::malloc(spec.image_pixels() * 4 * sizeof(uint16_t)));
    if (texels->halves == nullptr) throw std::bad_alloc();
}

/* Texels of an image of integers that is open, by their table. */
clshear_status read_by_table(const Source &from, ImageBuf &source, int part,
                             const std::vector<uint16_t> &table, cs_texels *texels, cs_error *error)
{
    const TypeDesc type = source.nativespec().format;
    const clshear_status status = read_part(from, source, part, type, error);
    if (status != CLSHEAR_OK) return status;
    reserve(source.spec(), texels);
    if (type == TypeDesc::UINT8)
        look_up<uint8_t>(source, table, texels->halves);
    else
        look_up<uint16_t>(source, table, texels->halves);
    return CLSHEAR_OK;
}

/* Texels of any image that is open. */
clshear_status read_by_floats(const Source &from, ImageBuf &&source, int part,
                              const cs_texel_use &use, Curve curve, cs_texels *texels,
                              cs_error *error)
{
    ImageBuf rgba;
    const clshear_status status = read_rgba(from, std::move(source), part, curve, rgba, error);
    if (status != CLSHEAR_OK) return status;
    convert_texels(use, rgba);
    reserve(rgba.spec(), texels);
    if (store_halves(std::move(rgba), texels->halves)) return CLSHEAR_OK;
    std::free(texels->halves);
    texels->halves = nullptr;
    return cs_fail(error, CLSHEAR_BAD_FILE, "%s: its texels are not to be had", from.label);
}

clshear_status read_texels(const Source &from, const cs_texel_use &use, cs_texels *texels,
                           cs_error *error)
{
    const Curve given = use.is_srgb != 0 ? Curve::srgb : Curve::files;
    const Curve curve = use.kind == CS_TEXELS_COLOUR ? given : Curve::none;
    OIIO::Filesystem::IOMemReader reader(const_cast<void *>(from.memory), from.size);
    ImageBuf source;
    int part = 0;
    const clshear_status status =
        open_image(from, from.memory != nullptr ? &reader : nullptr, source, part, error);
    if (status != CLSHEAR_OK) return status;
    const std::vector<uint16_t> table = table_of(source, use, curve);
    return table.empty() ? read_by_floats(from, std::move(source), part, use, curve, texels, error)
                         : read_by_table(from, source, part, table, texels, error);
}

/* Reduces by summing whole blocks of texels, which preserves the total light. */
clshear_status read_luminance(const char *path, int most, float **luminance, int *width,
                              int *height, cs_error *error)
{
    ImageBuf rgba;
    clshear_status status = read_file(path, rgba, error);
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
    clshear_status status = read_file(path, rgba, error);
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
