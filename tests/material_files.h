/* Scene files of a square with one material. */
#ifndef CS_TESTS_MATERIAL_FILES_H
#define CS_TESTS_MATERIAL_FILES_H

/* Writes a TGA picture of 2 x 2 texels from the upper left: blue, green, red, alpha. */
void material_picture(const char *name, const unsigned char texels[16]);

/* The same of one colour. */
void material_even_picture(const char *name, int red, int green, int blue, int alpha);

/* Write a square from -1 to 1 in x and y, which faces +z and shows its textures once, with a
 * material of these lines (MTL; all of the file if they begin with #) or this JSON (glTF, with '
 * for "); return the path. Textures 0 and 1 of glTF are grey.tga and tone.tga. */
const char *material_mtl(const char *lines);
const char *material_gltf(const char *material);

/* The same; the colours of its vertices are white, with an alpha from 0 at the left to 1 at the
 * right. */
const char *material_gltf_fading(const char *material);

#endif
