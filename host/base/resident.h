/* The memory of this process, and limits that the system sets to it. */
#ifndef CS_BASE_RESIDENT_H
#define CS_BASE_RESIDENT_H

#include <stddef.h>

/* Bytes of this process that are in the machine's memory; 0 where the system does not tell. */
size_t cs_resident_bytes(void);

/* Bytes that its addresses may span (`ulimit -v`); 0: any number. */
size_t cs_address_limit(void);

/* Files that it may have open (`ulimit -n`); 0: any number. */
size_t cs_open_file_limit(void);

#endif
