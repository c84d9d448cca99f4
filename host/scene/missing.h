/* File access for Assimp that remembers which files were asked for and not there: Assimp itself
 * only logs them. */
#ifndef CS_SCENE_MISSING_H
#define CS_SCENE_MISSING_H

#include <assimp/cfileio.h>

enum {
    CS_MISSING_MAX = 8,
    CS_MISSING_PATH = 512
};

typedef struct cs_missing {
    int count;
    char paths[CS_MISSING_MAX][CS_MISSING_PATH];
} cs_missing;

/* An interface that records into `missing`, which must outlive it. */
struct aiFileIO cs_recording_file_io(cs_missing *missing);

#endif
