/* Meshes that Draco has compressed. */
#include <draco/compression/decode.h>

#include <cstdlib>
#include <new>

#include "helper/unpack.h"

namespace
{

clshear_status too_large(cs_error *error)
{
    return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "needs more memory than there is");
}

/* All vertices of an attribute. Draco leaves components that it does not have at 0. */
template <typename Number>
clshear_status copy_values(const draco::Mesh &mesh, const draco::PointAttribute &from,
                           cs_packed_attribute *to, cs_error *error)
{
    const std::size_t count = mesh.num_points();
    Number *values = static_cast<Number *>(std::calloc(count + 1, to->components * sizeof(Number)));
    to->values = values;
    if (values == nullptr) return too_large(error);
    for (std::size_t i = 0; i < count; i++) {
        const draco::PointIndex point(static_cast<std::uint32_t>(i));
        if (!from.ConvertValue(from.mapped_index(point), static_cast<std::int8_t>(to->components),
                               values + i * to->components))
            return cs_fail(error, CLSHEAR_BAD_FILE, "its attribute %u is damaged", to->id);
    }
    return CLSHEAR_OK;
}

clshear_status copy_attribute(const draco::Mesh &mesh, cs_packed_attribute *to, cs_error *error)
{
    const draco::PointAttribute *from = mesh.GetAttributeByUniqueId(to->id);
    if (from == nullptr)
        return cs_fail(error, CLSHEAR_BAD_FILE, "has no attribute of the number %u", to->id);
    switch (to->type) {
    case 5120:
        return copy_values<std::int8_t>(mesh, *from, to, error);
    case 5121:
        return copy_values<std::uint8_t>(mesh, *from, to, error);
    case 5122:
        return copy_values<std::int16_t>(mesh, *from, to, error);
    case 5123:
        return copy_values<std::uint16_t>(mesh, *from, to, error);
    case 5124: /* glTF has no such type; its meaning is plain */
        return copy_values<std::int32_t>(mesh, *from, to, error);
    case 5125:
        return copy_values<std::uint32_t>(mesh, *from, to, error);
    default:
        return copy_values<float>(mesh, *from, to, error);
    }
}

clshear_status copy_faces(const draco::Mesh &mesh, cs_packed_mesh *to, cs_error *error)
{
    const std::size_t count = mesh.num_faces();
    to->indices = static_cast<std::uint32_t *>(std::calloc(count + 1, 3 * sizeof *to->indices));
    if (to->indices == nullptr) return too_large(error);
    to->index_count = 3 * count;
    for (std::size_t i = 0; i < count; i++)
        for (std::size_t k = 0; k < 3; k++)
            to->indices[3 * i + k] =
                mesh.face(draco::FaceIndex(static_cast<std::uint32_t>(i)))[k].value();
    return CLSHEAR_OK;
}

clshear_status unpack(const void *bytes, std::size_t size, cs_packed_mesh *mesh, cs_error *error)
{
    draco::DecoderBuffer buffer;
    draco::Decoder decoder;
    buffer.Init(static_cast<const char *>(bytes), size);
    const auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok())
        return cs_fail(error, CLSHEAR_BAD_FILE, "its data are damaged (%.200s)",
                       decoded.status().error_msg());
    mesh->vertex_count = decoded.value()->num_points();
    clshear_status status = copy_faces(*decoded.value(), mesh, error);
    for (std::size_t i = 0; i < mesh->attribute_count && status == CLSHEAR_OK; i++)
        status = copy_attribute(*decoded.value(), &mesh->attributes[i], error);
    return status;
}

} // namespace

clshear_status cs_unpack_draco(const void *bytes, std::size_t size, cs_packed_mesh *mesh,
                               cs_error *error)
{
    try {
        return unpack(bytes, size, mesh, error);
    } catch (const std::exception &) { /* of memory: it throws no others */
        return too_large(error);
    }
}
