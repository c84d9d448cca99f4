/* Writes pictures, some rows at a time, so that there is no second copy of them. */
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebufalgo.h>

#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <vector>

#include "base/output_file.h"
#include "image/oiio.h"

namespace
{

/* Rows that are encoded at once: blocks of 16 for each of some threads of OpenEXR. */
constexpr int rows_at_once = 256;

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

std::string extension_of(const char *path)
{
    std::string extension = OIIO::Filesystem::extension(path, false);
    for (char &letter : extension)
        letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    return extension;
}

/* What is written: the channels of `planes` in their order, under the tone curve unless exr. */
struct Encoding {
    const cs_picture *picture;
    bool is_exr;
    std::vector<const float *> planes;
    float scale; /* of values, by the exposure; not of EXR */
    ImageSpec spec;
};

/* All planes for EXR, 8-bit or 16-bit sRGB of R, G and B for other formats. */
Encoding encoding_of(const std::string &extension, const cs_picture *picture)
{
    Encoding made{picture, extension == "exr", {}, 1.0f, {}};
    std::vector<std::string> names;
    const auto add = [&](size_t i) {
        made.planes.push_back(picture->planes[i]);
        names.emplace_back(picture->names[i]);
    };
    for (size_t i = 0; i < picture->channel_count && made.is_exr; i++)
        add(i);
    for (const char *name : {"R", "G", "B"})
        for (size_t i = 0; i < picture->channel_count && !made.is_exr; i++)
            if (std::strcmp(picture->names[i], name) == 0) add(i);
    const bool is_tiff = extension == "tif" || extension == "tiff";
    const auto depth = is_tiff ? TypeDesc::UINT16 : TypeDesc::UINT8;
    made.spec = ImageSpec(picture->width, picture->height, static_cast<int>(names.size()),
                          made.is_exr ? TypeDesc::FLOAT : depth);
    made.spec.x = picture->x;
    made.spec.y = picture->y;
    made.spec.full_width = picture->full_width;
    made.spec.full_height = picture->full_height;
    made.spec.channelnames = names;
    set_attributes(picture, made.spec);
    if (!made.is_exr) made.spec.attribute("oiio:ColorSpace", "sRGB");
    if (made.is_exr) made.spec.attribute("compression", "zip");
    if (!made.is_exr && made.planes.size() == 3)
        made.scale = cs_tone_scale(&picture->tone, made.planes.data(),
                                   static_cast<size_t>(picture->width) *
                                       static_cast<size_t>(picture->height));
    return made;
}

/* Rows `begin` to `end` of the window, interleaved, as they are encoded. */
ImageBuf rows_of(const Encoding &encoding, int begin, int end)
{
    const size_t width = static_cast<size_t>(encoding.picture->width);
    const size_t first = static_cast<size_t>(begin) * width, count = encoding.planes.size();
    const size_t pixels = static_cast<size_t>(end - begin) * width;
    ImageBuf rows(
        ImageSpec(encoding.picture->width, end - begin, static_cast<int>(count), TypeDesc::FLOAT));
    auto *target = static_cast<float *>(rows.localpixels());
    for (size_t c = 0; c < count; c++)
        for (size_t p = 0; p < pixels; p++)
            target[p * count + c] = encoding.planes[c][first + p];
    if (encoding.is_exr) return rows;
    if (count == 3) cs_tone_apply(&encoding.picture->tone, encoding.scale, target, pixels);
    return OIIO::ImageBufAlgo::colorconvert(rows, "linear", "sRGB", false);
}

/* Encodes into the file `path`, or into `memory` unless it is NULL. Returns an error message, empty
 * on success. */
std::string encode(const std::string &extension, const Encoding &encoding, const std::string &path,
                   OIIO::Filesystem::IOProxy *memory)
{
    auto output = OIIO::ImageOutput::create(extension);
    if (output == nullptr) return "this image format cannot be written";
    if (memory != nullptr) output->set_ioproxy(memory);
    if (!output->open(path, encoding.spec)) return first_line(output->geterror());
    const int height = encoding.spec.height, top = encoding.spec.y;
    for (int begin = 0; begin < height; begin += rows_at_once) {
        const int end = height - begin < rows_at_once ? height : begin + rows_at_once;
        const ImageBuf rows = rows_of(encoding, begin, end);
        if (rows.has_error()) return first_line(rows.geterror());
        if (!output->write_scanlines(top + begin, top + end, 0, TypeDesc::FLOAT,
                                     rows.localpixels()))
            return first_line(output->geterror());
    }
    return output->close() ? std::string() : first_line(output->geterror());
}

/* Encodes in memory first: OpenImageIO loses libpng's write errors, and libjpeg ends the process
 * when the disk is full. Pipes and devices cannot seek, so encoders must not write to them. */
std::string write_by_memory(const std::string &extension, const Encoding &encoding,
                            const std::string &path)
{
    OIIO::Filesystem::IOVecOutput memory;
    std::string failure = encode(extension, encoding, path, &memory);
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
    const Encoding encoding = encoding_of(extension, picture);
    cs_output_file file;
    if (cs_output_begin(path, &file) != 0)
        return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "%s: out of memory", path);
    std::string failure = is_large && !cs_is_special_file(path)
                              ? encode(extension, encoding, file.part, nullptr)
                              : write_by_memory(extension, encoding, file.part);
    const int reason = cs_output_end(&file, failure.empty());
    if (failure.empty() && reason != 0) failure = std::strerror(reason);
    if (failure.empty()) return CLSHEAR_OK;
    return cs_fail(error, CLSHEAR_BAD_FILE, "%s: cannot be written: %s", path, failure.c_str());
}

} // namespace

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
