/* The tags of a part of a 3MF file, read by libxml2. */
#ifndef CS_HELPER_THREE_MF_XML_H
#define CS_HELPER_THREE_MF_XML_H

#include <libxml/xmlreader.h>

#include "import/text.h"

typedef struct mf_xml {
    xmlTextReaderPtr reader;
    const xmlNode *tag; /* at hand */
    int closes;         /* it is </name> */
    int error;          /* libxml2's number of the gravest error, the first of these; 0: none */
    int level;          /* how grave */
    int line;           /* where */
} mf_xml;

/* Begins to read a text, which stays the caller's; 0 where memory runs out. mf_xml_close ends it.
 */
int mf_xml_open(mf_xml *xml, const cs_bytes *text);
void mf_xml_close(mf_xml *xml);

/* Goes to the next tag; 0 at the end, and where an error ends the reading. */
int mf_xml_next(mf_xml *xml);

/* CLSHEAR_OK, or why reading ended before the end, in words that name the file and the part. */
clshear_status mf_xml_end(const mf_xml *xml, const char *path, const char *part, cs_error *error);

/* Whether the tag has this name, whatever its prefix. */
int mf_xml_is(const mf_xml *xml, const char *name);

/* The line where the tag ends; beyond 65535, up to which libxml2 keeps it, where what follows ends.
 */
long mf_xml_line(const mf_xml *xml);

/* The value of an attribute of the tag, whatever its prefix; NULL where it has none. */
const char *mf_xml_value(const mf_xml *xml, const char *name);

#endif
