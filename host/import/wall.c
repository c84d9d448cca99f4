#define _GNU_SOURCE /* pipe2 */
#include "import/wall.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/number.h"
#include "import/transfer.h"

extern char **environ;

enum {
    LINE = 1024,             /* bytes of a warning or message, at most */
    PIECE = 16 * 1024 * 1024 /* bytes that are made room for at once */
};

/* The other end of the pipe. */
typedef struct child {
    const char *path; /* of the scene */
    pid_t pid;
    int pipe;
    double deadline_s;
    int too_late;
} child;

static clshear_status start(const char *helper, const cs_import_options *options, child *made,
                            cs_error *error)
{
    int ends[2];
    char smooth[48], time[48];
    cs_format_number(smooth, sizeof smooth, options->smooth_degrees, 17);
    snprintf(time, sizeof time, "-");
    if (options->is_played) cs_format_number(time, sizeof time, options->time_s, 17);
    char *arguments[] = {(char *)helper, (char *)made->path, smooth, time, NULL};
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    sigset_t signals;
    if (pipe2(ends, O_CLOEXEC) != 0)
        return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "%s: no pipe to read it through: %s",
                       made->path, strerror(errno));
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawnattr_init(&attributes);
    sigemptyset(&signals);
    posix_spawnattr_setsigmask(&attributes, &signals);
    sigaddset(&signals, SIGPIPE);
    posix_spawnattr_setsigdefault(&attributes, &signals);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    const int reason = posix_spawn(&made->pid, helper, &actions, &attributes, arguments, environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
    made->pipe = ends[0];
    if (reason == 0) return CLSHEAR_OK;
    close(ends[0]);
    return cs_fail(error, CLSHEAR_BAD_FILE, "%s: %s cannot be started: %s", made->path, helper,
                   strerror(reason));
}

/* Reads exactly `size` bytes; 0 at the end of the pipe or of the time. */
static int receive(child *from, void *target, size_t size)
{
    char *at = target;
    while (size > 0) {
        const double left_s = from->deadline_s - cs_now_s();
        struct pollfd waiting = {.fd = from->pipe, .events = POLLIN};
        from->too_late = left_s <= 0.0;
        if (from->too_late) return 0;
        const int ready = poll(&waiting, 1, left_s < 1.0 ? 100 : 1000);
        if (ready < 0 && errno != EINTR) return 0;
        if (ready <= 0) continue;
        const ssize_t got = read(from->pipe, at, size);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return 0;
        at += got;
        size -= (size_t)got;
    }
    return 1;
}

static int receive_line(child *from, size_t size, char *line)
{
    if (size >= LINE || !receive(from, line, size)) return 0;
    line[size] = '\0';
    return 1;
}

/* Room is made as the bytes come, not for what the other side says. */
static int receive_array(child *from, const cs_record *record, cs_array *array)
{
    if (record->item_size != array->item_size || record->size % array->item_size != 0) return 0;
    uint64_t left = record->size / array->item_size;
    while (left > 0) {
        const uint64_t most = PIECE / array->item_size;
        const size_t count = (size_t)(left < most ? left : most);
        void *items = cs_array_extend(array, count);
        if (items == NULL || !receive(from, items, count * array->item_size)) return 0;
        left -= count;
    }
    return 1;
}

/* What has come of a scene. */
typedef struct arrival {
    cs_array *arrays[CS_SCENE_ARRAYS];
    int count; /* arrays */
    int complete;
    clshear_status failure; /* CLSHEAR_OK: none was reported */
} arrival;

/* Takes one record; 0 if it cannot be. */
static int take_record(child *from, const cs_record *record, cs_scene *scene, const cs_log *log,
                       arrival *state, cs_error *error)
{
    char line[LINE];
    cs_scene_frame frame;
    uint32_t failure;
    switch (record->tag) {
    case CS_RECORD_WARNING:
        if (!receive_line(from, record->size, line)) return 0;
        cs_warn(log, "%s", line);
        return 1;
    case CS_RECORD_FAILURE:
        if (record->size < 4 || !receive(from, &failure, sizeof failure) ||
            !receive_line(from, record->size - 4, line))
            return 0;
        state->failure =
            failure == CLSHEAR_OUT_OF_MEMORY ? CLSHEAR_OUT_OF_MEMORY : CLSHEAR_BAD_FILE;
        cs_fail(error, state->failure, "%s", line);
        return 1;
    case CS_RECORD_FRAME:
        if (record->size != sizeof frame || !receive(from, &frame, sizeof frame)) return 0;
        memcpy(scene->origin, frame.origin, sizeof frame.origin);
        memcpy(scene->bounds, frame.bounds, sizeof frame.bounds);
        scene->degenerate = (size_t)frame.degenerate;
        scene->z_up = frame.z_up != 0;
        scene->up_is_open = frame.up_is_open != 0;
        return 1;
    case CS_RECORD_ARRAY:
        return state->count < CS_SCENE_ARRAYS &&
               receive_array(from, record, state->arrays[state->count++]);
    case CS_RECORD_END:
        state->complete = state->count == CS_SCENE_ARRAYS;
        return state->complete;
    default:
        return 0;
    }
}

/* Why nothing came, from how the process ended. */
static clshear_status explain(const child *from, int has_ended, int ended, cs_error *error)
{
    const int by_signal = has_ended && WIFSIGNALED(ended);
    if (from->too_late || (by_signal && WTERMSIG(ended) == SIGXCPU))
        return cs_fail(error, CLSHEAR_BAD_FILE,
                       "%s: the importer took longer than %.0f s and was stopped; the file may be "
                       "damaged",
                       from->path, cs_import_seconds(from->path, !from->too_late));
    if (by_signal)
        return cs_fail(error, CLSHEAR_BAD_FILE,
                       "%s: the importer crashed (%s); the file is damaged, or needs more memory",
                       from->path, strsignal(WTERMSIG(ended)));
    return cs_fail(error, CLSHEAR_BAD_FILE, "%s: the importer ended before it was done",
                   from->path);
}

clshear_status cs_import_behind_wall(const char *helper, const char *path,
                                     const cs_import_options *options, cs_scene *scene,
                                     const cs_log *log, cs_error *error)
{
    child from = {.path = path, .deadline_s = cs_now_s() + cs_import_seconds(path, 0)};
    arrival state = {.failure = CLSHEAR_OK};
    cs_record record;
    int ended = 0;
    clshear_status status = start(helper, options, &from, error);
    if (status != CLSHEAR_OK) return status;
    cs_scene_arrays(scene, state.arrays);
    while (!state.complete && state.failure == CLSHEAR_OK &&
           receive(&from, &record, sizeof record) &&
           take_record(&from, &record, scene, log, &state, error)) {
    }
    const int good = state.complete || state.failure != CLSHEAR_OK;
    if (!good && from.too_late) kill(from.pid, SIGKILL);
    close(from.pipe); /* one that still writes ends by this */
    pid_t waited;
    do
        waited = waitpid(from.pid, &ended, 0);
    while (waited < 0 && errno == EINTR);
    if (state.failure != CLSHEAR_OK) return state.failure;
    if (!state.complete) return explain(&from, waited == from.pid, ended, error);
    if (cs_scene_is_sound(scene)) return CLSHEAR_OK;
    return cs_fail(error, CLSHEAR_BAD_FILE, "%s: the importer sent what cannot be a scene", path);
}
