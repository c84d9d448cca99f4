/* The bytes as an EXR file: a film, merged with itself, and written if that is done. */
#include "clshear/clshear.h"
#include "targets.h"

void cs_fuzz_film(const uint8_t *data, size_t size)
{
    clshear_film *film = NULL, *merged = NULL;
    if (clshear_film_read(cs_fuzz_file("x.exr", data, size), &film) != CLSHEAR_OK) return;
    const clshear_film *films[2] = {film, film};
    if (clshear_film_merge(films, 1, &merged) == CLSHEAR_OK)
        clshear_film_write(merged, cs_fuzz_path("merged.exr"));
    clshear_film_free(merged);
    merged = NULL;
    clshear_film_merge(films, 2, &merged);
    clshear_film_free(merged);
    clshear_film_free(film);
}
