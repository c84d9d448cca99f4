#include "helper/xml.h"

#include <string.h>

int cs_xml_is_blank(char letter)
{
    return letter == ' ' || letter == '\t' || letter == '\r' || letter == '\n';
}

/* Behind what begins with <! or <?, or the end of the text. */
static const char *pass(const char *at)
{
    const char *closing = strncmp(at, "<!--", 4) == 0        ? "-->"
                          : strncmp(at, "<![CDATA[", 9) == 0 ? "]]>"
                                                             : ">";
    const char *end = strstr(at, closing);
    return end != NULL ? end + strlen(closing) : at + strlen(at);
}

/* Goes past a prefix of a name that ends at `end`. */
static const char *pass_prefix(const char *name, const char *end)
{
    const char *colon = memchr(name, ':', (size_t)(end - name));
    return colon != NULL ? colon + 1 : name;
}

int cs_xml_next(const char **at, cs_xml_tag *tag)
{
    const char *begin = strchr(*at, '<');
    while (begin != NULL && (begin[1] == '!' || begin[1] == '?'))
        begin = strchr(pass(begin), '<');
    if (begin == NULL) return 0;
    tag->begin = begin;
    tag->closes = begin[1] == '/';
    const char *name = begin + 1 + tag->closes, *end = name;
    while (*end != '\0' && *end != '>' && *end != '/' && !cs_xml_is_blank(*end))
        end++;
    tag->name = pass_prefix(name, end);
    tag->length = (size_t)(end - tag->name);
    tag->attributes = end;
    for (char quote = '\0'; *end != '\0' && (quote != '\0' || *end != '>'); end++)
        if (*end == quote)
            quote = '\0';
        else if (quote == '\0' && (*end == '"' || *end == '\''))
            quote = *end;
    if (*end == '\0') return 0;
    tag->end = end;
    tag->is_empty = end[-1] == '/';
    *at = end + 1;
    return 1;
}

int cs_xml_is(const cs_xml_tag *tag, const char *name)
{
    return strlen(name) == tag->length && strncmp(tag->name, name, tag->length) == 0;
}

const char *cs_xml_value(const cs_xml_tag *tag, const char *name, size_t *length)
{
    const size_t wanted = strlen(name);
    for (const char *at = tag->attributes; at < tag->end;) {
        while (at < tag->end && (cs_xml_is_blank(*at) || *at == '/'))
            at++;
        const char *key = at;
        while (at < tag->end && *at != '=' && !cs_xml_is_blank(*at))
            at++;
        const char *local = pass_prefix(key, at), *stop = at;
        while (at < tag->end && *at != '"' && *at != '\'')
            at++;
        if (at == tag->end) return NULL;
        const char quote = *at++, *value = at;
        while (at < tag->end && *at != quote)
            at++;
        *length = (size_t)(at - value);
        if ((size_t)(stop - local) == wanted && strncmp(local, name, wanted) == 0) return value;
        at++;
    }
    return NULL;
}
