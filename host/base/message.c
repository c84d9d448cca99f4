#include "base/message.h"

#include <string.h>

/* The message is not part of an object's value, so constant objects can store one too. */
static cs_message *mutable(const cs_message *message)
{
    return (cs_message *)(uintptr_t)message;
}

void cs_message_init(cs_message *message)
{
    pthread_mutex_init(&message->lock, NULL);
    message->last.message[0] = '\0';
}

void cs_message_destroy(cs_message *message)
{
    pthread_mutex_destroy(&message->lock);
}

clshear_status cs_message_keep(const cs_message *message, clshear_status status)
{
    cs_message *kept = mutable(message);
    if (status == CLSHEAR_OK) return status;
    pthread_mutex_lock(&kept->lock);
    kept->last = *cs_thread_error();
    pthread_mutex_unlock(&kept->lock);
    return status;
}

const char *cs_message_text(const cs_message *message)
{
    static _Thread_local cs_error copy;
    cs_message *kept = mutable(message);
    pthread_mutex_lock(&kept->lock);
    copy = kept->last;
    pthread_mutex_unlock(&kept->lock);
    return copy.message;
}
