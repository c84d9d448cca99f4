/* The last error message of an object, guarded against concurrent use. */
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

/* Returns `status`. If it is a failure, copies the calling thread's message into the object. */
clshear_status cs_message_keep(const cs_message *message, clshear_status status);

/* A copy of the object's last message, valid until the same thread calls this function again. */
const char *cs_message_text(const cs_message *message);

#endif
