/* The reason of an object's last failure, for threads that share the object. */
#ifndef CS_BASE_MESSAGE_H
#define CS_BASE_MESSAGE_H

#include <pthread.h>

#include "base/status.h"

typedef struct cs_message {
    pthread_mutex_t lock;
    cs_error last;
} cs_message;

void cs_message_init(cs_message *message);
void cs_message_destroy(cs_message *message);

/* Returns `status`. After a failure, copies the calling thread's reason into the object. */
clshear_status cs_message_keep(const cs_message *message, clshear_status status);

/* A copy of the object's last reason that is valid until the thread calls this again. */
const char *cs_message_text(const cs_message *message);

#endif
