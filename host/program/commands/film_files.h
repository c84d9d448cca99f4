/* The files of a render. */
#ifndef CS_PROGRAM_COMMANDS_FILM_FILES_H
#define CS_PROGRAM_COMMANDS_FILM_FILES_H

#include "options/options.h"

typedef struct film_files {
    text_list out;
    text_list gain;   /* a picture of the channel Gain */
    text_list extend; /* the picture that the render goes on with */
} film_files;

/* The scene's name with .exr, in the current folder; freed by the caller. NULL: out of memory. */
char *film_files_default_name(const char *scene);

/* "img.exr" and 7 become "img.0007.exr"; freed by the caller. NULL: out of memory. */
char *film_files_numbered_name(const char *path, int number);

/* Writes a film, with the words that made it in its metadata. A render that is not complete
 * replaces no file that is worth more; `event` says why it is not: "interrupted". Returns EXIT_DONE
 * or EXIT_FAILED. */
int film_files_write(const film_files *files, const program_options *options, clshear_film *film,
                     const char *event);

#endif
