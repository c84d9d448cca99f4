#include "image/layers.h"

#include <OpenImageIO/strutil.h>

namespace
{

/* What channels of a colour are called, behind the name of their layer. */
const char *const colour_names[4][2] = {
    {"R", "red"}, {"G", "green"}, {"B", "blue"}, {"A", "alpha"}};

/* Layers that hold the picture itself, as renderers name them. */
const char *const picture_names[] = {"", "rgba", "rgb", "combined", "beauty"};

/* Splits a channel's name into its layer, which may be empty, and the rest. */
void split(const std::string &channel, std::string &layer, std::string &rest)
{
    const size_t point = channel.rfind('.');
    layer = point == std::string::npos ? "" : channel.substr(0, point);
    rest = point == std::string::npos ? channel : channel.substr(point + 1);
}

/* The channel of a colour in a layer, or -1. */
int channel_of(const ImageSpec &spec, const std::string &wanted, int colour)
{
    std::string layer, rest;
    for (int i = 0; i < spec.nchannels; i++) {
        split(spec.channelnames[static_cast<size_t>(i)], layer, rest);
        for (const char *name : colour_names[colour])
            if (layer == wanted && OIIO::Strutil::iequals(rest, name)) return i;
    }
    return -1;
}

bool has_colours(const ImageSpec &spec, const std::string &layer)
{
    return channel_of(spec, layer, 0) >= 0 && channel_of(spec, layer, 1) >= 0 &&
           channel_of(spec, layer, 2) >= 0;
}

/* How soon a layer is taken: the place of the last part of its name among those of pictures. */
size_t rank_of(const std::string &layer)
{
    std::string before, last;
    split(layer, before, last);
    size_t rank = 0;
    for (const char *name : picture_names) {
        if (OIIO::Strutil::iequals(last, name)) break;
        rank++;
    }
    return rank;
}

/* The same of a part: channels that name no layer are of the one that the part is called. */
size_t rank_of_part(const ImageSpec &spec, const std::string &layer)
{
    const std::string name(spec.get_string_attribute("oiio:subimagename"));
    return rank_of(layer.empty() ? name : layer);
}

/* Finds the layer that is the picture; false where none has all three colours. */
bool find_layer(const ImageSpec &spec, std::string &found)
{
    std::string layer, rest;
    bool any = false;
    for (const std::string &channel : spec.channelnames) {
        split(channel, layer, rest);
        if (!has_colours(spec, layer) || (any && rank_of(layer) >= rank_of(found))) continue;
        found = layer;
        any = true;
    }
    return any;
}

} // namespace

void picture_channels(const ImageSpec &spec, int order[4])
{
    std::string layer;
    if (find_layer(spec, layer)) {
        for (int c = 0; c < 4; c++)
            order[c] = channel_of(spec, layer, c);
        return;
    }
    const int alpha = spec.alpha_channel;
    const bool grey = spec.nchannels < (alpha >= 0 ? 4 : 3);
    for (int c = 0; c < 3; c++)
        order[c] = grey ? 0 : c;
    order[3] = alpha;
}

int picture_part(ImageBuf &image, const std::string &path, const ImageSpec *config,
                 OIIO::Filesystem::IOProxy *memory)
{
    std::string layer;
    const int parts = std::string(image.file_format_name()) == "openexr" ? image.nsubimages() : 1;
    int found = 0;
    bool any = false;
    size_t least = 0;
    for (int part = 0; part < parts && parts > 1; part++) {
        image.reset(path, part, 0, nullptr, config, memory);
        if (!image.init_spec(path, part, 0) || !find_layer(image.spec(), layer)) continue;
        const size_t rank = rank_of_part(image.spec(), layer);
        if (any && rank >= least) continue;
        found = part;
        least = rank;
        any = true;
    }
    if (parts > 1) {
        image.reset(path, found, 0, nullptr, config, memory);
        image.init_spec(path, found, 0);
    }
    return found;
}
