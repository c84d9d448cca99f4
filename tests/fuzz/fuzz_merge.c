/* Films of 2 x 1 pixels whose metadata and channels are the bytes, merged. */
#include <stdlib.h>
#include <string.h>

#include "film/merge.h"
#include "targets.h"

typedef struct input {
    const uint8_t *data;
    size_t left;
} input;

static void take(input *from, void *bytes, size_t size)
{
    memset(bytes, 0, size);
    const size_t some = size < from->left ? size : from->left;
    if (some > 0) memcpy(bytes, from->data, some);
    from->data += some;
    from->left -= some;
}

/* A text up to a line's end. */
static void annotate(input *from, clshear_film *film, const char *name)
{
    char text[64];
    size_t used = 0;
    for (char c = 1; used < sizeof text - 1; used++) {
        take(from, &c, 1);
        if (c == '\n' || c == '\0') break;
        text[used] = c;
    }
    text[used] = '\0';
    cs_film_annotate(film, name, text);
}

static clshear_film *film_of(input *from)
{
    static const char *const names[] = {"R",
                                        "G",
                                        "B",
                                        "SampleVariance.R",
                                        "SampleVariance.G",
                                        "SampleVariance.B",
                                        "Samples",
                                        "Variance.R",
                                        "Variance.G",
                                        "Variance.B",
                                        "Z",
                                        "P.X",
                                        "Depth.Z",
                                        "Coverage.A",
                                        "Albedo.R"};
    const int window[4] = {0, 2, 0, 1};
    uint16_t channels;
    int8_t patterns;
    clshear_film *film = NULL;
    cs_error error;
    if (cs_film_create(window, 2, 1, &error, &film) != CLSHEAR_OK) abort();
    take(from, &channels, sizeof channels);
    take(from, &patterns, 1);
    for (size_t c = 0; c < sizeof names / sizeof *names; c++) {
        if (c < 7 ? channels == 7 : (channels >> c & 1) == 0) continue;
        take(from, cs_film_add_channel(film, names[c]), 2 * sizeof(float));
    }
    annotate(from, film, "clshear.shard");
    annotate(from, film, "clshear.recipe");
    cs_film_set_int(film, "clshear.patterns", patterns);
    cs_film_set_int(film, "clshear.spp", channels & 1);
    cs_film_set_int(film, "clshear.adaptive", 0);
    return film;
}

void cs_fuzz_merge(const uint8_t *data, size_t size)
{
    input from = {data, size};
    clshear_film *films[3] = {NULL, NULL, NULL}, *merged = NULL;
    cs_error error;
    size_t count = 0;
    while (count < 3 && from.left > 0) {
        films[count] = film_of(&from);
        count++;
    }
    if (count > 0) cs_film_merge((const clshear_film *const *)films, count, &merged, &error);
    clshear_film *again = NULL;
    if (merged != NULL) cs_film_merge((const clshear_film *const *)&merged, 1, &again, &error);
    cs_film_free(again);
    cs_film_free(merged);
    for (size_t i = 0; i < count; i++)
        cs_film_free(films[i]);
}
