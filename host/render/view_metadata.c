#include "render/view_metadata.h"

#include <string.h>

#include "film/film.h"

/* World to camera space for row vectors: x right, y up, z forward, as OpenEXR has it. The world has
 * the coordinates of the file, whose `origin` is that of the scene. */
static void world_to_camera(const cs_camera *camera, const double *origin, float *matrix)
{
    memset(matrix, 0, 16 * sizeof *matrix);
    matrix[15] = 1.0f;
    for (int axis = 0; axis < 3; axis++) {
        const float columns[3] = {camera->right[axis], -camera->down[axis], camera->forward[axis]};
        for (int column = 0; column < 3; column++) {
            matrix[4 * axis + column] = columns[column] + 0.0f; /* no -0 */
            matrix[12 + column] -=
                (float)((double)camera->eye[axis] + origin[axis]) * columns[column];
        }
    }
}

/* World to the picture for row vectors: after division by the fourth coordinate, (0, 0) is the
 * upper left corner of the whole picture and (1, 1) its lower right one. */
static void world_to_picture(const cs_job *job, const float *to_camera, float *matrix)
{
    const cs_camera *camera = &job->camera;
    const float distance = camera->orthographic ? 1.0f : camera->focal_distance;
    const float across = camera->pixel_width * (float)job->width / distance;
    const float down = camera->pixel_width * (float)job->height / distance;
    for (int row = 0; row < 4; row++) {
        const float *from = to_camera + 4 * row;
        const float divisor = camera->orthographic ? from[3] : from[2];
        matrix[4 * row + 0] = from[0] / across + 0.5f * divisor;
        matrix[4 * row + 1] = -from[1] / down + 0.5f * divisor;
        matrix[4 * row + 2] = from[2];
        matrix[4 * row + 3] = divisor;
    }
}

clshear_status cs_view_describe(const cs_job *job, clshear_film *film)
{
    float to_camera[16], to_picture[16];
    const cs_camera *camera = &job->camera;
    world_to_camera(camera, job->scene->scene.origin, to_camera);
    world_to_picture(job, to_camera, to_picture);
    clshear_status status = cs_film_set_matrix(film, "worldtocamera", to_camera);
    if (status == CLSHEAR_OK) status = cs_film_set_matrix(film, "worldToNDC", to_picture);
    if (status != CLSHEAR_OK || camera->orthographic) return status;
    return cs_film_set_float(film, "screenWindowWidth",
                             camera->pixel_width * (float)job->width / camera->focal_distance);
}
