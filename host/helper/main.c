/* clshear-import: reads one scene file and sends the scene to its standard output, for the library
 * that started it. Whatever a file does here ends this process only. */
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "helper/limits.h"
#include "helper/modules.h"
#include "import/transfer.h"
#include "import/wall.h"

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
    cs_limit(RLIMIT_CORE, 0.0);
    cs_limit(RLIMIT_AS, cs_import_bytes(argv[1], 0));
    cs_limit(RLIMIT_CPU, cs_import_seconds(argv[1], 0));
    cs_scene_init(&scene);
    clshear_status status =
        cs_import_here(argv[1], &options, cs_modules_for(argv[1]), &scene, &log, &error);
    if (status != CLSHEAR_OK)
        send_failure(status, &error);
    else if (!cs_send_scene(STDOUT_FILENO, &scene))
        status = CLSHEAR_BAD_FILE;
    cs_scene_free(&scene);
    return status == CLSHEAR_OK ? 0 : 1;
}
