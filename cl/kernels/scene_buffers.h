/* A scene's buffers as kernels take and pass them. Device only. */
#ifndef CS_SCENE_BUFFERS_H
#define CS_SCENE_BUFFERS_H

#include "kernels/scene.h"

#define CS_SCENE_MEMBER(identifier, name, type) CS_GLOBAL const type *name;
#define CS_SCENE_PARAMETER(identifier, name, type) , CS_GLOBAL const type *name
#define CS_SCENE_VALUE(identifier, name, type) name,

typedef struct cs_scene_buffers {
    CS_SCENE_BUFFER_LIST(CS_SCENE_MEMBER)
} cs_scene_buffers;

/* The last parameters of a kernel that looks at the scene, with the comma before them. */
#define CS_SCENE_PARAMETERS CS_SCENE_BUFFER_LIST(CS_SCENE_PARAMETER)

/* The initialiser of a cs_scene_buffers from those parameters. */
#define CS_SCENE_VALUES                      \
    {                                        \
        CS_SCENE_BUFFER_LIST(CS_SCENE_VALUE) \
    }

#endif
