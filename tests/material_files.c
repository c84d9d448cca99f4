#include "material_files.h"

#include <stdio.h>

#include "support.h"

void material_picture(const char *name, const unsigned char texels[16])
{
    unsigned char bytes[18 + 16] = {0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 2, 0, 32, 0x28};
    memcpy(bytes + 18, texels, 16);
    test_bytes(name, bytes, sizeof bytes);
}

void material_even_picture(const char *name, int red, int green, int blue, int alpha)
{
    unsigned char texels[16];
    for (size_t i = 0; i < 4; i++) {
        const int texel[4] = {blue, green, red, alpha};
        for (size_t c = 0; c < 4; c++)
            texels[4 * i + c] = (unsigned char)texel[c];
    }
    material_picture(name, texels);
}

const char *material_mtl(const char *lines)
{
    char text[1024];
    snprintf(text, sizeof text, "%s%s\n", lines[0] == '#' ? "" : "newmtl m\n", lines);
    test_file("material.mtl", text);
    return test_file("material.obj", "mtllib material.mtl\nusemtl m\n"
                                     "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\n"
                                     "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n");
}

/* attributes: more of the primitive's. */
static const char *write_gltf(const char *material, const char *attributes)
{
    static const float data[36] = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0, 0, 1, 1, 1, 1, 0,
                                   0,  0,  1, 1, 1,  0, 1, 1, 1, 1,  1, 1, 1, 1, 1, 1, 1, 0};
    static const unsigned char indices[6] = {0, 1, 2, 0, 2, 3};
    unsigned char bytes[sizeof data + sizeof indices];
    char text[4096];
    memcpy(bytes, data, sizeof data);
    memcpy(bytes + sizeof data, indices, sizeof indices);
    test_bytes("material.bin", bytes, sizeof bytes);
    snprintf(text, sizeof text,
             "{'asset':{'version':'2.0'},'scenes':[{'nodes':[0]}],'nodes':[{'mesh':0}],"
             "'meshes':[{'primitives':[{'attributes':{'POSITION':0,'TEXCOORD_0':1%s},'indices':2,"
             "'material':0}]}],'materials':[%s],"
             "'buffers':[{'uri':'material.bin','byteLength':150}],"
             "'bufferViews':[{'buffer':0,'byteLength':150}],'accessors':["
             "{'bufferView':0,'componentType':5126,'count':4,'type':'VEC3'},"
             "{'bufferView':0,'byteOffset':48,'componentType':5126,'count':4,'type':'VEC2'},"
             "{'bufferView':0,'byteOffset':144,'componentType':5121,'count':6,'type':'SCALAR'},"
             "{'bufferView':0,'byteOffset':80,'componentType':5126,'count':4,'type':'VEC4'}],"
             "'textures':[{'source':0},{'source':1}],"
             "'images':[{'uri':'grey.tga'},{'uri':'tone.tga'}]}",
             attributes, material);
    for (char *at = text; *at != '\0'; at++)
        if (*at == '\'') *at = '"';
    return test_file("material.gltf", text);
}

const char *material_gltf(const char *material)
{
    return write_gltf(material, "");
}

const char *material_gltf_fading(const char *material)
{
    return write_gltf(material, ",'COLOR_0':3");
}
