#include "report/progress.h"

#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static volatile sig_atomic_t interrupted;
static int hangup_ignored;

static void note_interrupt(int signal_number)
{
    interrupted = signal_number;
}

void progress_note_signals(void)
{
    struct sigaction given;
    hangup_ignored = sigaction(SIGHUP, NULL, &given) == 0 && given.sa_handler == SIG_IGN;
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

int progress_report(void *user, const clshear_progress *progress)
{
    progress_line *state = user;
    if (progress->fraction > 0.0 && !state->catches) {
        catch_interrupts();
        state->catches = 1;
    }
    if (progress->samples_per_s <= 0.0) return interrupting_signal(); /* still finding depths */
    int percent = (int)(100.0 * progress->fraction); /* floored: 100 % is done, not nearly done */
    int step = state->on_terminal ? 1 : 10;
    long left_s = (long)(progress->remaining_s + 0.5);
    if (state->quiet || (percent / step == state->last_percent / step && state->last_percent >= 0))
        return interrupting_signal();
    state->last_percent = percent;
    fprintf(stderr, "%s%3d %%  %.2f Msamples/s",
            state->on_terminal ? "\r" : "clshear: ", percent / step * step,
            1e-6 * progress->samples_per_s);
    if (progress->fraction > 0.0) /* else a pilot, which does not know what is left */
        fprintf(stderr, "  %ld:%02ld:%02ld left", left_s / 3600, left_s / 60 % 60, left_s % 60);
    if (progress->noise > 0.0) fprintf(stderr, "  noise %.3g %%", 100.0 * progress->noise);
    fputs(state->on_terminal ? "   " : "\n", stderr);
    return interrupting_signal();
}

void progress_end(const progress_line *progress)
{
    if (!progress->quiet && progress->on_terminal && progress->last_percent >= 0)
        fputc('\n', stderr);
}
