#include "import/mtl.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/number.h"
#include "import/find_file.h"
#include "import/text.h"

typedef struct mtl_reader {
    const char *path;
    cs_model *model;
    cs_array *materials;
    cs_error *error;
    size_t line;
    size_t complaints;
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
    int count;
} value_line;

#define MEMBER(name) offsetof(cs_material_description, name)

static const value_line value_lines[] = {
    {"Kd", MEMBER(base_colour), 3},
    {"Ke", MEMBER(emissive), 3},
    {"Ks", MEMBER(specular), 3},
    {"Ns", MEMBER(shininess), 1},
    {"Ni", MEMBER(ior), 1},
    {"Pr", MEMBER(roughness), 1},
    {"Pm", MEMBER(metallic), 1},
    {"Pc", MEMBER(clearcoat), 1},
    {"Pcr", MEMBER(clearcoat_roughness), 1},
};

/* `Kd r` alone is grey. */
static void read_value(mtl_reader *reader, const value_line *entry,
                       cs_material_description *material, char *at)
{
    double numbers[3];
    float *member = (float *)(void *)((char *)material + entry->offset);
    const int count = read_numbers(&at, numbers, entry->count);
    if (count == 0) {
        char text[80];
        snprintf(text, sizeof text, "\"%.30s\" is not a number%s", cs_rest_of_line(at),
                 entry->count == 3 ? "; colours are red green blue" : "");
        complain(reader, entry->key, text);
        return;
    }
    for (int i = 0; i < entry->count; i++)
        member[i] = (float)numbers[i < count ? i : 0];
    if (count == 2) member[2] = member[1];
    if (strcmp(entry->key, "Pr") == 0 || strcmp(entry->key, "Pm") == 0) material->asks_gloss = 1;
}

/* d, Tr, Tf, illum, sheen: what has no member of its own, or another sense. */
static void read_other(mtl_reader *reader, const char *key, cs_material_description *material,
                       char *at)
{
    double numbers[3];
    char *word = at;
    if (strcasecmp(key, "d") == 0 && strncmp(at + strspn(at, " \t"), "-halo", 5) == 0)
        word = at + strspn(at, " \t") + 5;
    const int count = read_numbers(&word, numbers, 3);
    if (count == 0) return;
    if (strcasecmp(key, "d") == 0 || strcmp(key, "Tr") == 0) {
        const double opacity = strcasecmp(key, "d") == 0 ? numbers[0] : 1.0 - numbers[0];
        material->base_colour[3] = (float)opacity;
        if (opacity < 1.0) material->alpha_mode = CS_ALPHA_BLEND;
    } else if (strcmp(key, "illum") == 0) {
        const int model = (int)numbers[0];
        if (model == 3 || model == 5 || model == 8) cs_material_ask(material, "mirror reflection");
        if (model == 4 || model == 6 || model == 7 || model == 9)
            cs_material_ask(material, "glass");
    } else if (strcmp(key, "Ps") == 0) {
        for (int i = 0; i < 3; i++)
            material->sheen_colour[i] = (float)numbers[i < count ? i : 0];
    } else if (strcmp(key, "aniso") == 0 && numbers[0] != 0.0) {
        cs_material_ask(material, "anisotropy");
    }
    (void)reader;
}

/* ----- Maps ----- */

typedef struct map_line {
    const char *key;
    size_t offset;
} map_line;

static const map_line map_lines[] = {
    {"map_Kd", MEMBER(base_map)},       {"map_Ke", MEMBER(emissive_map)},
    {"map_Ks", MEMBER(specular_map)},   {"map_Ns", MEMBER(specular_map)},
    {"map_d", MEMBER(alpha_map)},       {"map_Tr", MEMBER(alpha_map)},
    {"map_Pr", MEMBER(roughness_map)},  {"map_Pm", MEMBER(metallic_map)},
    {"map_bump", MEMBER(bump_map)},     {"bump", MEMBER(bump_map)},
    {"norm", MEMBER(normal_map)},       {"map_Kn", MEMBER(normal_map)},
    {"disp", MEMBER(displacement_map)}, {"map_disp", MEMBER(displacement_map)},
};

/* Options of a map with their numbers at most; 0: a word. */
static const struct {
    const char *name;
    int numbers;
} options[] = {{"-s", 3},       {"-o", 3},      {"-t", 3},     {"-mm", 2},     {"-bm", 1},
               {"-boost", 1},   {"-texres", 1}, {"-clamp", 0}, {"-blendu", 0}, {"-blendv", 0},
               {"-imfchan", 0}, {"-cc", 0},     {"-type", 0}};

/* Takes one option into `map`; 0 where `*at` begins with none. */
static int take_option(char **at, cs_map *map, double *scale, double *shift)
{
    char *begin = *at + strspn(*at, " \t");
    const size_t length = strcspn(begin, " \t");
    double numbers[3];
    for (size_t i = 0; i < sizeof options / sizeof *options; i++) {
        if (strlen(options[i].name) != length || strncmp(begin, options[i].name, length) != 0)
            continue;
        *at = begin + length;
        const int count = read_numbers(at, numbers, options[i].numbers);
        char *word = *at + strspn(*at, " \t");
        const size_t word_length = strcspn(word, " \t");
        if (options[i].numbers == 0) *at = word + word_length;
        if (strcmp(options[i].name, "-clamp") == 0 && strncmp(word, "on", word_length) == 0)
            map->wrap[0] = map->wrap[1] = CS_WRAP_CLAMP;
        if (strcmp(options[i].name, "-mm") == 0) {
            if (count > 0) map->base = (float)numbers[0];
            if (count > 1) map->gain = (float)numbers[1];
        }
        for (int k = 0; k < count && k < 2; k++) {
            if (strcmp(options[i].name, "-s") == 0) scale[k] = numbers[k];
            if (strcmp(options[i].name, "-o") == 0) shift[k] = numbers[k];
        }
        return 1;
    }
    return 0;
}

static clshear_status read_map(mtl_reader *reader, cs_map *map, char *at)
{
    const char *folders[] = {reader->folders[0], reader->folders[1]};
    double scale[2] = {1, 1}, shift[2] = {0, 0};
    char found[CS_FILE_PATH];
    cs_map_init(map);
    while (take_option(&at, map, scale, shift)) {
    }
    const char *name = cs_rest_of_line(at);
    if (*name == '\0') return CLSHEAR_OK;
    map->across[0] = scale[0];
    map->across[2] = shift[0];
    map->up[1] = scale[1];
    map->up[2] = shift[1];
    const int there = cs_find_file(name, folders, 2, found);
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
        if (strcasecmp(key, map_lines[i].key) == 0) {
            cs_map *map = (cs_map *)(void *)((char *)material + map_lines[i].offset);
            return read_map(reader, map, at);
        }
    if (strcasecmp(key, "refl") == 0 || strcasecmp(key, "map_refl") == 0)
        cs_material_ask(material, "a reflection map");
    read_other(reader, key, material, at);
    return CLSHEAR_OK;
}

static clshear_status read_lines(mtl_reader *reader, cs_bytes *bytes)
{
    cs_lines lines = cs_lines_of(bytes);
    cs_material_description *material = NULL;
    clshear_status status = CLSHEAR_OK;
    for (char *at = cs_lines_next(&lines); at != NULL && status == CLSHEAR_OK;
         at = cs_lines_next(&lines)) {
        reader->line = lines.number;
        const char *key = cs_next_word(&at);
        if (key == NULL || key[0] == '#') continue;
        if (strcasecmp(key, "newmtl") == 0) {
            material = cs_model_extend(reader->materials, 1);
            if (material == NULL) return cs_model_full(reader->model, reader->error);
            cs_material_init(material, cs_rest_of_line(at));
        } else if (material != NULL) {
            status = read_line(reader, material, key, at);
        }
    }
    return status;
}

clshear_status cs_mtl_read(const char *path, cs_model *model, cs_array *materials, cs_error *error)
{
    cs_bytes bytes = {0};
    mtl_reader *reader = calloc(1, sizeof *reader);
    if (reader == NULL) return cs_model_full(model, error);
    *reader = (mtl_reader){path, model, materials, error, 0, 0, {"", ""}};
    cs_folder_of(path, reader->folders[0], sizeof reader->folders[0]);
    cs_folder_of(model->path, reader->folders[1], sizeof reader->folders[1]);
    clshear_status status = cs_bytes_read(path, &bytes, error);
    if (status == CLSHEAR_OK) status = cs_bytes_to_utf8(&bytes, path, error);
    if (status == CLSHEAR_OK) status = read_lines(reader, &bytes);
    if (reader->complaints > 10)
        cs_warn(model->log, "%s: %zu more lines are left out", path, reader->complaints - 10);
    cs_bytes_free(&bytes);
    free(reader);
    return status;
}
