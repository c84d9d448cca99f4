/* Capsules: the launches of a device in a file, which tools/replay.c runs again on any other. */
#ifndef CS_DEVICE_RECORDER_H
#define CS_DEVICE_RECORDER_H

#include "device/objects.h"

/* Where a buffer of 4-byte words has numbers to compare: `items` items of `item_words` words, in
 * each of which three floats at `sum` and three at `carry` are added and divided by the whole
 * number at `divisor`. */
typedef struct cs_recorded_layout {
    cs_u32 items;
    cs_u32 item_words;
    cs_u32 sum;
    cs_u32 carry;
    cs_u32 divisor;
} cs_recorded_layout;

/* Records all launches of the device from here on, of all threads, into the file `path`. One
 * recorder at a time. */
clshear_status cs_recorder_open(cs_device *device, const char *path, cs_recorder **recorder,
                                cs_error *error);

/* Writes down what the launches have left in a buffer that they know; others are passed over. */
clshear_status cs_recorder_result(cs_recorder *recorder, const cs_buffer *buffer,
                                  const cs_recorded_layout *layout, cs_error *error);

/* Ends the file, if all is `good`, or removes it; `samples` is what the launches drew. NULL does
 * nothing. */
clshear_status cs_recorder_close(cs_recorder *recorder, int good, double samples, cs_error *error);

/* One launch, about to be started. With the device locked. */
typedef struct cs_recorded_launch {
    const char *kernel;
    cs_program program;
    cs_u32 features;
    size_t global;
    size_t local;
    const cs_argument *arguments;
    size_t argument_count;
} cs_recorded_launch;

clshear_status cs_recorder_launch(cs_recorder *recorder, const cs_recorded_launch *launch,
                                  cs_error *error);

#endif
