/* Which part of an image file, and which of its channels, are its picture. */
#ifndef CS_IMAGE_LAYERS_H
#define CS_IMAGE_LAYERS_H

#include "image/oiio.h"

/* Finds the channels of red, green, blue and alpha (-1: there is none). Where they are not named,
 * the first three count, or the first one, which is grey. */
void picture_channels(const ImageSpec &spec, int order[4]);

/* The number, from 0, of the EXR part that holds the picture. It is chosen by the names of parts
 * and layers, as a layer is chosen within a part; the first of equals counts. 0 where no part has
 * named colours, and in other formats, whose parts are pages. `image` must have read a head; it has
 * that of the chosen part afterwards. */
int picture_part(ImageBuf &image, const std::string &path, const ImageSpec *config,
                 OIIO::Filesystem::IOProxy *memory);

#endif
