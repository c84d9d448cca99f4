/* ZIP archives in memory. */
#ifndef CS_HELPER_ZIP_H
#define CS_HELPER_ZIP_H

#include "import/text.h"

/* The directory of an archive, whose bytes stay the caller's. */
typedef struct cs_zip {
    const unsigned char *data;
    size_t size;
    size_t directory; /* where its first entry is */
} cs_zip;

typedef struct cs_zip_entry {
    const char *name; /* not 0-terminated */
    size_t name_length;
    int is_encrypted;
    unsigned method;
    size_t packed, unpacked; /* bytes */
    size_t place;            /* of its local head */
    size_t next;             /* where the next entry of the directory is */
} cs_zip_entry;

/* Finds the directory; 0 where there is none: it is no archive, or was cut. */
int cs_zip_open(const void *data, size_t size, cs_zip *zip);

/* The entry at `*place` of the directory, which moves on; 0 at its end. */
int cs_zip_next(const cs_zip *zip, size_t *place, cs_zip_entry *entry);

/* Finds a name, whatever its case and its first slash. */
int cs_zip_find(const cs_zip *zip, const char *name, cs_zip_entry *entry);

/* Unpacks an entry of the file `path`; the caller frees the bytes. */
clshear_status cs_zip_read(const cs_zip *zip, const cs_zip_entry *entry, const char *path,
                           cs_bytes *bytes, cs_error *error);

#endif
