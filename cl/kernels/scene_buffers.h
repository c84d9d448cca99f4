/* A scene's buffers as kernels take and pass them. Device only. */
#ifndef CS_SCENE_BUFFERS_H
#define CS_SCENE_BUFFERS_H

#include "clshear/device/packet.h"
#include "kernels/features.h"
#include "kernels/scene.h"

#define CS_SCENE_MEMBER(identifier, name, type) CS_GLOBAL const type *name;
#define CS_SCENE_PARAMETER(identifier, name, type) , CS_GLOBAL const type *name
#define CS_SCENE_VALUE(identifier, name, type) name,

typedef struct cs_scene_buffers {
    CS_SCENE_BUFFER_LIST(CS_SCENE_MEMBER)
#if CS_HAS(MOVING)
    cs_vfloat time; /* of each lane: the scene is that of this time, 0 to 1 */
#endif
} cs_scene_buffers;

/* The last parameters of a kernel that looks at the scene, with the comma before them. */
#define CS_SCENE_PARAMETERS CS_SCENE_BUFFER_LIST(CS_SCENE_PARAMETER)

#if CS_HAS(MOVING)
#define CS_SCENE_AT_OPEN (cs_vfloat)(0.0f)
#else
#define CS_SCENE_AT_OPEN
#endif

/* The initialiser of a cs_scene_buffers from those parameters; of the scene where the shutter
 * opens. */
#define CS_SCENE_VALUES                                       \
    {                                                         \
        CS_SCENE_BUFFER_LIST(CS_SCENE_VALUE) CS_SCENE_AT_OPEN \
    }

#endif
