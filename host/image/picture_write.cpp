/* Writes pictures, some rows at a time, so that there is no second copy of them. */
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebufalgo.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
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

bool is_tiff(const std::string &extension)
{
    return extension == "tif" || extension == "tiff";
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
    const auto depth = is_tiff(extension) ? TypeDesc::UINT16 : TypeDesc::UINT8;
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

/* A file that remembers why writing to it failed. Encoders say it in words of their own, and of
 * what they write when they end, not at all. */
class Target final : public OIIO::Filesystem::IOProxy
{
  public:
    explicit Target(FILE *file) : IOProxy("", Write), stream(file) {}
    const char *proxytype() const override { return "clshear"; }
    size_t size() const override { return static_cast<size_t>(end); }
    int failure() const { return reason; } /* errno of the first; 0: none */

    size_t write(const void *bytes, size_t count) override
    {
        errno = 0;
        const size_t written = std::fwrite(bytes, 1, count, stream);
        note(written == count);
        m_pos += static_cast<int64_t>(written);
        end = std::max(end, m_pos);
        return written;
    }

    bool seek(int64_t offset) override
    {
        errno = 0;
        const bool good = fseeko(stream, offset, SEEK_SET) == 0;
        note(good);
        if (good) m_pos = offset;
        return good;
    }

    /* Tries to make the file larger. */
    void probe()
    {
        const std::vector<char> more(1 << 16);
        errno = 0;
        note(fseeko(stream, 0, SEEK_END) == 0 &&
             std::fwrite(more.data(), 1, more.size(), stream) == more.size() &&
             std::fflush(stream) == 0);
    }

  private:
    FILE *stream;
    int64_t end = 0; /* bytes of the file */
    int reason = 0;

    void note(bool good)
    {
        if (!good && reason == 0) reason = errno != 0 ? errno : EIO;
    }
};

/* Encodes into `target`, or into the file `path` where that is NULL. Returns an error message,
 * empty on success. */
std::string encode(const std::string &extension, const Encoding &encoding, const std::string &path,
                   OIIO::Filesystem::IOProxy *target)
{
    auto output = OIIO::ImageOutput::create(extension);
    if (output == nullptr) return "this image format cannot be written";
    if (target != nullptr) output->set_ioproxy(target);
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
std::string encode_by_memory(const std::string &extension, const Encoding &encoding,
                             const std::string &path, Target *target)
{
    OIIO::Filesystem::IOVecOutput memory;
    std::string failure = encode(extension, encoding, path, &memory);
    if (failure.empty()) target->write(memory.buffer().data(), memory.buffer().size());
    return failure;
}

/* Whether all rows of a TIFF can be read. */
bool reads_well(const std::string &path, const ImageSpec &wanted)
{
    ImageSpec spec;
    const auto input = OIIO::ImageInput::create("tif");
    if (input == nullptr || !input->open(path, spec)) return false;
    if (spec.height != wanted.height || spec.nchannels != wanted.nchannels) return false;
    std::vector<char> rows(spec.scanline_bytes() * rows_at_once);
    for (int begin = 0; begin < spec.height; begin += rows_at_once) {
        const int end = std::min(spec.height, begin + rows_at_once);
        if (!input->read_scanlines(0, 0, spec.y + begin, spec.y + end, 0, 0, spec.nchannels,
                                   spec.format, rows.data()))
            return false;
    }
    return true;
}

/* Encodes into the file `path` by the encoder's own means, since it reads what it wrote. It does
 * not tell when its last writes fail: the file is read again, and of one that is broken `target`,
 * the same file, finds why. */
std::string encode_tiff(const Encoding &encoding, const std::string &path, Target *target)
{
    std::string failure = encode("tif", encoding, path, nullptr);
    if (failure.empty() && reads_well(path, encoding.spec)) return failure;
    target->probe();
    return failure.empty() ? "it is not whole" : failure;
}

/* Pixels a side, beyond which libjpeg ends the process. */
constexpr int most_of_jpeg = 65500;

/* Encodes in the way that suits the format and the place. */
std::string encode_into(const std::string &extension, const Encoding &encoding, bool is_special,
                        cs_output_file *file, Target *target)
{
    if (is_tiff(extension)) return encode_tiff(encoding, file->part, target);
    if (extension == "exr" && !is_special) return encode(extension, encoding, file->part, target);
    return encode_by_memory(extension, encoding, file->part, target);
}

clshear_status write_picture(const char *path, const cs_picture *picture, cs_error *error)
{
    const std::string extension = extension_of(path);
    const Encoding encoding = encoding_of(extension, picture);
    const bool is_special = cs_is_special_file(path) != 0;
    std::string failure;
    cs_output_file file = {};
    /* An exception leaves no part of a file. */
    const auto drop = [](cs_output_file *unfinished) {
        if (unfinished->part != nullptr) cs_output_end(unfinished, 0);
    };
    const std::unique_ptr<cs_output_file, decltype(drop)> guard(&file, drop);
    int reason = cs_output_open(path, &file);
    if (reason == 0) {
        Target target(file.stream);
        failure = encode_into(extension, encoding, is_special, &file, &target);
        reason = target.failure();
        const int ended = cs_output_end(&file, failure.empty() && reason == 0);
        if (reason == 0) reason = ended;
    }
    if (reason != 0) failure = std::strerror(reason);
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
        if (is_tiff(extension) && cs_is_special_file(path))
            return cs_fail(error, CLSHEAR_BAD_FILE,
                           "%s: TIFF goes into files only; write PNG or EXR there", path);
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
    static const bool is_quiet = OIIO::attribute("debug", 0); /* else it prints */
    static_cast<void>(is_quiet);
    clshear_status status = cs_image_check(path, picture->width, picture->height, error);
    if (status != CLSHEAR_OK) return status;
    return guarded(path, error, [&] { return write_picture(path, picture, error); });
}
