/* The parts of reading glTF 2.0: JSON, buffers, accessors, materials, nodes. */
#ifndef CS_IMPORT_GLTF_READER_H
#define CS_IMPORT_GLTF_READER_H

#include <jansson.h>

#include "import/model.h"
#include "import/text.h"

typedef struct gltf_buffer {
    const unsigned char *data; /* NULL: not loaded yet */
    size_t size;
    char *owned;
} gltf_buffer;

enum {
    GLTF_UINT32 = 5125 /* a type of components */
};

/* The numbers of an accessor that a primitive has in compressed form. */
typedef struct gltf_unpacked {
    void *values;      /* those of all items, one behind the other; NULL: it has none; owned */
    long long view;    /* the buffer view that they were unpacked from */
    int type;          /* of a component */
    size_t components; /* of an item */
    size_t count;      /* of items */
} gltf_unpacked;

/* What may be said of many places in a file. */
typedef enum gltf_remark {
    GLTF_DOUBLED,       /* a node that the scene names where it is already */
    GLTF_MORE_JOINTS,   /* a primitive */
    GLTF_BASISU,        /* a texture that is compressed so */
    GLTF_WITHOUT_IMAGE, /* a texture */
    GLTF_WITHOUT_AREA,  /* a primitive of points or lines, beside others */
    GLTF_STANDS_STILL,  /* a channel of an animation that moves no node */
    GLTF_REMARKS
} gltf_remark;

typedef struct gltf_places {
    size_t count;
    char first[64];
} gltf_places;

/* Where a node is in the scene. */
typedef struct gltf_node_place {
    long long parent; /* the node that has it among its children; -1: none */
    int is_known;     /* whether the matrix was found already */
    double matrix[16];
} gltf_node_place;

typedef struct gltf_reader {
    cs_model *model;
    cs_error *error;
    json_t *root;
    const unsigned char *chunk; /* the binary chunk of a GLB, or NULL */
    size_t chunk_size;
    gltf_buffer *buffers;
    size_t buffer_count;
    gltf_buffer *views; /* those that are compressed, once they were asked for */
    size_t view_count;
    gltf_unpacked *unpacked; /* of each accessor */
    size_t accessor_count;
    gltf_node_place *nodes; /* of all nodes; NULL until a skin asks for one */
    char folder[4096];
    int default_material;             /* number of the one for primitives without; -1: none yet */
    gltf_places places[GLTF_REMARKS]; /* of what is said once for all of them */
} gltf_reader;

/* Fails with "FILE: PLACE[index]: ...". `place` is a name in the JSON; index -1: none. */
clshear_status gltf_complain(const gltf_reader *reader, const char *place, long long index,
                             const char *format, ...) __attribute__((format(printf, 4, 5)));

/* Notes a place that a remark is about, which gltf_tell prints for all of them in one line. */
void gltf_note(gltf_reader *reader, gltf_remark remark, const char *place, long long index);
void gltf_tell(const gltf_reader *reader);

/* Element `index` of the array `name` at the root, or NULL after complaining. */
json_t *gltf_at(const gltf_reader *reader, const char *name, long long index);

/* Elements of an array at the root, 0 if there is none. */
size_t gltf_count(const gltf_reader *reader, const char *name);

/* Members of an object with their fallbacks. -1: there is no such index; -2: it is none. */
double gltf_number(const json_t *object, const char *key, double fallback);
long long gltf_index(const json_t *object, const char *key);
const char *gltf_text(const json_t *object, const char *key, const char *fallback);

/* Takes over as many numbers of an array as there are, up to `count`. */
void gltf_numbers(const json_t *object, const char *key, double *numbers, size_t count);
void gltf_floats(const json_t *object, const char *key, float *numbers, size_t count);

/* product = a * b, matrices of 4 columns of 4; `product` is neither of them. */
void gltf_multiply(const double *a, const double *b, double *product);

/* Member `name` of an object's extensions, or NULL. */
json_t *gltf_extension(const json_t *object, const char *name);

/* Makes the strings of a JSON text, in place, what JSON allows: bytes that are no UTF-8, control
 * characters and halves of surrogate pairs become question marks. Returns how many there were. */
size_t gltf_mend_strings(char *text, size_t size);

/* ----- Data ----- */

/* The bytes of a URI: data, or a file beside the scene. `*owned` is freed by the caller. */
clshear_status gltf_uri(const gltf_reader *reader, const char *place, long long index,
                        const char *uri, char **owned, size_t *size);
int gltf_is_data(const char *uri);

/* The file of a URI that is no data; `found` has CS_FILE_PATH bytes. A scheme file:// and what
 * follows ? or # are no parts of its name. */
int gltf_find_file(const gltf_reader *reader, const char *uri, char *found);

/* The bytes of a buffer that `json`, or an extension of it, names: bufferViews[index]. */
clshear_status gltf_range(gltf_reader *reader, const json_t *json, long long index,
                          const unsigned char **data, size_t *size);

/* The bytes of a buffer view; stride: 0 where items lie one behind the other. */
clshear_status gltf_view(gltf_reader *reader, long long index, const unsigned char **data,
                         size_t *size, size_t *stride);

/* Whether the numbers of an accessor are in the file, and not left to an extension. */
int gltf_has_bytes(const gltf_reader *reader, long long index);

/* The type of an accessor's components, and how many an item has; fails where there is no such. */
clshear_status gltf_accessor_type(const gltf_reader *reader, long long index, int *type,
                                  size_t *components);

/* An accessor as floats: `most` components each at most, `*given` of them in the file. `*values` is
 * freed by the caller. */
clshear_status gltf_read_floats(gltf_reader *reader, long long index, size_t most, float **values,
                                size_t *count, size_t *given);

/* Colours, with four components. glTF has no whole numbers here that are not parts of 1, but
 * exporters forget to say so. */
clshear_status gltf_read_colours(gltf_reader *reader, long long index, float **values,
                                 size_t *count, size_t *given);
clshear_status gltf_read_indices(gltf_reader *reader, long long index, uint32_t **values,
                                 size_t *count);

/* ----- Compressed data ----- */

/* Whether meshoptimizer has compressed a buffer view (EXT_meshopt_compression). */
int gltf_is_packed(const json_t *view);

/* The bytes from one item to the next in such a buffer view; 0 in another. */
size_t gltf_packed_stride(const gltf_reader *reader, long long index);

/* The bytes of one that is, unpacked: number `index`. */
clshear_status gltf_packed_view(gltf_reader *reader, long long index, const json_t *view,
                                const unsigned char **data, size_t *size);

/* Unpacks the accessors of a primitive that Draco has compressed (KHR_draco_mesh_compression),
 * unless the file has them as they are, too, and does without the extension. Others are left as
 * they are. *is_list becomes 1 where its indices are those of single triangles, whatever its mode
 * says. */
clshear_status gltf_unpack_primitive(gltf_reader *reader, const char *place,
                                     const json_t *primitive, int *is_list);

/* ----- Content ----- */

/* Whether this extension of a material is read. */
int gltf_reads_of_material(const char *extension);

/* Adds all materials to the model, in the file's order. */
clshear_status gltf_materials(gltf_reader *reader);

/* Walks over the nodes of the scene, and adds their meshes, lights and cameras. */
clshear_status gltf_nodes(gltf_reader *reader);

/* Sets translation, rotation, scale and weights of the nodes to those of the first animation at
 * the model's time. */
clshear_status gltf_animate(gltf_reader *reader);

/* The matrix (4 columns of 4) from a node's coordinates to those of the scene. */
clshear_status gltf_global_matrix(gltf_reader *reader, long long node, double *matrix);

/* ----- Skins and morph targets ----- */

/* What moves the vertices of a node's mesh in the place of the node. */
typedef struct gltf_skin {
    size_t joint_count;   /* 0: the node has no skin */
    double (*joints)[16]; /* from the mesh's coordinates to those of the scene; owned */
    float *which;         /* four joints of each vertex; NULL: none are given; owned */
    float *weights;       /* and how much each counts; owned */
} gltf_skin;

/* The joints of the node's skin. */
clshear_status gltf_skin_open(gltf_reader *reader, const json_t *node, gltf_skin *skin);

/* The joints of the `count` vertices of a primitive, in the place of those of the last. */
clshear_status gltf_skin_bind(gltf_reader *reader, const json_t *attributes, size_t count,
                              gltf_skin *skin);

/* The matrix of a vertex; that of the node without a skin. */
void gltf_skin_matrix(const gltf_skin *skin, size_t vertex, const double *of_node, double *matrix);
void gltf_skin_close(gltf_skin *skin);

/* Adds what the morph targets of a primitive change of an attribute whose `count` values have so
 * many components (COLOR_0: four). weights: those of the node or its mesh, or NULL. */
clshear_status gltf_morph(gltf_reader *reader, const json_t *primitive, const json_t *weights,
                          const char *attribute, size_t components, float *values, size_t count);

/* Adds the triangles of a node's mesh, moved by a matrix (4 columns of 4) or by the node's skin,
 * with the weights of its morph targets. */
clshear_status gltf_mesh(gltf_reader *reader, const json_t *node, const double *matrix);

/* The same once for each of the node's instances (EXT_mesh_gpu_instancing). `instances` is the
 * extension. */
clshear_status gltf_instances(gltf_reader *reader, const json_t *instances, const json_t *node,
                              const double *matrix);

/* The matrix (4 columns of 4) that moves, turns (a unit quaternion) and scales. */
void gltf_compose(const double *translation, const double *rotation, const double *scale,
                  double *matrix);

#endif
