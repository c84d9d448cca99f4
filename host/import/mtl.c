#include "import/mtl.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/checksum.h"
#include "base/number.h"
#include "import/find_file.h"
#include "import/mtl_surface.h"
#include "import/text.h"

typedef struct mtl_reader {
    const char *path;
    cs_model *model;
    cs_array *materials;
    mtl_values values; /* of the last material */
    cs_error *error;
    size_t line;
    size_t complaints;
    float blender_most;            /* as in mtl_values */
    size_t turned;                 /* materials whose Tr of 1 is taken for opaque */
    char folders[2][CS_FILE_PATH]; /* of the library and of the model */
} mtl_reader;

static void complain(mtl_reader *reader, const char *key, const char *what)
{
    if (++reader->complaints > 10) return; /* one damaged file, not a thousand lines */
    cs_warn(reader->model->log, "%s:%zu: %.40s %s; left out", reader->path, reader->line, key,
            what);
}

/* Reads up to `most` numbers; returns how many there are before the first word that is none. */
static int read_numbers(char **at, double *numbers, int most)
{
    int count = 0;
    while (count < most) {
        char *before = *at + strspn(*at, " \t");
        const char *end = before + strcspn(before, " \t");
        const char *after = cs_parse_number(before, end, &numbers[count]);
        if (before == end || after != end) break;
        *at += (size_t)(after - *at);
        count++;
    }
    return count;
}

/* ----- Values ----- */

typedef struct value_line {
    const char *key;
    size_t offset; /* of the member, floats */
    int is_raw;    /* a member of mtl_values, otherwise of the description */
    int count;
} value_line;

#define MEMBER(name) offsetof(cs_material_description, name), 0
#define RAW(name) offsetof(mtl_values, name), 1

static const value_line value_lines[] = {
    {"Kd", MEMBER(base_colour), 3},
    {"Ke", MEMBER(emissive), 3},
    {"Ks", RAW(highlight), 3},
    {"Ns", RAW(exponent), 1},
    {"Ni", RAW(ior), 1},
    {"Tr", RAW(transparency), 1},
    {"Tf", RAW(filter), 3},
    {"Pr", RAW(roughness), 1},
    {"Pm", RAW(metallic), 1},
    {"Pc", MEMBER(clearcoat), 1},
    {"Pcr", MEMBER(clearcoat_roughness), 1},
    {"Ps", MEMBER(sheen_colour), 3},
};

/* `Kd r` alone is grey. */
static void read_value(mtl_reader *reader, const value_line *entry,
                       cs_material_description *material, char *at)
{
    double numbers[3];
    char *base = entry->is_raw ? (char *)&reader->values : (char *)material;
    float *member = (float *)(void *)(base + entry->offset);
    const int count = read_numbers(&at, numbers, entry->count);
    const char *behind = at + strspn(at, " \t");
    if (count == 0 || (count < entry->count && *behind != '\0' && *behind != '#')) {
        char text[80];
        snprintf(text, sizeof text, "\"%.30s\" is not a number%s", cs_rest_of_line(at),
                 entry->count == 3 ? "; colours are red green blue" : "");
        complain(reader, entry->key, text);
        return;
    }
    for (int i = 0; i < entry->count; i++)
        member[i] = (float)numbers[i < count ? i : 0];
    if (count == 2) member[2] = member[1];
    if (member == material->base_colour) reader->values.has_colour = 1;
}

/* `d -halo FACTOR`, whose halo is left out, illum, Ka, and what there is no place for. */
static void read_other(mtl_reader *reader, const char *key, cs_material_description *material,
                       char *at)
{
    double numbers[3];
    char *word = at + strspn(at, " \t");
    const int is_opacity = strcasecmp(key, "d") == 0;
    if (is_opacity && strncmp(word, "-halo", 5) == 0) word += 5;
    const int count = read_numbers(&word, numbers, 3);
    if (count == 0) return;
    const double number = numbers[0];
    if (is_opacity) reader->values.opacity = (float)number;
    if (strcmp(key, "illum") == 0 && number >= 0.0 && number < 100.0)
        reader->values.model = (int)number;
    if (strcmp(key, "Ka") == 0)
        for (int i = 0; i < 3; i++)
            reader->values.ambient[i] = (float)numbers[i < count ? i : 0];
    if (strcmp(key, "aniso") == 0 && number != 0.0) cs_material_ask(material, "anisotropy");
}

/* ----- Maps ----- */

typedef struct map_line {
    const char *key;
    size_t offset;
    cs_texel_kind kind;
} map_line;

#define MAP(name) offsetof(cs_material_description, name)

static const map_line map_lines[] = {
    {"map_Kd", MAP(base_map), CS_TEXELS_COLOUR},
    {"map_Ke", MAP(emissive_map), CS_TEXELS_COLOUR},
    {"map_emissive", MAP(emissive_map), CS_TEXELS_COLOUR},
    {"map_Ns", MAP(roughness_map), CS_TEXELS_GLOSS},
    {"map_d", MAP(alpha_map), CS_TEXELS_OPACITY},
    {"map_Pr", MAP(roughness_map), CS_TEXELS_DATA},
    {"map_Pm", MAP(metallic_map), CS_TEXELS_DATA},
    {"map_bump", MAP(normal_map), CS_TEXELS_BUMPS},
    {"bump", MAP(normal_map), CS_TEXELS_BUMPS},
    {"norm", MAP(normal_map), CS_TEXELS_DATA},
    {"map_Kn", MAP(normal_map), CS_TEXELS_DATA},
};

/* Maps that there is no place for. */
static const struct {
    const char *key;
    const char *word;
} other_maps[] = {{"map_Ks", "a map of highlights"},      {"disp", "displacement"},
                  {"map_disp", "displacement"},           {"refl", "a reflection map"},
                  {"map_refl", "a reflection map"},       {"map_Tr", "a map of transparency"},
                  {"map_Ps", "a map of sheen"},           {"map_Pc", "a map of the clear coat"},
                  {"map_Pcr", "a map of the clear coat"}, {"decal", "a decal"}};

/* Options of a map with their numbers at most, or the words that they take. */
static const struct {
    const char *name;
    int numbers;
    const char *words[7];
} options[] = {
    {"-s", 3, {0}},
    {"-o", 3, {0}},
    {"-t", 3, {0}},
    {"-mm", 2, {0}},
    {"-bm", 1, {0}},
    {"-boost", 1, {0}},
    {"-texres", 1, {0}},
    {"-clamp", 0, {"on", "off"}},
    {"-blendu", 0, {"on", "off"}},
    {"-blendv", 0, {"on", "off"}},
    {"-cc", 0, {"on", "off"}},
    {"-colorspace", 0, {"sRGB", "linear"}},
    {"-imfchan", 0, {"r", "g", "b", "m", "l", "z"}},
    {"-type",
     0,
     {"sphere", "cube_top", "cube_bottom", "cube_front", "cube_back", "cube_left", "cube_right"}}};

enum {
    OPTIONS = sizeof options / sizeof *options,
    WORDS = sizeof options[0].words / sizeof *options[0].words
};

/* The option at the beginning of `text`: its place in `options`, or their number. */
static size_t option_at(const char *text)
{
    const size_t length = strcspn(text, " \t");
    size_t i = 0;
    while (i < OPTIONS &&
           (strlen(options[i].name) != length || strncmp(text, options[i].name, length) != 0))
        i++;
    return i;
}

/* Goes past a word that option number `i` takes, and returns it as the option's table has it; NULL
 * where another one follows, which may be the name of the image. */
static const char *take_word(size_t i, char **at)
{
    char *word = *at + strspn(*at, " \t");
    const size_t length = strcspn(word, " \t");
    for (size_t k = 0; k < WORDS && options[i].words[k] != NULL; k++) {
        const char *known = options[i].words[k];
        if (strlen(known) != length || strncasecmp(word, known, length) != 0) continue;
        *at = word + length;
        return known;
    }
    return NULL;
}

/* Takes one option into `map`; 0 where `*at` begins with none. */
static int take_option(char **at, cs_map *map, double *scale, double *shift, double *bump)
{
    char *begin = *at + strspn(*at, " \t");
    const size_t i = option_at(begin);
    double numbers[3];
    if (i == OPTIONS) return 0;
    *at = begin + strlen(options[i].name);
    const int count = read_numbers(at, numbers, options[i].numbers);
    const char *word = take_word(i, at);
    if (strcmp(options[i].name, "-clamp") == 0 && word != NULL && strcmp(word, "on") == 0)
        map->wrap[0] = map->wrap[1] = CS_WRAP_CLAMP;
    if (strcmp(options[i].name, "-mm") == 0) {
        if (count > 0) map->use.base = (float)numbers[0];
        if (count > 1) map->use.gain = (float)numbers[1];
    }
    if (strcmp(options[i].name, "-bm") == 0 && count > 0) *bump = numbers[0];
    for (int k = 0; k < count && k < 2; k++) {
        if (strcmp(options[i].name, "-s") == 0) scale[k] = numbers[k];
        if (strcmp(options[i].name, "-o") == 0) shift[k] = numbers[k];
    }
    return 1;
}

/* Cuts the first option behind a name, and what follows it; returns where it was, or NULL. */
static char *cut_options(char *name)
{
    for (char *mark = strchr(name, '-'); mark != NULL; mark = strchr(mark + 1, '-')) {
        if (mark == name || (mark[-1] != ' ' && mark[-1] != '\t') || option_at(mark) == OPTIONS)
            continue;
        mark[-1] = '\0';
        return mark;
    }
    return NULL;
}

/* Finds the image of that name, or else of what is before a comment, or before options, which
 * belong in front of the name: names may hold both. Returns whether it is there; `found` gets the
 * path, and `*options` those behind the name, or NULL. */
static int find_image(const mtl_reader *reader, char *name, char found[CS_FILE_PATH],
                      char **options)
{
    const char *folders[] = {reader->folders[0], reader->folders[1]};
    *options = NULL;
    if (cs_find_file(name, folders, 2, found)) return 1;
    if (cs_cut_comment(name) && cs_find_file(name, folders, 2, found)) return 1;
    *options = cut_options(name);
    return *options != NULL && cs_find_file(cs_rest_of_line(name), folders, 2, found);
}

static clshear_status read_map(mtl_reader *reader, cs_material_description *material,
                               const map_line *entry, char *at)
{
    cs_map *map = (cs_map *)(void *)((char *)material + entry->offset);
    double scale[2] = {1, 1}, shift[2] = {0, 0}, bump = 1.0;
    char found[CS_FILE_PATH];
    cs_map_init(map);
    map->use.kind = entry->kind;
    while (take_option(&at, map, scale, shift, &bump)) {
    }
    char *name = cs_rest_of_line(at), *behind;
    if (*name == '\0') return CLSHEAR_OK;
    const int there = find_image(reader, name, found, &behind);
    while (behind != NULL && take_option(&behind, map, scale, shift, &bump)) {
    }
    if (map == &material->normal_map) material->normal_scale = (float)bump;
    map->across[0] = scale[0];
    map->across[2] = shift[0];
    map->up[1] = scale[1];
    map->up[2] = shift[1];
    return cs_model_add_image(reader->model, there ? found : "", there ? found : name, NULL, 0,
                              &map->image, reader->error);
}

/* ----- Lines ----- */

static clshear_status read_line(mtl_reader *reader, cs_material_description *material,
                                const char *key, char *at)
{
    for (size_t i = 0; i < sizeof value_lines / sizeof *value_lines; i++)
        if (strcasecmp(key, value_lines[i].key) == 0) {
            read_value(reader, &value_lines[i], material, at);
            return CLSHEAR_OK;
        }
    for (size_t i = 0; i < sizeof map_lines / sizeof *map_lines; i++)
        if (strcasecmp(key, map_lines[i].key) == 0)
            return read_map(reader, material, &map_lines[i], at);
    for (size_t i = 0; i < sizeof other_maps / sizeof *other_maps; i++)
        if (strcasecmp(key, other_maps[i].key) == 0) cs_material_ask(material, other_maps[i].word);
    read_other(reader, key, material, at);
    return CLSHEAR_OK;
}

void cs_mtl_key(const char *name, char key[CS_MATERIAL_NAME])
{
    const size_t length = strlen(name);
    memset(key, 0, CS_MATERIAL_NAME);
    memcpy(key, name, length < CS_MATERIAL_NAME ? length : CS_MATERIAL_NAME - 1);
    if (length >= CS_MATERIAL_NAME)
        snprintf(key + CS_MATERIAL_NAME - 18, 18, "~%016llx",
                 (unsigned long long)cs_checksum_add(CS_CHECKSUM_OF_NOTHING, name, length));
}

static void finish_material(mtl_reader *reader, cs_material_description *material)
{
    if (material != NULL && mtl_make_surface(&reader->values, material)) reader->turned++;
}

/* "# Blender MTL File: ...", and since 3.1 "# Blender 3.1.0 MTL File: ..." */
static float blender_most_of(const char *comment)
{
    static const char name[] = "Blender ";
    const char *word = comment + strspn(comment, " \t");
    if (strncmp(word, name, sizeof name - 1) != 0) return 0.0f;
    return strncmp(word + sizeof name - 1, "MTL", 3) == 0 ? 900.0f : 1000.0f;
}

static clshear_status read_lines(mtl_reader *reader, cs_bytes *bytes)
{
    char name[CS_MATERIAL_NAME];
    cs_lines lines = cs_lines_of(bytes);
    cs_material_description *material = NULL;
    clshear_status status = CLSHEAR_OK;
    for (char *at = cs_lines_next(&lines); at != NULL && status == CLSHEAR_OK;
         at = cs_lines_next(&lines)) {
        reader->line = lines.number;
        const char *key = cs_next_word(&at);
        if (key != NULL && strcmp(key, "#") == 0 && lines.number == 1)
            reader->blender_most = blender_most_of(at);
        if (key == NULL || key[0] == '#') continue;
        if (strcasecmp(key, "newmtl") == 0) {
            finish_material(reader, material);
            mtl_values_init(&reader->values);
            reader->values.blender_most = reader->blender_most;
            material = cs_model_extend(reader->materials, 1);
            if (material == NULL) return cs_model_full(reader->model, reader->error);
            cs_mtl_key(cs_rest_of_line(at), name);
            cs_material_init(material, name);
        } else if (material != NULL) {
            status = read_line(reader, material, key, at);
        }
    }
    finish_material(reader, material);
    return status;
}

clshear_status cs_mtl_read(const char *path, cs_model *model, cs_array *materials, cs_error *error)
{
    cs_bytes bytes = {0};
    mtl_reader *reader = calloc(1, sizeof *reader);
    if (reader == NULL) return cs_model_full(model, error);
    *reader = (mtl_reader){.path = path, .model = model, .materials = materials, .error = error};
    cs_folder_of(path, reader->folders[0], sizeof reader->folders[0]);
    cs_folder_of(model->path, reader->folders[1], sizeof reader->folders[1]);
    clshear_status status = cs_bytes_read(path, &bytes, error);
    if (status == CLSHEAR_OK) status = cs_bytes_to_utf8(&bytes, path, error);
    if (status == CLSHEAR_OK) status = read_lines(reader, &bytes);
    if (reader->complaints > 10)
        cs_warn(model->log, "%s: %zu more lines are left out", path, reader->complaints - 10);
    if (reader->turned > 0)
        cs_warn(
            model->log,
            "%s: Tr 1 is taken as opaque, as some programs mean it, in %zu material%s without d; "
            "write d 0 to hide",
            path, reader->turned, reader->turned > 1 ? "s" : "");
    cs_bytes_free(&bytes);
    free(reader);
    return status;
}
