#include "exr_parts.h"

#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>

#include <cstdio>
#include <string>
#include <vector>

namespace
{

OIIO::ImageSpec spec_of(const test_exr_part &part)
{
    const std::vector<std::string> names = OIIO::Strutil::splits(part.channels, ",");
    OIIO::ImageSpec spec(1, 1, static_cast<int>(names.size()), OIIO::TypeDesc::FLOAT);
    spec.channelnames = names;
    spec.alpha_channel = spec.z_channel = -1;
    spec.attribute("oiio:subimagename", part.name);
    return spec;
}

bool write_all(OIIO::ImageOutput &output, const char *path, const test_exr_part *parts,
               size_t count)
{
    std::vector<OIIO::ImageSpec> specs;
    for (size_t i = 0; i < count; i++)
        specs.push_back(spec_of(parts[i]));
    if (!output.open(path, static_cast<int>(count), specs.data())) return false;
    for (size_t i = 0; i < count; i++) {
        const std::vector<float> texel(specs[i].channelnames.size(), parts[i].value);
        if (i > 0 && !output.open(path, specs[i], OIIO::ImageOutput::AppendSubimage)) return false;
        if (!output.write_image(OIIO::TypeDesc::FLOAT, texel.data())) return false;
    }
    return output.close();
}

} // namespace

extern "C" int test_write_exr_parts(const char *path, const test_exr_part *parts, size_t count)
{
    const auto output = OIIO::ImageOutput::create(path);
    if (output && write_all(*output, path, parts, count)) return 1;
    std::fprintf(stderr, "%s: %s\n", path,
                 output ? output->geterror().c_str() : OIIO::geterror().c_str());
    return 0;
}
