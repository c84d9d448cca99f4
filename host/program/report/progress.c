#include "report/progress.h"

#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

static volatile sig_atomic_t interrupted;
static volatile sig_atomic_t asked_for_picture;
static int hangup_ignored;

static void note_interrupt(int signal_number)
{
    interrupted = signal_number;
}

static void note_wish(int signal_number)
{
    (void)signal_number;
    asked_for_picture = 1;
}

static void catch_wishes(void)
{
    struct sigaction action;
    memset(&action, 0, sizeof action);
    action.sa_handler = note_wish;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    sigaction(SIGUSR1, &action, NULL);
}

/* In this thread and in those it starts. To ignore is not enough: LLVM puts its handler in place
 * of that while an OpenCL driver compiles, and deletes the files it is writing at a signal. */
static void block_hangups(void)
{
    sigset_t hangup;
    sigemptyset(&hangup);
    sigaddset(&hangup, SIGHUP);
    pthread_sigmask(SIG_BLOCK, &hangup, NULL);
}

void progress_note_signals(void)
{
    struct sigaction given;
    catch_wishes();
    signal(SIGXFSZ, SIG_IGN); /* so that who writes a file beyond the limit can say so */
    hangup_ignored = sigaction(SIGHUP, NULL, &given) == 0 && given.sa_handler == SIG_IGN;
    if (hangup_ignored) block_hangups();
}

void progress_outlive_reader(void)
{
    signal(SIGPIPE, SIG_IGN);
}

static void catch_interrupts(void)
{
    struct sigaction action;
    memset(&action, 0, sizeof action);
    action.sa_handler = note_interrupt;
    action.sa_flags = (int)SA_RESETHAND | SA_RESTART; /* the second time, the default: stop */
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    if (hangup_ignored) action.sa_handler = SIG_IGN;
    sigaction(SIGHUP, &action, NULL);
    action.sa_handler = note_interrupt;
    action.sa_flags = SA_RESTART; /* comes each second from the soft limit of processor time on */
    sigaction(SIGXCPU, &action, NULL);
}

int preview_wanted(void)
{
    const int wanted = asked_for_picture;
    asked_for_picture = 0;
    return wanted;
}

int interrupting_signal(void)
{
    return interrupted;
}

progress_line progress_start(int quiet)
{
    return (progress_line){
        .quiet = quiet, .on_terminal = isatty(STDERR_FILENO), .last_percent = -1};
}

/* Writes the line over the one before, as far as the terminal has columns: a line that wraps would
 * stay. */
static void write_over(const char *line)
{
    enum {
        LONGEST = 79
    };
    struct winsize size;
    int columns = LONGEST;
    if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1 && size.ws_col <= LONGEST)
        columns = size.ws_col - 1;
    fprintf(stderr, "\r%-*.*s", columns, columns, line);
}

static void print_line(const clshear_progress *progress, int percent, char *line, size_t size)
{
    const long left_s = (long)(progress->remaining_s + 0.5);
    size_t used = (size_t)snprintf(line, size, "%3d %%  %.2f Msamples/s", percent,
                                   1e-6 * progress->samples_per_s);
    /* A pilot does not know what is left, nor does a promise before it is first looked at. */
    if (progress->fraction > 0.0 && (progress->remaining_s > 0.0 || progress->fraction >= 1.0))
        used += (size_t)snprintf(line + used, size - used, "  %ld:%02ld:%02ld left", left_s / 3600,
                                 left_s / 60 % 60, left_s % 60);
    if (progress->noise > 0.0)
        used +=
            (size_t)snprintf(line + used, size - used, "  noise %.3g %%", 100.0 * progress->noise);
    if (progress->noise_pixel > 0.0)
        snprintf(line + used, size - used, ", of pixels %.3g %%", 100.0 * progress->noise_pixel);
}

int progress_report(void *user, const clshear_progress *progress)
{
    progress_line *state = user;
    if (progress->fraction > 0.0 && !state->catches) {
        catch_interrupts();
        catch_wishes(); /* again: LLVM takes this signal, too */
        state->catches = 1;
    }
    if (progress->samples_per_s <= 0.0) return interrupting_signal(); /* still finding depths */
    int percent = (int)(100.0 * progress->fraction); /* floored: 100 % is done, not nearly done */
    int step = state->on_terminal ? 1 : 10;
    if (state->quiet || (percent / step == state->last_percent / step && state->last_percent >= 0))
        return interrupting_signal();
    state->last_percent = percent;
    char line[128];
    print_line(progress, percent / step * step, line, sizeof line);
    if (state->on_terminal)
        write_over(line);
    else
        fprintf(stderr, "clshear: %s\n", line);
    return interrupting_signal();
}

void progress_end(const progress_line *progress)
{
    if (!progress->quiet && progress->on_terminal && progress->last_percent >= 0)
        fputc('\n', stderr);
}
