#include "display/viewer.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "display/connection.h"
#include "display/packet.h"

enum {
    TILE = 64 /* px: a message of all channels is some hundred kilobytes */
};

static const double patience_s = 2.0; /* until a viewer answers */

/* What is still to be done before tiles can go. */
typedef enum stage {
    REMOVE, /* a picture of that name, which an earlier render may have left */
    MAKE,
    FILL
} stage;

struct cs_viewer {
    cs_address address;
    int file;
    char picture[256];
    stage stage;
    cs_array names;  /* cs_channel, without pixels: those of the picture */
    double *sampled; /* of each tile of the window: its number of samples when it was sent; -1: it
                      * was not */
    size_t tile_count;
    int window[4]; /* that the tiles are of */
    const clshear_film *film;
    size_t tile; /* the next one */
    int all;
    cs_packet packet;
    size_t sent; /* bytes of the packet */
};

clshear_status cs_viewer_check(const char *address, cs_error *error)
{
    cs_address parts;
    return cs_address_read(address, &parts, error);
}

clshear_status cs_viewer_open(const char *address, const char *picture, cs_viewer **result,
                              cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    cs_viewer *viewer = calloc(1, sizeof *viewer);
    CS_REQUIRE(viewer != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory");
    viewer->file = -1;
    viewer->names.item_size = sizeof(cs_channel);
    strncpy(viewer->picture, picture, sizeof viewer->picture - 1);
    CS_TRY(cs_address_read(address, &viewer->address, error));
    CS_TRY(cs_connect(&viewer->address, patience_s, &viewer->file, error));
    *result = viewer;
    viewer = NULL;
done:
    cs_viewer_close(viewer);
    return status;
}

void cs_viewer_close(cs_viewer *viewer)
{
    if (viewer == NULL) return;
    if (viewer->file >= 0) close(viewer->file);
    cs_array_free(&viewer->names);
    cs_packet_free(&viewer->packet);
    free(viewer->sampled);
    free(viewer);
}

static size_t tiles_along(int pixels)
{
    return ((size_t)pixels + TILE - 1) / TILE;
}

/* A tile of the film's window, in the coordinates of the window. */
static cs_rectangle tile_of(const clshear_film *film, size_t tile)
{
    const int width = film->info.width, height = film->info.height;
    const size_t columns = tiles_along(width);
    const int x = (int)(tile % columns) * TILE, y = (int)(tile / columns) * TILE;
    return (cs_rectangle){.x = x,
                          .y = y,
                          .width = width - x < TILE ? width - x : TILE,
                          .height = height - y < TILE ? height - y : TILE};
}

static double samples_in(const clshear_film *film, const cs_rectangle *tile)
{
    const float *samples = cs_film_channel(film, "Samples");
    double sum = 0.0;
    for (int y = tile->y; samples != NULL && y < tile->y + tile->height; y++)
        for (int x = tile->x; x < tile->x + tile->width; x++)
            sum += (double)samples[(size_t)y * (size_t)film->info.width + (size_t)x];
    return sum;
}

static int has_name(const cs_array *names, const char *name)
{
    const cs_channel *channels = names->items;
    for (size_t i = 0; i < names->count; i++)
        if (strcmp(channels[i].name, name) == 0) return 1;
    return 0;
}

/* Adds the film's channels to those of the picture. One that is missing for a while, as the
 * variance is until there are two replicates, stays. */
static clshear_status learn_channels(cs_viewer *viewer, const clshear_film *film, cs_error *error)
{
    const cs_channel *channels = film->channels.items;
    for (size_t i = 0; i < film->channels.count; i++) {
        if (has_name(&viewer->names, channels[i].name)) continue;
        cs_channel *added = cs_array_extend(&viewer->names, 1);
        if (added == NULL) return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory");
        memcpy(added->name, channels[i].name, sizeof added->name);
        viewer->stage = REMOVE;
    }
    return CLSHEAR_OK;
}

/* Room for the numbers of samples of the film's tiles. */
static clshear_status count_tiles(cs_viewer *viewer, const clshear_film *film, cs_error *error)
{
    const size_t count = tiles_along(film->info.width) * tiles_along(film->info.height);
    if (viewer->sampled != NULL &&
        memcmp(viewer->window, film->info.window, sizeof film->info.window) == 0)
        return CLSHEAR_OK;
    free(viewer->sampled);
    viewer->sampled = malloc(count * sizeof *viewer->sampled);
    if (viewer->sampled == NULL) return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory");
    viewer->tile_count = count;
    viewer->stage = REMOVE;
    memcpy(viewer->window, film->info.window, sizeof film->info.window);
    return CLSHEAR_OK;
}

clshear_status cs_viewer_show(cs_viewer *viewer, const clshear_film *film, int all, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    CS_TRY(learn_channels(viewer, film, error));
    CS_TRY(count_tiles(viewer, film, error));
    for (size_t i = 0; viewer->stage == REMOVE && i < viewer->tile_count; i++)
        viewer->sampled[i] = -1.0;
    viewer->film = film;
    viewer->all = all;
    viewer->tile = 0;
done:
    return status;
}

/* The names as the packets take them; freed by the caller. NULL: out of memory. */
static const char **names_of(const cs_array *channels)
{
    const cs_channel *items = channels->items;
    const char **names = malloc((channels->count + 1) * sizeof *names);
    for (size_t i = 0; names != NULL && i < channels->count; i++)
        names[i] = items[i].name;
    return names;
}

static int make_picture(cs_viewer *viewer)
{
    const char **names = names_of(&viewer->names);
    if (names == NULL) return 0;
    const cs_channel_names list = {names, viewer->names.count};
    cs_packet_create(&viewer->packet, viewer->picture, viewer->film->info.full_width,
                     viewer->film->info.full_height, &list);
    free(names);
    return viewer->packet.is_good;
}

static int fill_tile(cs_viewer *viewer, const cs_rectangle *tile)
{
    const clshear_film *film = viewer->film;
    const cs_channel *channels = film->channels.items;
    const size_t width = (size_t)film->info.width;
    const cs_rectangle where = {tile->x + film->info.window[0], tile->y + film->info.window[2],
                                tile->width, tile->height};
    const char **names = names_of(&film->channels);
    const float **planes = malloc((film->channels.count + 1) * sizeof *planes);
    const int good = names != NULL && planes != NULL;
    for (size_t c = 0; good && c < film->channels.count; c++)
        planes[c] = channels[c].pixels + (size_t)tile->y * width + (size_t)tile->x;
    const cs_channel_names list = {names, film->channels.count};
    if (good) cs_packet_update(&viewer->packet, viewer->picture, &list, &where, planes, width);
    free(planes);
    free(names);
    return good && viewer->packet.is_good;
}

/* The next tile that has changed. Leaves the packet empty where there is none. */
static int next_tile(cs_viewer *viewer)
{
    while (viewer->tile < viewer->tile_count) {
        const size_t at = viewer->tile++;
        const cs_rectangle tile = tile_of(viewer->film, at);
        const double samples = samples_in(viewer->film, &tile);
        if (!viewer->all && samples <= viewer->sampled[at]) continue;
        viewer->sampled[at] = samples;
        return fill_tile(viewer, &tile);
    }
    return 1;
}

/* Puts what comes next into the packet, or nothing. Returns 0 when out of memory. */
static int next_packet(cs_viewer *viewer)
{
    viewer->sent = 0;
    viewer->packet.size = 0;
    if (viewer->stage == FILL) return next_tile(viewer);
    if (viewer->stage == MAKE) {
        viewer->stage = FILL;
        return make_picture(viewer);
    }
    viewer->stage = MAKE;
    cs_packet_close(&viewer->packet, viewer->picture);
    return viewer->packet.is_good;
}

clshear_status cs_viewer_send(cs_viewer *viewer, double patience, int *is_sent, cs_error *error)
{
    const cs_address *address = &viewer->address;
    *is_sent = viewer->film == NULL;
    while (!*is_sent) {
        cs_packet *packet = &viewer->packet;
        if (viewer->sent == packet->size && !next_packet(viewer))
            return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory");
        *is_sent = packet->size == 0;
        if (*is_sent) viewer->film = NULL;
        if (*is_sent) break;
        const long sent =
            cs_send_some(viewer->file, packet->bytes + viewer->sent, packet->size - viewer->sent);
        if (sent < 0)
            return cs_fail(error, CLSHEAR_BAD_FILE, "display %s:%s: the viewer is gone: %s",
                           address->host, address->port, strerror(errno));
        viewer->sent += (size_t)sent;
        if (sent > 0) continue;
        if (!(patience > 0.0)) return CLSHEAR_OK;
        if (!cs_wait_to_send(viewer->file, patience))
            return cs_fail(error, CLSHEAR_BAD_FILE,
                           "display %s:%s: the viewer has taken nothing for %g s", address->host,
                           address->port, patience);
    }
    return CLSHEAR_OK;
}
