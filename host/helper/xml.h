/* The tags of an XML text and their attributes, without the texts between them. */
#ifndef CS_HELPER_XML_H
#define CS_HELPER_XML_H

#include <stddef.h>

typedef struct cs_xml_tag {
    const char *begin; /* its < */
    const char *name;  /* without its prefix; not 0-terminated */
    size_t length;
    const char *attributes; /* from the name's end to `end` */
    const char *end;
    int closes;   /* </name> */
    int is_empty; /* <name/> */
} cs_xml_tag;

/* The next tag at `*at`, which moves on; 0 at the end. Comments and the like are passed over. */
int cs_xml_next(const char **at, cs_xml_tag *tag);

/* Whether a letter is white space as XML has it: a blank, a tab or an end of a line. */
int cs_xml_is_blank(char letter);

int cs_xml_is(const cs_xml_tag *tag, const char *name);

/* The value of an attribute, whatever its prefix, and its `*length`; NULL where it has none. */
const char *cs_xml_value(const cs_xml_tag *tag, const char *name, size_t *length);

#endif
