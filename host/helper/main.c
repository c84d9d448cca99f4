/* clshear-import: reads one scene file and sends the scene to its standard output, for the library
 * that started it. Whatever a file does here ends this process only. */
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#include "helper/modules.h"
#include "import/transfer.h"
#include "import/wall.h"

static void limit(int resource, double most)
{
    struct rlimit now;
    if (getrlimit(resource, &now) != 0) return;
    const rlim_t wanted = (rlim_t)most;
    if (now.rlim_cur == RLIM_INFINITY || now.rlim_cur > wanted) now.rlim_cur = wanted;
    setrlimit(resource, &now);
}

static void warn(void *user, const char *line)
{
    const size_t length = strlen(line);
    (void)user;
    if (!cs_send_record(STDOUT_FILENO, CS_RECORD_WARNING, 0, line, length < 1023 ? length : 1023))
        exit(1);
}

static void send_failure(clshear_status status, const cs_error *error)
{
    char bytes[4 + sizeof error->message];
    const uint32_t number = (uint32_t)status;
    size_t length = strlen(error->message);
    if (length > 1000) length = 1000;
    memcpy(bytes, &number, sizeof number);
    memcpy(bytes + sizeof number, error->message, length);
    cs_send_record(STDOUT_FILENO, CS_RECORD_FAILURE, 0, bytes, sizeof number + length);
}

/* Assimp gets tighter limits than our readers, and only while it works. */
static clshear_status read_within_limits(cs_bytes *bytes, cs_model *model, cs_error *error)
{
    struct rlimit memory, time;
    struct rusage used = {0};
    getrlimit(RLIMIT_AS, &memory);
    getrlimit(RLIMIT_CPU, &time);
    getrusage(RUSAGE_SELF, &used);
    limit(RLIMIT_AS, cs_import_bytes(model->path, 1));
    limit(RLIMIT_CPU, cs_import_seconds(model->path, 1) + (double)used.ru_utime.tv_sec + 1.0);
    const clshear_status status = cs_read_by_module(bytes, model, error);
    setrlimit(RLIMIT_AS, &memory);
    setrlimit(RLIMIT_CPU, &time);
    return status;
}

int main(int argc, char **argv)
{
    const cs_log log = {.warn = warn};
    cs_error error = {{0}};
    cs_scene scene;
    if (argc != 4 || isatty(STDOUT_FILENO)) {
        fprintf(stderr, "%s reads scene files for libclshear and is not for the command line\n",
                argv[0]);
        return 2;
    }
    const cs_import_options options = {.smooth_degrees = strtod(argv[2], NULL),
                                       .is_played = strcmp(argv[3], "-") != 0,
                                       .time_s = strtod(argv[3], NULL)};
    limit(RLIMIT_CORE, 0.0);
    limit(RLIMIT_AS, cs_import_bytes(argv[1], 0));
    limit(RLIMIT_CPU, cs_import_seconds(argv[1], 0));
    cs_scene_init(&scene);
    clshear_status status =
        cs_import_here(argv[1], &options, read_within_limits, &scene, &log, &error);
    if (status != CLSHEAR_OK)
        send_failure(status, &error);
    else if (!cs_send_scene(STDOUT_FILENO, &scene))
        status = CLSHEAR_BAD_FILE;
    cs_scene_free(&scene);
    return status == CLSHEAR_OK ? 0 : 1;
}
