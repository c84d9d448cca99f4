#include "render/capsule.h"

#define WORD_OF(member) (cs_u32)(offsetof(cs_pixel, member) / sizeof(cs_u32))

clshear_status cs_capsule_begin(const cs_job *job, cs_recorder **recorder, cs_error *error)
{
    if (!cs_is_set(&job->settings, RECORD)) return CLSHEAR_OK;
    return cs_recorder_open(job->scene->context->device, cs_text(&job->settings, RECORD), recorder,
                            error);
}

clshear_status cs_capsule_end(const cs_job *job, cs_recorder **recorder, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const cs_pixels *pixels = &job->pixels;
    cs_recorder *ended = *recorder;
    if (ended == NULL) return CLSHEAR_OK;
    for (size_t page = 0; page < pixels->page_count; page++) {
        const size_t left = pixels->count - page * pixels->page_pixels;
        const cs_recorded_layout layout = {
            .items = (cs_u32)(left < pixels->page_pixels ? left : pixels->page_pixels),
            .item_words = (cs_u32)(sizeof(cs_pixel) / sizeof(cs_u32)),
            .sum = WORD_OF(pattern_sum),
            .carry = WORD_OF(pattern_carry),
            .divisor = WORD_OF(patterns)};
        CS_TRY(cs_recorder_result(ended, pixels->pages[page], &layout, error));
    }
    *recorder = NULL;
    CS_TRY(cs_recorder_close(ended, 1, job->drawn, error));
done:
    return status;
}
