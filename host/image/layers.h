/* Which part of an image file, and which of its channels, are its picture. */
#ifndef CS_IMAGE_LAYERS_H
#define CS_IMAGE_LAYERS_H

#include "image/oiio.h"

/* Finds the channels of red, green, blue and alpha (-1: there is none). Where they are not named,
 * the first three count, or the first one, which is grey. */
void picture_channels(const ImageSpec &spec, int order[4]);

/* The number of the part that is the picture, by the names of its layers and its own, as among the
 * layers of one part: the first of those alike, and 0 where none has named colours. Only EXR files
 * have parts; in other formats they are pages. `image` has read a head, and has that of the part
 * then. */
int picture_part(ImageBuf &image, const std::string &path, const ImageSpec *config,
                 OIIO::Filesystem::IOProxy *memory);

#endif
