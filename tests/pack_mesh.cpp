#include "pack_mesh.h"

#include <draco/compression/encode.h>

#include <cstring>

namespace
{

using draco::GeometryAttribute;

/* An attribute whose items are those of `values`, one for each vertex. */
void add(draco::Mesh *to, GeometryAttribute::Type kind, draco::DataType type, int components,
         std::size_t item_size, const void *values)
{
    GeometryAttribute attribute;
    attribute.Init(kind, nullptr, static_cast<std::uint8_t>(components), type,
                   type == draco::DT_UINT8, static_cast<std::int64_t>(item_size), 0);
    const int id = to->AddAttribute(attribute, true, to->num_points());
    for (std::uint32_t i = 0; i < to->num_points(); i++)
        to->attribute(id)->SetAttributeValue(draco::AttributeValueIndex(i),
                                             static_cast<const char *>(values) + i * item_size);
}

} // namespace

extern "C" size_t test_pack_draco(const test_mesh *mesh, int is_short, unsigned char *bytes,
                                  size_t most)
{
    draco::Mesh made;
    made.set_num_points(static_cast<std::uint32_t>(mesh->vertex_count));
    made.SetNumFaces(mesh->triangle_count);
    for (std::uint32_t i = 0; i < mesh->triangle_count; i++) {
        draco::Mesh::Face face;
        for (std::size_t k = 0; k < 3; k++)
            face[k] = draco::PointIndex(mesh->indices[3 * i + k]);
        made.SetFace(draco::FaceIndex(i), face);
    }
    add(&made, GeometryAttribute::POSITION, draco::DT_FLOAT32, 3, 12, mesh->positions);
    add(&made, GeometryAttribute::NORMAL, draco::DT_FLOAT32, 3, 12, mesh->normals);
    add(&made, GeometryAttribute::TEX_COORD, draco::DT_FLOAT32, 2, 8, mesh->textures);
    add(&made, GeometryAttribute::COLOR, draco::DT_UINT8, 4, 4, mesh->colours);
    draco::Encoder encoder;
    encoder.SetEncodingMethod(is_short ? draco::MESH_EDGEBREAKER_ENCODING
                                       : draco::MESH_SEQUENTIAL_ENCODING);
    if (is_short)
        for (const auto kind :
             {GeometryAttribute::POSITION, GeometryAttribute::NORMAL, GeometryAttribute::TEX_COORD})
            encoder.SetAttributeQuantization(kind, 14);
    draco::EncoderBuffer packed;
    if (!encoder.EncodeMeshToBuffer(made, &packed).ok() || packed.size() > most) return 0;
    std::memcpy(bytes, packed.data(), packed.size());
    return packed.size();
}
