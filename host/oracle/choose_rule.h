/* Evaluation of a pilot render: the shear rule of each pixel. This code is pure statistics; the
 * renderer traces the pilot's samples and discards them. */
#ifndef CS_ORACLE_CHOOSE_RULE_H
#define CS_ORACLE_CHOOSE_RULE_H

#include <stddef.h>

#include "base/status.h"
#include "oracle/oracle.h"

/* Evidence on one candidate rule: variances of small patterns with its shear and with the prior's,
 * from the same random numbers. One value per pixel of the window; negative for pixels that the
 * pilot skipped or where the two shears agree. */
typedef struct cs_evidence {
    const cs_f32 *variance;
    const cs_f32 *prior;
} cs_evidence;

/* Chooses a rule for every pixel. `evidence` has an entry for each rule; the entry of `prior` is
 * not read. A candidate is judged by its ratio of variances to the prior, over the evidence within
 * `radius` pixels, shrunk towards the ratio of the whole picture if there is little evidence. It
 * replaces the prior if the ratio is clearly below 1. Fails when out of memory. */
clshear_status cs_pilot_choose(const cs_evidence *evidence, cs_rule prior, int width, int height,
                               int radius, uint8_t *rules, cs_error *error);

/* Bytes that it takes for each pixel while it runs. */
size_t cs_pilot_choose_bytes(void);

#endif
