/* A viewer elsewhere that shows a film while it grows: a connection that never keeps the render
 * waiting, over which tiles go as the viewer takes them. */
#ifndef CS_DISPLAY_VIEWER_H
#define CS_DISPLAY_VIEWER_H

#include "film/film.h"

typedef struct cs_viewer cs_viewer;

/* Whether a text is "HOST:PORT", with a name, an IPv4 address or an IPv6 address in brackets. */
clshear_status cs_viewer_check(const char *address, cs_error *error);

/* Connects to the viewer at `address`, with which cs_viewer_check agrees, in 2 seconds at most.
 * `picture` is what it calls the film. Fails with CLSHEAR_BAD_FILE where nobody listens. */
clshear_status cs_viewer_open(const char *address, const char *picture, cs_viewer **viewer,
                              cs_error *error);

/* Begins to show a film, which must stay until it is sent, another is shown, or the viewer is
 * closed: the tiles in which the numbers of samples have changed since they were sent, or all. A
 * picture with the film's channels is made first if the viewer does not have one. */
clshear_status cs_viewer_show(cs_viewer *viewer, const clshear_film *film, int all,
                              cs_error *error);

/* Sends what the viewer takes. Waits where it takes nothing, until it has taken nothing for
 * `patience_s` seconds; 0: does not wait. is_sent: whether the film is there. Fails with
 * CLSHEAR_BAD_FILE where the viewer is gone. */
clshear_status cs_viewer_send(cs_viewer *viewer, double patience_s, int *is_sent, cs_error *error);

/* Closes the connection; NULL is accepted. The viewer keeps the picture. */
void cs_viewer_close(cs_viewer *viewer);

#endif
