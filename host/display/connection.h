/* A TCP connection that is never waited for longer than is asked. */
#ifndef CS_DISPLAY_CONNECTION_H
#define CS_DISPLAY_CONNECTION_H

#include <stddef.h>

#include "base/status.h"

/* Parts of "HOST:PORT". */
typedef struct cs_address {
    char host[256]; /* without the brackets of IPv6 */
    char port[6];
} cs_address;

/* Reads an address; fails with CLSHEAR_BAD_ARGUMENT. */
clshear_status cs_address_read(const char *text, cs_address *address, cs_error *error);

/* Connects within `patience_s` seconds for each of the host's addresses, but for the time that its
 * name takes. `file` is a descriptor, closed by close(). Fails with CLSHEAR_BAD_FILE. */
clshear_status cs_connect(const cs_address *address, double patience_s, int *file, cs_error *error);

/* Sends some of `size` bytes without waiting: returns their number, 0 where none are taken, or -1
 * with errno where the other side is gone. */
long cs_send_some(int file, const void *bytes, size_t size);

/* Waits until the connection takes bytes; returns 0 if it does not within `patience_s` seconds. */
int cs_wait_to_send(int file, double patience_s);

#endif
