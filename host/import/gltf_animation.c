/* Animations of glTF: what the nodes' transformations and weights are at a time. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "import/gltf_reader.h"

/* The curve of a channel: values at times, `width` numbers each. */
typedef struct gltf_curve {
    float *times; /* s, ascending; owned */
    size_t count;
    float *values; /* owned; with tangents three for each time: in, value, out */
    size_t width;
    int has_tangents;
    int is_step;
    int is_rotation;
} gltf_curve;

static const float *value_at(const gltf_curve *curve, size_t key, size_t part)
{
    const size_t parts = curve->has_tangents ? 3 : 1;
    return curve->values + (key * parts + (curve->has_tangents ? part : 0)) * curve->width;
}

/* Between two unit quaternions, on the shorter arc (Shoemake 1985). */
static void slerp(const float *a, const float *b, double part, double *value)
{
    double cosine = 0.0;
    for (int i = 0; i < 4; i++)
        cosine += (double)a[i] * (double)b[i];
    const double sign = cosine < 0.0 ? -1.0 : 1.0, angle = acos(fmin(fabs(cosine), 1.0));
    const double first = angle > 1e-6 ? sin((1.0 - part) * angle) / sin(angle) : 1.0 - part;
    const double second = angle > 1e-6 ? sin(part * angle) / sin(angle) : part;
    for (int i = 0; i < 4; i++)
        value[i] = first * (double)a[i] + sign * second * (double)b[i];
}

/* The curve at a time; before the first and after the last key it stands still. */
static void evaluate(const gltf_curve *curve, double time_s, double *value)
{
    size_t key = 0;
    while (key + 1 < curve->count && (double)curve->times[key + 1] <= time_s)
        key++;
    const int inside = key + 1 < curve->count && time_s > (double)curve->times[key];
    const size_t next = inside ? key + 1 : key;
    const double length_s = (double)curve->times[next] - (double)curve->times[key];
    const double u = length_s > 0.0 ? (time_s - (double)curve->times[key]) / length_s : 0.0;
    const float *a = value_at(curve, key, 1), *b = value_at(curve, next, 1);
    if (curve->is_rotation && !curve->has_tangents && !curve->is_step) {
        slerp(a, b, u, value);
        return;
    }
    const float *leave = value_at(curve, key, 2), *arrive = value_at(curve, next, 0);
    for (size_t i = 0; i < curve->width; i++) {
        const double p = (double)a[i], q = (double)b[i];
        value[i] = curve->is_step ? p : p + u * (q - p);
        if (curve->has_tangents) /* Hermite's cubic, glTF 2.0, appendix C.5 */
            value[i] = (2 * u * u * u - 3 * u * u + 1) * p +
                       (u * u * u - 2 * u * u + u) * length_s * (double)leave[i] +
                       (3 * u * u - 2 * u * u * u) * q +
                       (u * u * u - u * u) * length_s * (double)arrive[i];
    }
}

/* Writes the curve's value into the node, as if the file had it there. */
static clshear_status put(gltf_reader *reader, const gltf_curve *curve, json_t *node,
                          const char *path)
{
    json_t *array = json_array();
    double *value = malloc(curve->width * sizeof *value);
    int good = array != NULL && value != NULL;
    if (good) evaluate(curve, reader->model->time_s, value);
    for (size_t i = 0; i < curve->width && good; i++)
        good = json_array_append_new(array, json_real(isfinite(value[i]) ? value[i] : 0.0)) == 0;
    free(value);
    if (strcmp(path, "weights") != 0) json_object_del(node, "matrix");
    if (good)
        return json_object_set_new(node, path, array) == 0
                   ? CLSHEAR_OK
                   : cs_model_full(reader->model, reader->error);
    json_decref(array);
    return cs_model_full(reader->model, reader->error);
}

static clshear_status read_curve(gltf_reader *reader, const json_t *sampler, const char *path,
                                 gltf_curve *curve)
{
    clshear_status status = CLSHEAR_OK;
    const char *kind = gltf_text(sampler, "interpolation", "LINEAR");
    const size_t components = strcmp(path, "rotation") == 0  ? 4
                              : strcmp(path, "weights") == 0 ? 1
                                                             : 3;
    size_t given = 0, items = 0;
    *curve = (gltf_curve){.has_tangents = strcmp(kind, "CUBICSPLINE") == 0,
                          .is_step = strcmp(kind, "STEP") == 0,
                          .is_rotation = components == 4};
    CS_TRY(gltf_read_floats(reader, gltf_index(sampler, "input"), 1, &curve->times, &curve->count,
                            &given));
    CS_TRY(gltf_read_floats(reader, gltf_index(sampler, "output"), components, &curve->values,
                            &items, &given));
    if (given != components && curve->count > 0) {
        status = gltf_complain(reader, "animations", 0, "a curve of %s has %zu numbers a key", path,
                               given);
        goto done;
    }
    const size_t keys = curve->count * (curve->has_tangents ? 3 : 1);
    if (keys == 0 || items % keys != 0 || items == 0 || (components > 1 && items != keys)) {
        status = gltf_complain(reader, "animations", 0, "a curve of %s has %zu values for %zu keys",
                               path, items, curve->count);
        goto done;
    }
    curve->width = components * items / keys;
done:
    return status;
}

/* What of a node a channel moves: *path is "" if it is something else. KHR_animation_pointer names
 * it as "/nodes/0/scale". */
static long long node_of(const json_t *target, const char **path)
{
    static const char *const paths[] = {"translation", "rotation", "scale", "weights"};
    static const char nodes[] = "/nodes/";
    const json_t *extension = gltf_extension(target, "KHR_animation_pointer");
    const char *given = gltf_text(target, "path", ""), *at = gltf_text(extension, "pointer", "");
    long long node = gltf_index(target, "node");
    if (strcmp(given, "pointer") == 0 && strncmp(at, nodes, strlen(nodes)) == 0) {
        char *end;
        node = strtoll(at + strlen(nodes), &end, 10);
        given = *end == '/' && node >= 0 ? end + 1 : "";
    }
    *path = "";
    for (size_t i = 0; i < sizeof paths / sizeof *paths; i++)
        if (strcmp(given, paths[i]) == 0) *path = paths[i];
    return node;
}

static clshear_status play_channel(gltf_reader *reader, const json_t *animation, size_t place)
{
    const json_t *channel = json_array_get(json_object_get(animation, "channels"), place);
    const char *path = "";
    const long long number = node_of(json_object_get(channel, "target"), &path);
    const long long index = gltf_index(channel, "sampler");
    const json_t *sampler =
        index >= 0 ? json_array_get(json_object_get(animation, "samplers"), (size_t)index) : NULL;
    gltf_curve curve = {0};
    if (number == -1 || *path == '\0') {
        gltf_note(reader, GLTF_STANDS_STILL, "animations[0].channels", (long long)place);
        return CLSHEAR_OK;
    }
    json_t *node = gltf_at(reader, "nodes", number);
    if (node == NULL) return CLSHEAR_BAD_FILE;
    if (sampler == NULL)
        return gltf_complain(reader, "animations", 0, "a channel asks for sampler %lld", index);
    clshear_status status = read_curve(reader, sampler, path, &curve);
    if (status == CLSHEAR_OK) status = put(reader, &curve, node, path);
    free(curve.times);
    free(curve.values);
    return status;
}

clshear_status gltf_animate(gltf_reader *reader)
{
    const json_t *animation = json_array_get(json_object_get(reader->root, "animations"), 0);
    const json_t *channels = json_object_get(animation, "channels");
    clshear_status status = CLSHEAR_OK;
    const size_t count = gltf_count(reader, "animations");
    if (!reader->model->is_played) return CLSHEAR_OK;
    if (count > 1)
        cs_warn(reader->model->log, "%s: %zu animations, of which the first is played",
                reader->model->path, count);
    for (size_t i = 0; i < json_array_size(channels) && status == CLSHEAR_OK; i++)
        status = play_channel(reader, animation, i);
    return status;
}
