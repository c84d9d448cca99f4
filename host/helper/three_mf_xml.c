#include "helper/three_mf_xml.h"

#include <limits.h>
#include <string.h>

#if LIBXML_VERSION < 21200
typedef xmlError told_error;
#else
typedef const xmlError told_error;
#endif

/* Errors come here rather than to the standard error output. */
static void remember(void *user, told_error *told)
{
    mf_xml *xml = user;
    if ((int)told->level <= xml->level) return;
    xml->error = told->code;
    xml->level = (int)told->level;
    xml->line = told->line;
}

int mf_xml_open(mf_xml *xml, const cs_bytes *text)
{
    *xml = (mf_xml){0};
    if (text->size > INT_MAX) return 0;
    /* Entities stay unresolved, nothing else is loaded, and libxml2's limits on depth and on the
     * length of names and values hold. */
    xml->reader = xmlReaderForMemory(text->data, (int)text->size, NULL, NULL,
                                     XML_PARSE_NONET | XML_PARSE_BIG_LINES);
    if (xml->reader == NULL) return 0;
    xmlTextReaderSetStructuredErrorHandler(xml->reader, remember, xml);
    return 1;
}

void mf_xml_close(mf_xml *xml)
{
    xmlFreeTextReader(xml->reader);
}

int mf_xml_next(mf_xml *xml)
{
    int more;
    while ((more = xmlTextReaderRead(xml->reader)) == 1) {
        const int type = xmlTextReaderNodeType(xml->reader);
        xml->closes = type == XML_READER_TYPE_END_ELEMENT;
        xml->tag = xmlTextReaderCurrentNode(xml->reader);
        if (type == XML_READER_TYPE_ELEMENT || xml->closes) return 1;
    }
    if (more < 0 && xml->error == 0) { /* it does not tell wherever memory runs out */
        xml->error = XML_ERR_NO_MEMORY;
        xml->line = xmlTextReaderGetParserLineNumber(xml->reader);
    }
    if (more == 0) xml->error = 0;
    return 0;
}

clshear_status mf_xml_end(const mf_xml *xml, const char *path, const char *part, cs_error *error)
{
    if (xml->error == 0) return CLSHEAR_OK;
    if (xml->error == XML_ERR_NO_MEMORY) /* which is its number for both */
        return cs_fail(
            error, CLSHEAR_OUT_OF_MEMORY,
            "%s: line %d of \"%s\" in it does not fit into memory, or has more than 10 MB "
            "of text",
            path, xml->line, part);
    return cs_fail(error, CLSHEAR_BAD_FILE,
                   "%s: line %d of \"%s\" in it is no XML: it is damaged, or was cut", path,
                   xml->line, part);
}

/* A prefix that is not declared is a part of libxml2's local name. */
static int is_name(const xmlChar *local, const char *name)
{
    const char *colon = strchr((const char *)local, ':');
    return strcmp(colon != NULL ? colon + 1 : (const char *)local, name) == 0;
}

int mf_xml_is(const mf_xml *xml, const char *name)
{
    return is_name(xml->tag->name, name);
}

long mf_xml_line(const mf_xml *xml)
{
    return xmlGetLineNo(xml->tag);
}

const char *mf_xml_value(const mf_xml *xml, const char *name)
{
    const xmlAttr *at = xml->tag->properties;
    while (at != NULL && !is_name(at->name, name))
        at = at->next;
    if (at == NULL) return NULL;
    const xmlNode *text = at->children;
    if (text == NULL) return "";
    /* More than one piece has entities of the file's own in it, which 3MF forbids. */
    const int is_plain = text->type == XML_TEXT_NODE && text->next == NULL;
    return is_plain && text->content != NULL ? (const char *)text->content : "";
}
