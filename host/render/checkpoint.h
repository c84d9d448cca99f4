/* What a render has gathered, in a file from which it goes on to the same bits. Does nothing for a
 * job without CLSHEAR_CHECKPOINT. */
#ifndef CS_RENDER_CHECKPOINT_H
#define CS_RENDER_CHECKPOINT_H

#include "render/render_job.h"

/* Before the job is planned: whether it may write its checkpoint, or go on from the one that is
 * there, which must be whole and of the same render. */
clshear_status cs_checkpoint_check(cs_job *job, cs_error *error);

/* Puts the job and the pass where the checkpoint was written, if the job goes on from one. The job
 * must be planned. */
clshear_status cs_checkpoint_load(cs_job *job, cs_pass *pass, cs_error *error);

/* Writes a checkpoint if the last is CLSHEAR_EVERY seconds old, or `at_once`. A file that cannot be
 * written is a warning: the render is worth more. */
clshear_status cs_checkpoint_save(cs_job *job, cs_pass *pass, int at_once, cs_error *error);

#endif
